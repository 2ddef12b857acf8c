// Creates images for the USB cameras of the virtual machine, and checks what the program makes of
// them there.
//
//     flytri_hardware_scan take FOLDER      writes pictures/, rig.json, calibration.json, and
//                                           simulated/, the recording of a perfect rig
//     flytri_hardware_scan check FOLDER     checks the labels of all frames of recorded/ and writes
//                                           its truth. Run it once only: it changes the frame times
//     flytri_hardware_scan compare FOLDER   checks that recorded.json is as good as simulated.json;
//                                           both are reports of flytri evaluate
//     flytri_hardware_scan guide FOLDER     writes pictures/ for docs/building.md
//     flytri_hardware_scan truth FOLDER     writes the truth of scan/, once only, as above
//     flytri_hardware_scan judge FOLDER     checks what was made by the guide (guide_run.h)

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"
#include "core/io/recordings/recording.h"
#include "hw/rig/rig_file.h"
#include "hw/simulated/datasets/sensor_calibration.h"
#include "tests/hardware/scan/guide_run.h"
#include "tests/hardware/scan/picture_finder.h"
#include "tests/hardware/scan/vm_rig.h"

namespace flytri::scan {
namespace {

namespace fs = std::filesystem;

/// Duration of a flash in frames. The cameras are not synchronized, so two are needed to contain a
/// whole exposure of the texture camera.
constexpr int kFlashFrames = 2;
/// Share of the moments with a moving hand and a pattern that must have been recorded.
constexpr double kEnough = 0.85;
/// Largest time error of a texture frame: half of the time between two moments, so that the moment
/// is unique. It includes the camera's delay of a quarter of that time.
constexpr double kTextureOff_s = 0.5 / kRate_hz;
/// Largest allowed increase of an error, mm. "as_it_stands" depends on the noise of the first view,
/// which is that of single points (30 µm) averaged over some hundred of them.
struct Gauge {
  const char* name;
  double as_good_mm;
};
constexpr std::array kGauges = {Gauge{"as_it_stands", 0.01}, Gauge{"best_fit", 0.001}};
constexpr double kAsComplete = 0.01;
/// Largest allowed increase of the chromaticity error; the images are compressed.
constexpr double kAsColored = 0.005;

/// Kind of each exposure: the patterns alternate; of the exposures under a flash, one is used and
/// the others are skipped.
std::optional<FrameKind> kind_of(std::size_t number) {
  constexpr auto kPeriod = static_cast<std::size_t>(kFlashPeriod_s * kRate_hz);
  const std::size_t since_flash = number % kPeriod;
  if (since_flash == 0) return FrameKind::kTexture;
  if (since_flash < kFlashFrames) return std::nullopt;
  return number % 2 == 0 ? FrameKind::kVertical : FrameKind::kHorizontal;
}

Result<void> write_simulated(const fs::path& folder, const ScanOptions& options,
                             const ScanPictures& pictures, const Workers& workers) {
  auto writer = io::RecordingWriter::create(folder, "../calibration.json");
  if (!writer) return tl::unexpected(writer.error());
  std::vector<Shown> shown;
  for (auto i = static_cast<std::size_t>(options.resting); i < pictures.moments().size(); ++i) {
    const auto kind = kind_of(i);
    if (!kind) continue;
    shown.push_back({i, *kind});
    auto appended = writer->append(
        {FrameIndex(), *kind, pictures.moments()[i].time_s, pictures.picture(i, *kind)});
    if (!appended) return appended;
  }
  if (auto closed = writer->write_list(); !closed) return closed;
  return write_scan_truth(folder, pictures, options.sensor, shown, workers);
}

Result<void> take(const fs::path& folder) {
  const Workers workers;
  const ScanOptions options;
  if (auto made = io::create_folder(folder); !made) return made;
  const auto calibration =
      simulated::cached_sensor_calibration(options.sensor, {folder, {}}, workers, {});
  if (!calibration) return tl::unexpected(calibration.error());
  auto written = io::write_calibration(folder / "calibration.json", *calibration);
  if (written)
    written = rig::write_rig(folder / "rig.json", vm_rig(options.sensor, "calibration.json"));
  // The pictures repeat: the recording must end before they start again.
  const double duration_s = (options.resting + options.moving - 1) / kRate_hz;
  if (written) written = io::write_file(folder / "duration", fmt::format("{}\n", duration_s));
  if (!written) return written;
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto drawn = pictures->write(folder / "pictures", workers); !drawn) return drawn;
  return write_simulated(folder / "simulated", options, *pictures, workers);
}

struct Labels {
  std::vector<Shown> shown;    ///< for each correctly labeled frame
  std::vector<double> time_s;  ///< for each of these frames
  int other = 0;               ///< frames that show another light
  int mixed = 0;               ///< frames that show more than one light
  int backward = 0;            ///< frames not later than the one before
};

/// Each camera shows each moment once. Just before and after a flash, both cameras may show the
/// same.
bool is_backward(const Shown& before, const Shown& shown) {
  const bool is_same_camera =
      (before.kind == FrameKind::kTexture) == (shown.kind == FrameKind::kTexture);
  return shown.number < before.number || (is_same_camera && shown.number == before.number);
}

Result<Labels> read_labels(const io::Recording& recording, const PictureFinder& finder) {
  Labels labels;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const auto frame = io::load_frame(recording, FrameIndex(i));
    if (!frame) return tl::unexpected(frame.error());
    const auto shown = finder.find(frame->image);
    labels.mixed += !shown ? 1 : 0;
    labels.other += shown && frame->kind != shown->kind ? 1 : 0;
    if (!shown || frame->kind != shown->kind) continue;
    if (!labels.shown.empty() && is_backward(labels.shown.back(), *shown)) ++labels.backward;
    labels.shown.push_back(*shown);
    labels.time_s.push_back(frame->time_s);
  }
  return labels;
}

/// Number of frames with a moving hand.
int count_moving(const Labels& labels, const ScanOptions& options, bool texture) {
  return static_cast<int>(
      std::count_if(labels.shown.begin(), labels.shown.end(), [&](const Shown& shown) {
        return (shown.kind == FrameKind::kTexture) == texture &&
               shown.number >= static_cast<std::size_t>(options.resting);
      }));
}

/// Largest difference between the time of a texture frame and that of its moment, which is computed
/// from the last frame of the other camera before it.
double texture_off_s(const Labels& labels) {
  double off_s = 0.0;
  std::optional<std::size_t> pattern;
  for (std::size_t i = 0; i < labels.shown.size(); ++i) {
    if (labels.shown[i].kind != FrameKind::kTexture) {
      pattern = i;
    } else if (pattern) {
      const double moments = static_cast<double>(labels.shown[i].number) -
                             static_cast<double>(labels.shown[*pattern].number);
      const double since_s = labels.time_s[i] - labels.time_s[*pattern];
      off_s = std::max(off_s, std::abs(since_s - moments / kRate_hz));
    }
  }
  return off_s;
}

Result<void> judge(const Labels& labels, const ScanOptions& options) {
  const int patterns = count_moving(labels, options, false);
  const int textures = count_moving(labels, options, true);
  const auto flashes = static_cast<int>(options.moving / (kFlashPeriod_s * kRate_hz));
  const int wanted = options.moving - flashes * kFlashFrames;
  const double off_s = texture_off_s(labels);
  fmt::print(
      "{} frames show what their label says, bit for bit; {} show another light, {} more than one, "
      "{} an earlier moment than the frame before\n"
      "frames with a moving hand: {} under a pattern, {} expected; {} under the flash, {} "
      "expected, "
      "with time errors of at most {:.0f} ms\n",
      labels.shown.size(), labels.other, labels.mixed, labels.backward, patterns, wanted, textures,
      flashes, 1e3 * off_s);
  if (labels.other + labels.mixed + labels.backward > 0 || off_s > kTextureOff_s)
    return fail(ErrorCode::kInconsistent,
                "the recording has frames with a wrong label or a wrong time");
  // One flash may be missing at the ends of the scan; and the first flashes only teach the latency
  // of the texture camera.
  if (patterns < kEnough * wanted || textures < flashes - 2)
    return fail(ErrorCode::kInsufficient, "too few frames of the scan were recorded");
  return {};
}

Result<void> check(const fs::path& folder) {
  const Workers workers;
  const ScanOptions options;
  const auto recording = io::open_recording(folder / "recorded");
  if (!recording) return tl::unexpected(recording.error());
  const auto count = static_cast<std::size_t>(options.resting + options.moving);
  const auto finder =
      PictureFinder::read(folder / "pictures", count, options.sensor.texture_camera.size);
  if (!finder) return tl::unexpected(finder.error());
  const auto labels = read_labels(*recording, *finder);
  if (!labels) return tl::unexpected(labels.error());
  if (auto good = judge(*labels, options); !good) return good;
  const double pace = options.sensor.frame_period_s * kRate_hz;
  if (auto paced = set_pace(recording->folder, pace); !paced) return paced;
  const auto pictures = ScanPictures::create(options, workers);
  if (!pictures) return tl::unexpected(pictures.error());
  return write_scan_truth(folder / "recorded", *pictures, options.sensor, labels->shown, workers);
}

Result<nlohmann::json> read_evaluation(const fs::path& file) {
  const auto text = io::read_file(file);
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
    fmt::print("{}: RMS {:.1f} µm recorded, {:.1f} simulated; complete {:.2f} %, {:.2f} %\n", gauge,
               1e3 * value(is, "rms_mm"), 1e3 * value(should, "rms_mm"),
               100.0 * value(is, "complete_surface_share"),
               100.0 * value(should, "complete_surface_share"));
    is_as_good &= value(is, "rms_mm") <= value(should, "rms_mm") + as_good_mm;
    is_as_good &= value(is, "complete_surface_share") >=
                  value(should, "complete_surface_share") - kAsComplete;
  }
  const auto color = [](const nlohmann::json& of, const char* key) {
    return of.at("color").at(key).get<double>();
  };
  fmt::print("color: median {:.4f} recorded, {:.4f} simulated; of other places {:.4f}\n",
             color(*recorded, "median"), color(*simulated, "median"),
             color(*recorded, "median_by_chance"));
  is_as_good &= color(*recorded, "median") <= color(*simulated, "median") + kAsColored;
  if (is_as_good) return {};
  return fail(ErrorCode::kInconsistent,
              "the results of the recording are worse than those of the simulated one");
}

Result<void> run(std::string_view word, const fs::path& folder) {
  if (word == "take") return take(folder);
  if (word == "check") return check(folder);
  if (word == "compare") return compare(folder);
  if (word == "guide") return write_guide(folder, Workers());
  if (word == "truth") return write_guide_truth(folder, Workers());
  if (word == "judge") return judge_guide(folder);
  return fail(ErrorCode::kBadOption, "unknown command: {}", word);
}

}  // namespace
}  // namespace flytri::scan

int main(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "usage: flytri_hardware_scan take|check|compare|guide|truth|judge FOLDER\n");
    return 2;
  }
  const auto done = flytri::scan::run(words[1], words[2]);
  if (!done) fmt::print(stderr, "{}\n", done.error().message);
  return done ? 0 : 1;
}
