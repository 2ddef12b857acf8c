#include "tests/hardware/scan/calibration_run.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "core/base/workers.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "hw/rig/rig_file.h"
#include "hw/shots/rig_shots.h"
#include "hw/shots/simulated_shots.h"
#include "tests/hardware/scan/vm_rig.h"
#include "tests/hardware/usb/jpeg.h"

namespace flytri::scan {
namespace {

namespace fs = std::filesystem;

/// Largest allowed ratio of the residuals: images have only 8 bits before averaging, and color
/// images are compressed.
constexpr double kAsGood = 1.2;

std::string_view file_of(calibration::ShotKind kind) {
  switch (kind) {
    case calibration::ShotKind::kDark:
      return "dark.grey";
    case calibration::ShotKind::kVertical:
    case calibration::ShotKind::kVerticalAgain:
      return "vertical.grey";
    case calibration::ShotKind::kHorizontal:
      return "horizontal.grey";
    case calibration::ShotKind::kDots:
      return "flash.grey";
    case calibration::ShotKind::kDotsTexture:
      break;
  }
  return "flash.jpg";
}

Result<void> write_picture(const fs::path& file, const cv::Mat& image) {
  const std::size_t bytes = image.total() * image.elemSize();
  if (image.channels() == 1)
    return io::write_file(file, {reinterpret_cast<const char*>(image.data), bytes});
  const usb::Bytes jpeg = usb::encode_jpeg(
      {image.data, bytes},
      {static_cast<std::uint32_t>(image.cols), static_cast<std::uint32_t>(image.rows)});
  return io::write_file(file, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

/// Writes the images of one target at one depth.
Result<void> write_placement(const fs::path& folder, const simulated::CalibrationCamera& camera,
                             calibration::TargetFace face, double z_mm) {
  if (auto made = io::create_folder(folder); !made) return made;
  std::uint64_t stream = 0;
  for (const calibration::ShotKind kind : calibration::shots_of(face, true)) {
    // The second vertical shot uses the same pictures as the first.
    if (kind == calibration::ShotKind::kVerticalAgain) continue;
    for (int i = 0; i < shots::RigShotOptions().exposures; ++i) {
      const auto file = folder / fmt::format("{}_{}", i, file_of(kind));
      auto written = write_picture(file, camera.take(kind, z_mm, stream++));
      if (!written) return written;
    }
  }
  return {};
}

struct Residual {
  const char* name;
  const char* unit;
  double rms;
};

std::array<Residual, 6> residuals_of(const calibration::Calibration& calibration) {
  constexpr double kMicrons = 1e3;
  const auto depth = [&](Pattern pattern) {
    return kMicrons * calibration.of(pattern).depth_residual_mm.rms;
  };
  return {Residual{"Z vertical", "µm", depth(Pattern::kVertical)},
          Residual{"Z horizontal", "µm", depth(Pattern::kHorizontal)},
          Residual{"X", "µm", kMicrons * calibration.x_mm.residual.rms},
          Residual{"Y", "µm", kMicrons * calibration.y_mm.residual.rms},
          Residual{"U", "px", calibration.texture_u_px.residual.rms},
          Residual{"V", "px", calibration.texture_v_px.residual.rms}};
}

}  // namespace

Result<void> write_targets(const fs::path& folder) {
  const auto shots = shots::SimulatedShots::create(simulated::intraoral_sensor());
  if (!shots) return tl::unexpected(shots.error());
  if (auto made = io::create_folder(folder); !made) return made;
  auto written = rig::write_rig(folder / "rig.json", vm_rig((*shots)->sensor(), {}));
  if (written) written = io::write_file(folder / "planes", fmt::format("{}\n", kPlanes));
  if (!written) return written;
  const calibration::CalibrationPlan plan = shots::plan_of((*shots)->sensor(), kPlanes);
  const std::vector<calibration::Placement> placements = calibration::placements_of(plan);
  std::vector<Result<void>> done(placements.size());
  Workers().for_each(placements.size(), [&](std::size_t i) {
    // Different seeds give each placement different noise.
    const auto camera = simulated::CalibrationCamera::create(
        (*shots)->sensor(), {.exposures = 1, .bits = 8, .seed = i + 1});
    done[i] = camera ? write_placement(folder / "pictures" / std::to_string(i + 1), *camera,
                                       placements[i].face, plan.z_mm[placements[i].plane])
                     : tl::unexpected(camera.error());
  });
  for (const Result<void>& each : done)
    if (!each) return each;
  return {};
}

Result<void> check_fits(const fs::path& folder) {
  const auto recorded = io::read_calibration(folder / "recorded" / "calibration.json");
  if (!recorded) return tl::unexpected(recorded.error());
  const auto simulated = io::read_calibration(folder / "simulated" / "calibration.json");
  if (!simulated) return tl::unexpected(simulated.error());
  const auto is = residuals_of(*recorded);
  const auto should = residuals_of(*simulated);
  bool is_as_good = true;
  for (std::size_t i = 0; i < is.size(); ++i) {
    fmt::print("{}: RMS {:.2f} {} recorded, {:.2f} simulated\n", is[i].name, is[i].rms, is[i].unit,
               should[i].rms);
    is_as_good &= is[i].rms <= kAsGood * should[i].rms;
  }
  if (is_as_good) return {};
  return fail(
      ErrorCode::kInconsistent,
      "the residuals of the recorded calibration are too large compared with the simulated one");
}

}  // namespace flytri::scan
