#include "ui/widgets/typed_text.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "tests/support/memory_scan.h"

namespace flytri::ui {
namespace {

using testing::random_passphrase;
using testing::unlocked_copies;

/// A window with three fields that nobody sees.
class TypedText : public ::testing::Test {
 protected:
  TypedText() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {400.0F, 300.0F};
    io.DeltaTime = 0.02F;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  }
  void SetUp() override {
    if (!testing::memory_can_be_locked()) GTEST_SKIP() << testing::kNoLocks;
  }
  ~TypedText() override { ImGui::DestroyContext(); }

  /// Draws the fields. @param focused  the one that takes the focus in this frame
  void draw(int focused = -1) {
    ImGui::NewFrame();
    ImGui::Begin("window");
    if (focused == 0) ImGui::SetKeyboardFocusHere();
    if (draws_secrets_) (void)secret_input("first", first_);
    if (focused == 1) ImGui::SetKeyboardFocusHere();
    if (draws_secrets_) (void)secret_input("second", second_);
    if (focused == 2) ImGui::SetKeyboardFocusHere();
    ImGui::InputText("plain", plain_, sizeof(plain_));
    ImGui::End();
    ImGui::Render();
    wipe_typed_text();
  }
  void focus(int field) {
    draw(field);
    draw();
    draw();
  }
  /// All letters in one frame, as a slow computer gets them.
  void type(const Secret& text) {
    for (const char letter : text.view()) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(letter));
    }
    draw();
    draw();
  }

  Secret first_, second_;
  char plain_[64] = {};
  bool draws_secrets_ = true;
};

std::vector<std::string> copies_of(const Secret& text) { return unlocked_copies(::getpid(), text); }

TEST_F(TypedText, GoesIntoTheSecretAlone) {
  const Secret text = random_passphrase();
  focus(0);
  type(text);
  EXPECT_TRUE(first_.equals(text));
  focus(2);
  EXPECT_EQ(copies_of(text), std::vector<std::string>());
}

TEST_F(TypedText, IsWipedWhenTheNextFieldIsEdited) {
  const Secret one = random_passphrase(), other("x");
  focus(0);
  type(one);
  focus(1);
  type(other);
  EXPECT_TRUE(second_.equals(other));
  EXPECT_EQ(copies_of(one), std::vector<std::string>()) << "while the second is still edited";
}

TEST_F(TypedText, IsWipedWhenTheFieldIsNoLongerDrawn) {
  const Secret text = random_passphrase();
  focus(0);
  type(text);
  first_.clear();
  draws_secrets_ = false;
  draw();
  draw();
  EXPECT_EQ(copies_of(text), std::vector<std::string>());
}

TEST_F(TypedText, DoesNotComeBackIntoAClearedSecret) {
  const Secret text = random_passphrase();
  focus(0);
  type(text);
  first_.clear();
  draw();
  draw();
  EXPECT_TRUE(first_.empty());
  EXPECT_EQ(copies_of(text), std::vector<std::string>());
}

TEST_F(TypedText, OtherFieldsKeepWhatIsTyped) {
  focus(2);
  type(Secret("Zoe"));
  focus(0);
  type(random_passphrase());
  EXPECT_STREQ(plain_, "Zoe");
  focus(2);
  type(Secret(" Finch"));
  EXPECT_NE(std::string(plain_).find(" Finch"), std::string::npos) << plain_;
}

}  // namespace
}  // namespace flytri::ui
