#include "app/session/case_store.h"

#include <gmock/gmock.h>

#include "core/io/models/glb.h"
#include "tests/support/case_samples.h"
#include "tests/support/full_disk.h"
#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr io::ScanStage kStage = io::ScanStage::kUpper;

std::shared_ptr<CaseStore> new_store(const std::filesystem::path& path) {
  return std::make_shared<CaseStore>(io::CaseFile::create(path, {}).value());
}

/// Opens a case with this model in it.
Result<OpenedStage> opened_with(const io::StageResult& result) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "case.flytri";
  {
    io::CaseFile file = io::CaseFile::create(path, {}).value();
    EXPECT_TRUE(file.write_result(kStage, result));
    EXPECT_TRUE(file.commit());
  }
  return std::make_shared<CaseStore>(io::CaseFile::open(path).value())->load(kStage);
}

std::string small_model() {
  TexturedMesh model;
  model.mesh.vertices.resize(3);
  model.mesh.vertices[1].position_mm = {1, 0, 0};
  model.mesh.vertices[2].position_mm = {0, 1, 0};
  model.mesh.triangles = {{0, 1, 2}};
  return io::encode_glb(model, "model").value();
}

TEST(CaseStore, SaysThatAFinishedModelCannotBeRead) {
  const auto opened = opened_with({"glTF, and no more", "", io::ResultBasis{}});
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->scan.result, nullptr);
  EXPECT_THAT(opened->damage, ElementsAre(HasSubstr("finish again")));
}

TEST(CaseStore, LoadsAModelThatIsMadeOfTheStageAsItIs) {
  const auto opened = opened_with({small_model(), "", io::ResultBasis{}});
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_NE(opened->scan.result, nullptr);
}

TEST(CaseStore, LeavesOutAModelThatIsMadeOfOtherViews) {
  const auto opened = opened_with({small_model(), "", io::ResultBasis{5, {}}});
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->scan.result, nullptr);
}

TEST(CaseStore, AFailureIsOverOnceEverythingIsSaved) {
  const TemporaryFolder folder;
  const auto store = new_store(folder.path() / "a.flytri");
  const auto journal = store->journal(kStage);
  {
    const FullDisk limit(1);
    journal->keep_view(testing::sample_view(0, 2, 300));
    journal->commit();
    EXPECT_THAT(store->failure(), HasSubstr("a.flytri"));
  }
  journal->keep_view(testing::sample_view(1, 2, 300));
  journal->commit();
  EXPECT_THAT(store->failure(), IsEmpty());
  EXPECT_EQ(store->load(kStage)->last_frame, FrameIndex(1));
}

TEST(CaseStore, AFailureStaysIfSomethingIsLost) {
  const TemporaryFolder folder;
  const auto store = new_store(folder.path() / "a.flytri");
  const auto journal = store->journal(kStage);
  journal->keep_view(testing::sample_view(0, 2, 300));
  journal->keep_view(testing::sample_view(0, 2, 200));  // the case has a view of this frame
  journal->commit();
  EXPECT_THAT(store->failure(), HasSubstr("exists already"));
}

TEST(CaseStore, FindsTheUnnamedCaseOfAKilledProgram) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const fs::path scanned = folder.path() / "a.flytri", left = folder.path() / "left";
  const auto store = new_store(scanned);
  const auto journal = store->journal(kStage);
  journal->keep_view(testing::sample_view(0, 2, 300));
  journal->commit();
  EXPECT_TRUE(unnamed_cases(folder.path()).empty()) << "it is open";
  // What is on disk at the moment when the program is killed: the file and its log.
  fs::create_directory(left);
  for (const char* ending : {"", "-wal"}) {
    fs::copy(scanned.string() + ending, (left / "a.flytri").string() + ending);
  }
  const auto found = unnamed_cases(left);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found.front().is_unnamed);
  EXPECT_EQ(io::CaseFile::open(found.front().path)->counts(kStage)->views, 1);
}

}  // namespace
}  // namespace flytri::session
