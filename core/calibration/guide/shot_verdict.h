/// @file  The faults of a calibration image, and what the user should do.
#pragma once

#include <string>
#include <string_view>

namespace flytri::calibration {

enum class ShotFault {
  kNone,
  kWrongImage,        ///< type or size differs from the other images of this camera
  kStrayLight,        ///< dark image: the room is too bright, or something reflects light
  kLightStaysOn,      ///< dark image: lines are visible although all lights should be off
  kTooDark,           ///< lines or dots are too little brighter than the background
  kSaturated,         ///< lines or dots are clipped
  kDefocused,         ///< lines or dots are blurred
  kLinesMissing,      ///< some lines are missing or incomplete
  kOtherPattern,      ///< the image shows the other pattern
  kRoomLightChanged,  ///< the room light differs from the dark image
  kPlaneMoved,        ///< the plane moved between the shots of one placement
  kWrongDepth,        ///< the plane is not at the stated depth
  kMovedSideways,     ///< the dots are beside the path of the stage
  kNoDots,            ///< not the dot target, or too few of its dots in sight
  kMarkersHidden,     ///< the three large dots are not all visible
  kMirrored,          ///< the camera sees the target from behind
};

/// What the user should do.
[[nodiscard]] std::string_view remedy_of(ShotFault fault);

/// Measurements of one image. Values that do not apply are 0.
struct ShotFigures {
  int found = 0;                ///< number of lines or dots
  int expected = 0;             ///< number of lines; 0 for dots, whose number is not fixed
  double brightness = 0.0;      ///< median height of lines or dots above the background, share of
                                ///< full scale
  double saturated = 0.0;       ///< share of clipped samples or dots
  double width_px = 0.0;        ///< median width of the lines or of the edges of the dots
  double depth_error_mm = 0.0;  ///< measured depth minus stated depth
};

struct ShotVerdict {
  ShotFault fault = ShotFault::kNone;
  std::string finding;  ///< what is wrong, with numbers; empty for a good shot
  ShotFigures figures;
  [[nodiscard]] bool good() const { return fault == ShotFault::kNone; }
};

[[nodiscard]] ShotVerdict refuse(ShotFault fault, std::string finding,
                                 const ShotFigures& figures = {});

}  // namespace flytri::calibration
