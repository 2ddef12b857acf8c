#include "core/reconstruct/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scan_scene.h"

namespace flytri::reconstruct {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The message for the views of one pattern of a scan.
std::string failure_of(std::vector<std::shared_ptr<const View>> views) {
  const auto reconstruction = reconstruct_views(std::move(views), {}, Workers(1), {});
  return reconstruction ? "" : reconstruction.error().message;
}

TEST(Reconstruct, SaysWhichPatternIsMissing) {
  const testing::TrueScan scan = testing::scan_cusps(16, {.points_per_line = 150}, 1);
  for (const Pattern pattern : kPatterns) {
    std::vector<std::shared_ptr<const View>> views;
    for (const AlignedView& view : scan.views) {
      if (view.view->pattern != pattern) continue;
      View numbered = *view.view;
      numbered.frame = FrameIndex(views.size());
      views.push_back(std::make_shared<const View>(std::move(numbered)));
    }
    const std::string missing(to_string(other(pattern)));
    EXPECT_THAT(failure_of(views), AllOf(HasSubstr("8 show " + std::string(to_string(pattern))),
                                         HasSubstr("0 show " + missing),
                                         HasSubstr("the " + missing + " pattern is missing")));
  }
}

TEST(Reconstruct, MakesASurfaceOfViewsWithoutACalibration) {
  std::vector<std::shared_ptr<const View>> views;
  for (const AlignedView& view : testing::scan_cusps(16, {.points_per_line = 150}, 1).views) {
    View numbered = *view.view;
    numbered.frame = FrameIndex(views.size());
    views.push_back(std::make_shared<const View>(std::move(numbered)));
  }
  const auto reconstruction = reconstruct_views(std::move(views), {}, Workers(1), {});
  ASSERT_TRUE(reconstruction) << reconstruction.error().message;
  EXPECT_FALSE(reconstruction->model.mesh.triangles.empty());
}

}  // namespace
}  // namespace flytri::reconstruct
