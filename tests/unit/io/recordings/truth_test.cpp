#include "core/io/recordings/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

TEST(Truth, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  Truth truth{"jaw.ply", {}};
  Twist twist;
  twist << 0.1, -0.7, 2.0, 5.0, -6.0, 7.5;
  truth.poses.push_back({FrameIndex(3), "frames/000003.png", 0.1, exp_twist(twist)});
  ASSERT_TRUE(write_truth(folder / "truth.json", truth));
  const Result<Truth> back = read_truth(folder / "truth.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->mesh, folder / "jaw.ply");
  ASSERT_EQ(back->poses.size(), 1U);
  EXPECT_EQ(back->poses[0].frame, FrameIndex(3));
  // The conversion to a quaternion and back causes rounding errors of numbers below 10.
  EXPECT_TRUE(back->poses[0].T_model_sensor.isApprox(truth.poses[0].T_model_sensor, 1e-14));
}

TEST(Truth, RefusesARotationThatIsNotOne) {
  const Result<Truth> truth = parse_truth(
      R"({"format":"flytri.truth","version":1,"mesh":"m.ply","poses":[{"frame":0,"file":"f","time_s":0,
          "q_wxyz":[1,1,0,0],"t_mm":[0,0,0]}]})",
      "t.json");
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().message, "t.json: \"poses[0].q_wxyz\": expected a unit quaternion");
}

}  // namespace
}  // namespace flytri::io
