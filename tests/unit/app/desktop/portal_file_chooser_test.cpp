/// @file  The desktop's file dialog, on a bus of the test's own with a fake portal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "app/desktop/file_chooser.h"
#include "app/desktop/file_uri.h"
#include "tests/support/fake_portal.h"

namespace flytri::desktop {
namespace {

using testing::FakePortal;
using ::testing::HasSubstr;
using testing::PortalMood;
using testing::PrivateBus;

constexpr const char* kNoBus = "dbus-daemon is not installed";

/// Waits until the condition holds; false after ten seconds.
template <typename Condition>
bool comes_true(const Condition& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

bool becomes_ready(FileChooser& chooser) {
  return comes_true([&] {
    (void)chooser.settle();
    return chooser.why_not().empty();
  });
}

std::optional<ChooserAnswer> answer_of(FileChooser& chooser) {
  std::optional<ChooserAnswer> answer;
  comes_true([&] { return (answer = chooser.settle()).has_value(); });
  return answer;
}

/// Asks a portal of this mood for a folder.
ChooserAnswer answer_in(PortalMood mood, const std::string& uri) {
  const PrivateBus bus(true);
  const FakePortal portal(bus.address(), mood, uri);
  const auto chooser = portal_file_chooser();
  EXPECT_TRUE(becomes_ready(*chooser)) << chooser->why_not();
  EXPECT_TRUE(chooser->ask({ChooserKind::kFolder, "Folder for models", {}, {}, {}}));
  const auto answer = answer_of(*chooser);
  EXPECT_TRUE(answer);
  return answer.value_or(ChooserAnswer{});
}

class PortalFileChooserTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (PrivateBus(false).address().empty()) GTEST_SKIP() << kNoBus;
  }
};

TEST_F(PortalFileChooserTest, ReturnsWhatTheUserChose) {
  EXPECT_EQ(answer_in(PortalMood::kChooses, "file:///home/a%20b/%C3%BC").path, "/home/a b/ü");
  EXPECT_EQ(answer_in(PortalMood::kNamesNewPath, "file:///home/x").path, "/home/x");
}

TEST_F(PortalFileChooserTest, ACancelledDialogChoosesNothing) {
  const ChooserAnswer answer = answer_in(PortalMood::kCancels, "");
  EXPECT_FALSE(answer.path);
  EXPECT_EQ(answer.failure, "");
}

TEST_F(PortalFileChooserTest, SaysWhyTheDialogDoesNotCome) {
  EXPECT_THAT(answer_in(PortalMood::kRefuses, "").failure, HasSubstr("no backend"));
  const ChooserAnswer far = answer_in(PortalMood::kChooses, "sftp://host/a");
  EXPECT_FALSE(far.path);
  EXPECT_THAT(far.failure, HasSubstr("sftp://host/a: is not a file on this computer"));
}

TEST_F(PortalFileChooserTest, AsksForWhatIsWanted) {
  const PrivateBus bus(true);
  FakePortal portal(bus.address(), PortalMood::kCancels, "");
  const auto chooser = portal_file_chooser();
  ASSERT_TRUE(becomes_ready(*chooser)) << chooser->why_not();
  ASSERT_TRUE(chooser->ask(
      {ChooserKind::kSaveFile, "Save a case", "/tmp/new.flytri", "Cases", "*.flytri"}));
  ASSERT_TRUE(answer_of(*chooser));
  testing::PortalRequest request = portal.latest();
  EXPECT_EQ(request.member, "SaveFile");
  EXPECT_EQ(request.title, "Save a case");
  EXPECT_EQ(request.folder, "/tmp");
  EXPECT_EQ(request.name, "new.flytri");
  EXPECT_EQ(request.filter, "*.flytri");
  EXPECT_FALSE(request.is_directory);
  ASSERT_TRUE(chooser->ask({ChooserKind::kFolder, "Folder for models", "/tmp", {}, {}}));
  ASSERT_TRUE(answer_of(*chooser));
  request = portal.latest();
  EXPECT_EQ(request.member, "OpenFile");
  EXPECT_TRUE(request.is_directory);
  EXPECT_EQ(request.folder, "/tmp");
  EXPECT_EQ(request.filter, "");
}

TEST_F(PortalFileChooserTest, AsksOnceAtATimeAndDoesNotWait) {
  const PrivateBus bus(true);
  const FakePortal portal(bus.address(), PortalMood::kNeverAnswers, "");
  const auto chooser = portal_file_chooser();
  ASSERT_TRUE(becomes_ready(*chooser));
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_TRUE(chooser->ask({}));
  EXPECT_EQ(chooser->ask({}).error().code, ErrorCode::kBadOption);
  EXPECT_FALSE(chooser->settle());
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(2));
}

TEST_F(PortalFileChooserTest, AnEndOfTheBusEndsTheDialog) {
  PrivateBus bus(true);
  const auto chooser = portal_file_chooser();
  {
    const FakePortal portal(bus.address(), PortalMood::kNeverAnswers, "");
    ASSERT_TRUE(becomes_ready(*chooser));
    ASSERT_TRUE(chooser->ask({}));
    (void)chooser->settle();
  }
  bus.stop();
  const auto answer = answer_of(*chooser);
  ASSERT_TRUE(answer);
  EXPECT_NE(answer->failure, "");
  EXPECT_THAT(chooser->why_not(), HasSubstr("type the path"));
}

TEST_F(PortalFileChooserTest, WithoutAPortalItSaysWhy) {
  const PrivateBus bus(false);
  const auto chooser = portal_file_chooser();
  EXPECT_TRUE(comes_true([&] {
    (void)chooser->settle();
    return chooser->why_not().find("install xdg-desktop-portal") != std::string::npos;
  })) << chooser->why_not();
  EXPECT_EQ(chooser->ask({}).error().code, ErrorCode::kNotFound);
}

TEST(PortalFileChooser, WithoutABusItSaysWhy) {
  const char* former = std::getenv("DBUS_SESSION_BUS_ADDRESS");
  const std::string kept = former == nullptr ? "" : former;
  setenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent/bus", 1);
  const auto chooser = portal_file_chooser();
  EXPECT_TRUE(comes_true([&] {
    (void)chooser->settle();
    return chooser->why_not().find("type the path") != std::string::npos;
  }));
  EXPECT_FALSE(chooser->ask({}));
  if (kept.empty()) {
    unsetenv("DBUS_SESSION_BUS_ADDRESS");
  } else {
    setenv("DBUS_SESSION_BUS_ADDRESS", kept.c_str(), 1);
  }
}

TEST(FileUri, IsAPathOnThisComputer) {
  EXPECT_EQ(path_of_uri("file:///a/b%2525c"), "/a/b%25c");
  EXPECT_EQ(path_of_uri("file://localhost/a"), "/a");
  EXPECT_EQ(path_of_uri("file://host/a"), std::nullopt);
  EXPECT_EQ(path_of_uri("http:///a"), std::nullopt);
  EXPECT_EQ(path_of_uri("file:///a%2"), std::nullopt);
  EXPECT_EQ(path_of_uri("file:///a%zz"), std::nullopt);
  EXPECT_EQ(path_of_uri("file:///a%00b"), std::nullopt);
}

}  // namespace
}  // namespace flytri::desktop
