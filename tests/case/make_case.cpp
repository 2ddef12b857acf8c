/// @file  Makes a case from a recording: its views and texture frames, with or without poses.
/// Usage: flytri_make_case RECORDING CALIBRATION CASE STAGE placed|unplaced
///        flytri_make_case prepared CASE [margin]
/// The second makes one with a finished model, a jaw with a tooth prepared for a crown, and if
/// asked for with its margin line. Prints the middle of that tooth and points of its margin.
/// Creates the case if it does not exist; encrypts it if FLYTRI_PASSPHRASE is set.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/calibrations/calibration_json.h"
#include "core/io/cases/case_file.h"
#include "core/io/models/glb.h"
#include "core/io/recordings/recording.h"
#include "core/measurement/measure_view.h"
#include "core/review/margin.h"
#include "core/review/reviewed.h"
#include "core/tracking/registrar.h"
#include "tests/support/prepared_jaw.h"

namespace flytri {
namespace {

struct Request {
  std::filesystem::path recording, calibration, case_file;
  io::ScanStage stage;
  bool is_placed;
};

Result<io::CaseFile> open_or_create(const std::filesystem::path& path) {
  const char* const passphrase = std::getenv("FLYTRI_PASSPHRASE");
  const io::CaseOptions options{Secret(passphrase == nullptr ? "" : passphrase), false};
  if (std::filesystem::exists(path)) return io::CaseFile::open(path, options);
  io::CaseFields fields;
  fields.patient_name = "Ada Lovelace";
  return io::CaseFile::create(path, options, fields);
}

/// Appends the view or texture of a frame, unless the frame is rejected.
Result<void> keep_frame(io::CaseFile& file, io::ScanStage stage, const Frame& frame,
                        const calibration::Calibration& calibration,
                        tracking::Registrar& registrar) {
  if (frame.kind == FrameKind::kTexture) return file.append_texture(stage, frame);
  Result<measurement::MeasuredView> measured = measurement::measure_view(frame, calibration, {});
  if (!measured) return tl::unexpected(measured.error());
  if (measured->outcome != measurement::MeasureOutcome::kMeasured) return {};
  const auto view = std::make_shared<const View>(std::move(measured->view));
  registrar.add(view);
  return file.append_view(stage, *view);
}

Result<void> place(io::CaseFile& file, io::ScanStage stage, tracking::Registrar& registrar) {
  std::vector<AlignedView> placed;
  for (const tracking::RegisteredView& view : registrar.finish()) {
    if (view.fate != tracking::ViewFate::kRejected)
      placed.push_back({view.view, view.T_world_sensor});
  }
  return file.write_poses(stage, placed);
}

Result<void> make_case(const Request& request) {
  const Result<io::Recording> recording = io::open_recording(request.recording);
  if (!recording) return tl::unexpected(recording.error());
  const Result<calibration::Calibration> calibration = io::read_calibration(request.calibration);
  if (!calibration) return tl::unexpected(calibration.error());
  Result<io::CaseFile> file = open_or_create(request.case_file);
  if (!file) return tl::unexpected(file.error());
  tracking::Registrar registrar = tracking::Registrar::create().value();
  for (std::size_t i = 0; i < recording->frames.size(); ++i) {
    const auto kept = io::load_frame(*recording, FrameIndex(i)).and_then([&](const Frame& frame) {
      return keep_frame(*file, request.stage, frame, *calibration, registrar);
    });
    if (!kept) return kept;
  }
  if (request.is_placed) {
    if (auto placed = place(*file, request.stage, registrar); !placed) return placed;
  }
  return file->write_calibration(io::to_json(*calibration)).and_then([&] {
    return file->commit();
  });
}

std::string text_of(const Vec3& p_mm) {
  return fmt::format("{:.4f},{:.4f},{:.4f}", p_mm.x(), p_mm.y(), p_mm.z());
}

Result<void> make_prepared(const std::filesystem::path& path, bool with_margin) {
  const auto jaw = sample_jaw::make_sample_jaw({}, Workers());
  if (!jaw) return tl::unexpected(jaw.error());
  const testing::PreparedJaw prepared = testing::prepared_jaw(*jaw, Isometry::Identity());
  const auto glb = io::encode_glb({prepared.mesh, {}, {}}, "jaw");
  if (!glb) return tl::unexpected(glb.error());
  Result<io::CaseFile> file = open_or_create(path);
  if (!file) return tl::unexpected(file.error());
  constexpr auto kStage = io::ScanStage::kUpper;
  auto done = file->write_result(kStage, {*glb, "{}", io::ResultBasis{}});
  std::vector<Vec3> clicks_mm;
  for (std::size_t i = 0; i < 5; ++i)
    clicks_mm.push_back(prepared.margin_mm[i * prepared.margin_mm.size() / 5]);
  if (done && with_margin) {
    auto margin = review::find_margin(review::made_ready(prepared.mesh), clicks_mm, {}, Workers());
    if (!margin) return tl::unexpected(margin.error());
    const auto id = file->add_margin(kStage, {0, clicks_mm, *std::move(margin)});
    if (!id) return tl::unexpected(id.error());
  }
  if (done) done = file->commit();
  fmt::print("tooth {}\nmargin", text_of(prepared.tooth_mm));
  for (const Vec3& p_mm : clicks_mm) fmt::print(" {}", text_of(p_mm));
  fmt::print("\n");
  return done;
}

}  // namespace
}  // namespace flytri

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  if (words.size() >= 3 && words[1] == "prepared") {
    const auto made = flytri::make_prepared(words[2], words.size() == 4 && words[3] == "margin");
    fmt::print("{}\n", made ? "made " + words[2] : made.error().message);
    return made ? 0 : 1;
  }
  if (words.size() != 6) return 2;
  const auto stage = flytri::io::stage_named(words[4]);
  if (!stage) return 2;
  const auto made = flytri::make_case({words[1], words[2], words[3], *stage, words[5] == "placed"});
  fmt::print("{}\n", made ? "made " + words[3] : made.error().message);
  return made ? 0 : 1;
}
