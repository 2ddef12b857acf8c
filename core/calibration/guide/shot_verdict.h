/// @file  What is wrong with a calibration image, in words that tell what to do about it.
#pragma once

#include <string>
#include <string_view>

namespace flytri::calibration {

enum class ShotFault {
  kNone,
  kWrongImage,        ///< type or size are not those of the other images of this camera
  kStrayLight,        ///< dark: the room is too bright, or something reflects
  kLightStaysOn,      ///< dark: lines show although all lights are to be off
  kTooDark,           ///< lines or dots stand too little above the rest
  kSaturated,         ///< they are clipped
  kDefocused,         ///< they are blurred
  kLinesMissing,      ///< not all lines are there, or not all along
  kOtherPattern,      ///< the other lines are in the image
  kRoomLightChanged,  ///< against the dark image
  kPlaneMoved,        ///< between the shots of one placement
  kWrongDepth,        ///< the plane is not where it is to be
  kMovedSideways,     ///< the dots are not where the stage's motion leads them
  kNoDots,            ///< not the dot target, or too few of its dots in sight
  kMarkersHidden,     ///< the three large dots are not all there
  kMirrored,          ///< the target is seen from behind
};

/// What the fault's remedy is, a sentence for the user.
[[nodiscard]] std::string_view remedy_of(ShotFault fault);

/// What was found out about one image. Figures that do not apply are 0.
struct ShotFigures {
  int found = 0;                ///< lines or dots
  int expected = 0;             ///< lines; 0: dots, whose number is not fixed
  double brightness = 0.0;      ///< share of full scale, of lines or dots above the rest, median
  double saturated = 0.0;       ///< share of them that is clipped
  double width_px = 0.0;        ///< of the lines, median; of the edges of the dots
  double depth_error_mm = 0.0;  ///< how far from its depth the plane seems to be
};

struct ShotVerdict {
  ShotFault fault = ShotFault::kNone;
  std::string finding;  ///< what was seen, with its numbers; empty for a good shot
  ShotFigures figures;
  [[nodiscard]] bool good() const { return fault == ShotFault::kNone; }
};

[[nodiscard]] ShotVerdict refuse(ShotFault fault, std::string finding,
                                 const ShotFigures& figures = {});

}  // namespace flytri::calibration
