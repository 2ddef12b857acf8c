#include "core/calibration/guide/board_places.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace flytri::calibration {
namespace {

constexpr double kTilt_deg = 22.0;
constexpr double kDegree = std::numbers::pi / 180.0;

struct Depth {
  double share;
  const char* words;
};
constexpr std::array<Depth, 3> kDepths = {
    {{0.0, "in the middle of the volume"}, {-0.35, "near"}, {0.35, "far"}}};

struct Tilt {
  double right, down;
  const char* words;
};
constexpr double kDiagonal = 0.7;  // of the tilt to a side: as much tilt in all
constexpr std::array<Tilt, 9> kTilts = {
    {{0.0, 0.0, "facing the sensor"},
     {-1.0, 0.0, "its left edge towards the sensor"},
     {1.0, 0.0, "its right edge towards the sensor"},
     {0.0, -1.0, "its upper edge towards the sensor"},
     {0.0, 1.0, "its lower edge towards the sensor"},
     {-kDiagonal, -kDiagonal, "its upper left corner towards the sensor"},
     {kDiagonal, kDiagonal, "its lower right corner towards the sensor"},
     {kDiagonal, -kDiagonal, "its upper right corner towards the sensor"},
     {-kDiagonal, kDiagonal, "its lower left corner towards the sensor"}}};

struct Extra {
  double depth_share, turn_deg;
  const char* words;
};
constexpr std::array<Extra, 3> kExtras = {
    {{-0.5, 0.0, "as near as the lines are sharp"},
     {0.5, 0.0, "as far as the lines are sharp"},
     {0.0, 30.0, "turned a little clockwise in the middle of the volume"}}};

}  // namespace

std::vector<BoardPlace> board_places() {
  std::vector<BoardPlace> places;
  for (const Depth& depth : kDepths) {
    for (const Tilt& tilt : kTilts) {
      places.push_back({depth.share, kTilt_deg * Vec2(tilt.right, tilt.down), 0.0,
                        fmt::format("{}, {}", depth.words, tilt.words)});
    }
  }
  for (const Extra& extra : kExtras)
    places.push_back({extra.depth_share, Vec2::Zero(), extra.turn_deg,
                      fmt::format("{}, {}", extra.words, kTilts.front().words)});
  return places;
}

Isometry pose_of(const BoardPlace& place, double depth_mm) {
  // z points away from the sensor: a positive turn about y brings the right edge nearer.
  const Vec3 about(-place.nearer_deg.y(), place.nearer_deg.x(), 0.0);
  Twist tilt = Twist::Zero(), turn = Twist::Zero();
  tilt.head<3>() = kDegree * about;
  tilt[5] = place.depth_share * depth_mm;
  turn[2] = kDegree * place.turn_deg;
  return exp_twist(tilt) * exp_twist(turn);
}

}  // namespace flytri::calibration
