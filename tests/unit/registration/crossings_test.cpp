#include "core/registration/crossings.h"

#include <gtest/gtest.h>

#include "core/registration/prepared_view.h"
#include "tests/support/wavy_scene.h"

namespace flytri::registration {
namespace {

PreparedView view_at(double x_mm, Pattern pattern) {
  Random random(5);
  const Isometry T_world_sensor(Eigen::Translation3d(x_mm, 0.0, 0.0));
  return prepare_view(
             testing::measure_scene(testing::cusped_height, {}, pattern, T_world_sensor, random))
      .moved(T_world_sensor);
}

TEST(Crossings, CurvesInTheSameLightSheetAreNotCrossings) {
  // Two curves in one plane always meet, independent of the surface. Such crossings would pull
  // every view onto an earlier view of the same pattern.
  const PreparedView earlier = view_at(0.0, Pattern::kVertical);
  const PreparedView* const metaview[] = {&earlier};
  CrossingLimits limits;
  limits.max_distance_mm = 5.0;
  EXPECT_TRUE(candidate_pairs(view_at(1.0, Pattern::kVertical), metaview, limits).empty());
  EXPECT_FALSE(candidate_pairs(view_at(1.0, Pattern::kHorizontal), metaview, limits).empty());
}

}  // namespace
}  // namespace flytri::registration
