#include "app/session/case_store.h"

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace flytri::session {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CaseStore, AFinishedModelThatCannotBeReadIsTold) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "case.flytri";
  {
    auto file = io::CaseFile::create(path, {});
    ASSERT_TRUE(file) << file.error().message;
    const char* summary = R"({"made_of": {"view_count": 0, "edited_at_s": []}})";
    ASSERT_TRUE(file->write_result(io::ScanStage::kUpper, {"glTF, and no more", summary}));
    ASSERT_TRUE(file->commit());
  }
  auto file = io::CaseFile::open(path);
  ASSERT_TRUE(file) << file.error().message;
  const auto opened = std::make_shared<CaseStore>(std::move(*file))->load(io::ScanStage::kUpper);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->scan.result, nullptr);
  EXPECT_THAT(opened->damage, ElementsAre(HasSubstr("finish again")));
}

}  // namespace
}  // namespace flytri::session
