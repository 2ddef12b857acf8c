/// @file  Scan data made from the sample jaw: surfels, holes, images, a finished model.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "hw/simulated/optics/image_simulator.h"
#include "hw/simulated/optics/view_simulator.h"
#include "tests/support/prepared_jaw.h"
#include "ui/state/app_view.h"

namespace flytri::testing {

/// World frame as in a scan: z into the teeth, y to the throat.
class FakeJaw {
 public:
  FakeJaw();

  /// The surface seen so far: most of the arch.
  [[nodiscard]] const SurfelModel& surfels() const { return surfels_; }
  /// Holes in the surfels.
  [[nodiscard]] std::vector<meshing::BoundaryLoop> holes() const;
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> live_frame(Pattern pattern) const;
  /// A texture frame from the same place as the live frames.
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> flash_frame() const { return flash_; }
  /// A frame from another place, as after the tracking was lost.
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> other_frame() const { return other_; }
  [[nodiscard]] Isometry T_world_sensor() const;
  [[nodiscard]] const std::vector<scan::ReentryPlace>& reentry_places() const { return places_; }
  [[nodiscard]] std::shared_ptr<const reconstruct::FinishedScan> result() const { return result_; }
  /// The same, with a tooth prepared for a crown.
  [[nodiscard]] std::shared_ptr<const reconstruct::FinishedScan> prepared() const;
  [[nodiscard]] const PreparedJaw& prepared_jaw() const { return prepared_jaw_; }
  [[nodiscard]] io::Measurement measurement() const;

 private:
  /// Around a ray, on the teeth.
  [[nodiscard]] std::vector<Vec3f> rim_mm(const simulated::Ray& through) const;
  /// The sensor pose at a position on the path, 0..1.
  [[nodiscard]] Isometry sensor_at(double share) const;
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> frame_at(Pattern pattern,
                                                                double share) const;

  [[nodiscard]] SurfelModel seen_until(double share) const;
  [[nodiscard]] std::vector<scan::ReentryPlace> find_places() const;
  [[nodiscard]] std::shared_ptr<const reconstruct::FinishedScan> finish() const;

  TriangleMesh mesh_;  ///< world frame
  std::unique_ptr<simulated::ImageSimulator> images_;
  std::unique_ptr<simulated::ViewSimulator> views_;
  simulated::SensorPath path_;  ///< over the arch, three times
  std::array<std::shared_ptr<const scan::LiveFrame>, 2> frames_;
  std::shared_ptr<const scan::LiveFrame> other_, flash_;
  SurfelModel surfels_;
  std::vector<scan::ReentryPlace> places_;
  std::shared_ptr<const reconstruct::FinishedScan> result_;
  PreparedJaw prepared_jaw_;
};

}  // namespace flytri::testing
