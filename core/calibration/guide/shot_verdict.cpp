#include "core/calibration/guide/shot_verdict.h"

#include <utility>

namespace flytri::calibration {

std::string_view remedy_of(ShotFault fault) {
  switch (fault) {
    case ShotFault::kNone:
      return "";
    case ShotFault::kWrongImage:
      return "Set the camera to the format and image size that the session started with.";
    case ShotFault::kStrayLight:
      return "Turn off or move the lamp, and remove or tilt objects that reflect light.";
    case ShotFault::kLightStaysOn:
      return "Check the cables of the projectors: a light that stays on is connected wrongly.";
    case ShotFault::kTooDark:
      return "Increase the exposure time, open the aperture, or check that the light falls on the "
             "target.";
    case ShotFault::kSaturated:
      return "Reduce the exposure time or the gain.";
    case ShotFault::kDefocused:
      return "Clean the lenses. Focus camera and projectors on the front of the volume and lock "
             "them. If the focus was changed, start the session again.";
    case ShotFault::kLinesMissing:
      return "Clean the white plane. Check that it fills the image and has no shadow on it.";
    case ShotFault::kOtherPattern:
      return "Swap the cables of the vertical and the horizontal projector, or their lines in "
             "rig.json.";
    case ShotFault::kRoomLightChanged:
      return "Do not change the room light while the images of a plane are taken.";
    case ShotFault::kPlaneMoved:
      return "Wait until the stage is at rest, lock it, and do not touch it during the shots.";
    case ShotFault::kWrongDepth:
      return "Set the stage to the requested depth. If it is already there, an earlier plane was "
             "wrong: go back and take that plane again.";
    case ShotFault::kMovedSideways:
      return "Put the target back into its holder as before. The stage must move it only in depth.";
    case ShotFault::kNoDots:
      return "Insert the dot target so that it faces the sensor and fills the image. Clean and "
             "uncover it.";
    case ShotFault::kMarkersHidden:
      return "Uncover and clean the three large dots near the center of the target.";
    case ShotFault::kMirrored:
      return "Turn the target around: its dots must face the sensor.";
  }
  return "";
}

ShotVerdict refuse(ShotFault fault, std::string finding, const ShotFigures& figures) {
  return {fault, std::move(finding), figures};
}

}  // namespace flytri::calibration
