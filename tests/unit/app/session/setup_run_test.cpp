#include "app/session/setup_run.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "hw/rig/rig_file.h"
#include "tests/support/simulated_head.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ui::SetupStep;

class SetupRunTest : public ::testing::Test {
 protected:
  /// Waits until the run asks or has ended.
  static ui::RunningSetup next(const SetupRun& run) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (run.state().step == SetupStep::kWorking && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return run.state();
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "sensors" / "first" / "rig.json";
  testing::SimulatedHead head_;
};

TEST_F(SetupRunTest, WritesTheRigThatTheAnswersDescribe) {
  SetupRun run(head_.machine(), file_);
  ui::RunningSetup now = next(run);
  int asked = 0;
  for (; now.step == SetupStep::kAsking; now = next(run)) {
    ASSERT_LT(++asked, 50);
    const ui::SetupQuestion& question = now.question;
    run.answer(question.number, question.answers.size());
    EXPECT_EQ(run.state().question.text, question.text) << "there is no such answer";
    run.answer(question.number, question.suggested);
  }
  EXPECT_GT(asked, 2);
  ASSERT_EQ(now.step, SetupStep::kDone) << now.message;
  EXPECT_EQ(now.file, file_.string());
  EXPECT_THAT(now.told, Contains(HasSubstr("Which one is the texture camera")))
      << "questions and answers can be read again";
  const auto rig = rig::read_rig(file_);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->name, "first");
  EXPECT_EQ(rig->measurement.match.name, "Mono");
}

TEST_F(SetupRunTest, ASecondAnswerToAQuestionDoesNotAnswerTheNextOne) {
  SetupRun run(head_.machine(), file_);
  const ui::SetupQuestion first = next(run).question;
  run.answer(first.number, first.suggested);
  const ui::RunningSetup now = next(run);
  ASSERT_EQ(now.step, SetupStep::kAsking);
  ASSERT_NE(now.question.text, first.text);
  run.answer(first.number, 0);
  EXPECT_EQ(run.state().step, SetupStep::kAsking);
  EXPECT_EQ(run.state().question.text, now.question.text);
}

TEST_F(SetupRunTest, SaysWhatIsMissing) {
  head_.cameras.clear();
  SetupRun run(head_.machine(), file_);
  const ui::RunningSetup now = next(run);
  ASSERT_EQ(now.step, SetupStep::kFailed);
  EXPECT_THAT(now.message, HasSubstr("camera"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "sensors"));
}

TEST_F(SetupRunTest, EndsAtOnceWhileItAsks) {
  {
    SetupRun run(head_.machine(), file_);
    ASSERT_EQ(next(run).step, SetupStep::kAsking);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "sensors"));
}

}  // namespace
}  // namespace flytri::session
