/// @file  The sample jaw as a scan would have it: surfels, holes, images, a finished model.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "hw/simulated/optics/image_simulator.h"
#include "hw/simulated/optics/view_simulator.h"
#include "ui/state/app_view.h"

namespace flytri::testing {

/// World: z into the teeth, y to the throat, as the first view of a scan has it.
class FakeJaw {
 public:
  FakeJaw();

  /// What was seen of the arch, most of it.
  [[nodiscard]] const SurfelModel& surfels() const { return surfels_; }
  /// Places left out of the surfels.
  [[nodiscard]] std::vector<meshing::BoundaryLoop> holes() const;
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> live_frame(Pattern pattern) const;
  /// From the same place as the live frames, by the flash.
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> flash_frame() const;
  /// From another place, as after a loss.
  [[nodiscard]] std::shared_ptr<const scan::LiveFrame> other_frame() const { return other_; }
  [[nodiscard]] Isometry T_world_sensor() const;
  [[nodiscard]] const std::vector<scan::ReentryPlace>& reentry_places() const { return places_; }
  [[nodiscard]] std::shared_ptr<const reconstruct::FinishedScan> result() const { return result_; }
  [[nodiscard]] io::Measurement measurement() const;

 private:
  /// By the share of the path: 0..1.
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
  std::shared_ptr<const scan::LiveFrame> other_;
  SurfelModel surfels_;
  std::vector<scan::ReentryPlace> places_;
  std::shared_ptr<const reconstruct::FinishedScan> result_;
};

}  // namespace flytri::testing
