// A scan for the USB camera of the virtual machine, and what became of it.
//
//     flytri_hardware_scan take FOLDER      pictures/, rig.json, calibration.json, and simulated/,
//                                           the recording that a perfect rig would make
//     flytri_hardware_scan check FOLDER     that each frame of recorded/ shows what it is said to;
//                                           writes its truth
//     flytri_hardware_scan compare FOLDER   that recorded.json is as good as simulated.json, both
//                                           of flytri evaluate

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/interchange/calibration_file.h"
#include "core/interchange/file_bytes.h"
#include "core/interchange/recording.h"
#include "hw/rig/rig_file.h"
#include "hw/simulated/sensor_calibration.h"
#include "tests/hardware/scan/picture_finder.h"

namespace flytri::scan {
namespace {

namespace fs = std::filesystem;

/// Of the camera. The guest is slow: its clock has three ticks for one of the hand's.
constexpr double kRate_hz = 10.0;
/// Of the moments at which the hand moves: what must have been recorded. Now and then a light is
/// off on purpose, which tells half a period from a whole one.
constexpr double kEnough = 0.85;
/// By how much other frames of the same scan may be worse. As it stands a result hangs on the noise
/// of its first view, which is that of single points, 30 um, over some hundred of them.
struct Gauge {
  const char* name;
  double as_good_mm;
};
constexpr std::array kGauges = {Gauge{"as_it_stands", 0.01}, Gauge{"best_fit", 0.001}};
constexpr double kAsComplete = 0.01;

/// The cameras and chips of tests/hardware/usb.
RigSettings rig_of(const ScanOptions& options) {
  RigSettings rig;
  rig.name = "virtual machine";
  rig.measurement.match.serial = "M0001";
  rig.measurement.settings.size = options.sensor.camera.size;
  rig.measurement.settings.rate_hz = kRate_hz;
  rig.measurement.settings.exposure_s = options.sensor.exposure_s;
  rig.lights.chip.label = "ftdi-cbus";
  rig.lights.vertical.offset = 0;
  rig.lights.horizontal.offset = 1;
  rig.flash_period_s = 3.0;
  rig.calibration = "calibration.json";
  return rig;
}

Result<void> write_simulated(const fs::path& folder, const ScanOptions& options,
                             const ScanPictures& pictures, const Workers& workers) {
  auto writer = RecordingWriter::create(folder, "../calibration.json");
  if (!writer) return tl::unexpected(writer.error());
  std::vector<Shown> shown;
  for (auto i = static_cast<std::size_t>(options.resting); i < pictures.moments().size(); ++i) {
    const bool is_vertical = i % 2 == 0;
    shown.push_back({i, is_vertical ? Pattern::kVertical : Pattern::kHorizontal});
    auto appended =
        writer->append({FrameIndex(), is_vertical ? FrameKind::kVertical : FrameKind::kHorizontal,
                        pictures.moments()[i].time_s,
                        pictures.picture(i, is_vertical ? Light::kVertical : Light::kHorizontal)});
    if (!appended) return appended;
  }
  if (auto closed = writer->write_list(); !closed) return closed;
  return write_scan_truth(folder, pictures, options.sensor, shown, workers);
}

Result<void> take(const fs::path& folder) {
  const Workers workers;
  const ScanOptions options;
  if (auto made = create_folder(folder); !made) return made;
  const auto calibration = kept_sensor_calibration(options.sensor, folder, workers, {});
  if (!calibration) return tl::unexpected(calibration.error());
  auto written = write_calibration(folder / "calibration.json", *calibration);
  if (written) written = write_rig(folder / "rig.json", rig_of(options));
  // The pictures are shown over and over: the recording ends before they begin anew.
  const double duration_s = (options.resting + options.moving - 1) / kRate_hz;
  if (written) written = write_file(folder / "duration", fmt::format("{}\n", duration_s));
  if (!written) return written;
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto drawn = pictures->write(folder / "pictures", workers); !drawn) return drawn;
  return write_simulated(folder / "simulated", options, *pictures, workers);
}

struct Labels {
  std::vector<Shown> shown;  ///< by frame, of those whose label is right
  int other = 0;             ///< the picture is of the other pattern
  int mixed = 0;             ///< no picture: another light got into the exposure
  int backward = 0;          ///< not later than the frame before
};

Result<Labels> read_labels(const Recording& recording, const PictureFinder& finder) {
  Labels labels;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const auto frame = load_frame(recording, FrameIndex(i));
    if (!frame) return tl::unexpected(frame.error());
    const auto shown = finder.find(frame->image);
    labels.mixed += !shown ? 1 : 0;
    labels.other += shown && pattern_of(frame->kind) != shown->pattern ? 1 : 0;
    if (!shown || pattern_of(frame->kind) != shown->pattern) continue;
    if (!labels.shown.empty() && shown->number <= labels.shown.back().number) ++labels.backward;
    labels.shown.push_back(*shown);
  }
  return labels;
}

Result<void> check(const fs::path& folder) {
  const Workers workers;
  const ScanOptions options;
  const auto recording = open_recording(folder / "recorded");
  if (!recording) return tl::unexpected(recording.error());
  const auto count = static_cast<std::size_t>(options.resting + options.moving);
  const auto finder = PictureFinder::read(folder / "pictures", count);
  if (!finder) return tl::unexpected(finder.error());
  const auto labels = read_labels(*recording, *finder);
  if (!labels) return tl::unexpected(labels.error());
  const auto moving =
      std::count_if(labels->shown.begin(), labels->shown.end(), [&](const Shown& shown) {
        return shown.number >= static_cast<std::size_t>(options.resting);
      });
  fmt::print(
      "{} frames recorded: {} under the light of their label, {} under the other, {} under more "
      "than one; {} of {} moments of the moving hand\n",
      recording->frames.size(), labels->shown.size(), labels->other, labels->mixed, moving,
      options.moving);
  if (labels->other + labels->mixed + labels->backward > 0)
    return fail(ErrorCode::kInconsistent, "the recording does not show what it says");
  if (static_cast<double>(moving) < kEnough * options.moving)
    return fail(ErrorCode::kInsufficient, "too little of the scan was recorded");
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  return write_scan_truth(folder / "recorded", *pictures, options.sensor, labels->shown, workers);
}

Result<nlohmann::json> read_evaluation(const fs::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  return nlohmann::json::parse(*text);
}

Result<void> compare(const fs::path& folder) {
  const auto simulated = read_evaluation(folder / "simulated.json");
  if (!simulated) return tl::unexpected(simulated.error());
  const auto recorded = read_evaluation(folder / "recorded.json");
  if (!recorded) return tl::unexpected(recorded.error());
  bool is_as_good = true;
  for (const auto& [gauge, as_good_mm] : kGauges) {
    const auto& should = simulated->at(gauge);
    const auto& is = recorded->at(gauge);
    const auto value = [&](const nlohmann::json& of, const char* key) {
      return of.at(key).get<double>();
    };
    fmt::print("{}: RMS {:.1f} um recorded, {:.1f} simulated; complete {:.2f} %, {:.2f} %\n", gauge,
               1e3 * value(is, "rms_mm"), 1e3 * value(should, "rms_mm"),
               100.0 * value(is, "complete_surface_share"),
               100.0 * value(should, "complete_surface_share"));
    is_as_good &= value(is, "rms_mm") <= value(should, "rms_mm") + as_good_mm;
    is_as_good &= value(is, "complete_surface_share") >=
                  value(should, "complete_surface_share") - kAsComplete;
  }
  if (is_as_good) return {};
  return fail(ErrorCode::kInconsistent, "the recording is worse than the simulated one");
}

Result<void> run(std::string_view word, const fs::path& folder) {
  if (word == "take") return take(folder);
  if (word == "check") return check(folder);
  if (word == "compare") return compare(folder);
  return fail(ErrorCode::kBadOption, "no such word: {}", word);
}

}  // namespace
}  // namespace flytri::scan

int main(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "flytri_hardware_scan take|check|compare FOLDER\n");
    return 2;
  }
  const auto done = flytri::scan::run(words[1], words[2]);
  if (!done) fmt::print(stderr, "{}\n", done.error().message);
  return done ? 0 : 1;
}
