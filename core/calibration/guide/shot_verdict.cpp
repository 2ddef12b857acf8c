#include "core/calibration/guide/shot_verdict.h"

#include <utility>

namespace flytri::calibration {

std::string_view remedy_of(ShotFault fault) {
  switch (fault) {
    case ShotFault::kNone:
      return "";
    case ShotFault::kWrongImage:
      return "Set the camera to the format and size that the session began with.";
    case ShotFault::kStrayLight:
      return "Turn off or move the lamp, and tilt what reflects out of sight.";
    case ShotFault::kLightStaysOn:
      return "Check the cable of the projectors; a light that never goes dark is wired wrong.";
    case ShotFault::kTooDark:
      return "Lengthen the exposure, open the lens, or check that the light shines on the target.";
    case ShotFault::kSaturated:
      return "Shorten the exposure or lower the gain.";
    case ShotFault::kDefocused:
      return "Clean the lenses, focus camera and projectors on the front of the volume and fix "
             "them; a session begun with another focus must be started anew.";
    case ShotFault::kLinesMissing:
      return "Clean the white plane, see that it fills the image, and that nothing shades it.";
    case ShotFault::kOtherPattern:
      return "Swap the cables of the vertical and the horizontal projector, or their lines in "
             "rig.json.";
    case ShotFault::kRoomLightChanged:
      return "Keep the light of the room as it is while a plane is taken.";
    case ShotFault::kPlaneMoved:
      return "Let the stage settle, lock it, and touch nothing while the lights change.";
    case ShotFault::kWrongDepth:
      return "Set the stage to the depth that is asked for. If it stands there, one of the planes "
             "before was wrong: go back and take it again.";
    case ShotFault::kMovedSideways:
      return "Put the target back into its holder as it was; the stage moves it in depth alone.";
    case ShotFault::kNoDots:
      return "Put the dot target in, facing the sensor, so that it fills the image; clean it and "
             "uncover it.";
    case ShotFault::kMarkersHidden:
      return "Uncover the three large dots near the middle of the target, and clean them.";
    case ShotFault::kMirrored:
      return "Turn the target: its dots must face the sensor.";
  }
  return "";
}

ShotVerdict refuse(ShotFault fault, std::string finding, const ShotFigures& figures) {
  return {fault, std::move(finding), figures};
}

}  // namespace flytri::calibration
