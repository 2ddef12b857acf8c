/// @file  A case out of a recording: its views and texture frames, placed as far as one asks for.
/// Usage: flytri_make_case RECORDING CALIBRATION CASE STAGE placed|unplaced
/// The case is made if there is none; FLYTRI_PASSPHRASE encrypts it.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/interchange/calibration_file.h"
#include "core/interchange/calibration_json.h"
#include "core/interchange/case_file.h"
#include "core/interchange/recording.h"
#include "core/pipeline/measure_view.h"
#include "core/pipeline/registrar.h"

namespace flytri {
namespace {

struct Wish {
  std::filesystem::path recording, calibration, case_file;
  ScanStage stage;
  bool is_placed;
};

Result<CaseFile> open_or_create(const std::filesystem::path& path) {
  const char* const passphrase = std::getenv("FLYTRI_PASSPHRASE");
  const CaseOptions options{passphrase == nullptr ? "" : passphrase, false};
  if (std::filesystem::exists(path)) return CaseFile::open(path, options);
  CaseFields fields;
  fields.patient_name = "Ada Lovelace";
  return CaseFile::create(path, options, fields);
}

/// Appends what a frame became, if it became anything.
Result<void> keep_frame(CaseFile& file, ScanStage stage, const Frame& frame,
                        const Calibration& calibration, Registrar& registrar) {
  if (frame.kind == FrameKind::kTexture) return file.append_texture(stage, frame);
  Result<MeasuredView> measured = measure_view(frame, calibration, {});
  if (!measured) return tl::unexpected(measured.error());
  if (measured->outcome != MeasureOutcome::kMeasured) return {};
  const auto view = std::make_shared<const View>(std::move(measured->view));
  registrar.add(view);
  return file.append_view(stage, *view);
}

Result<void> place(CaseFile& file, ScanStage stage, Registrar& registrar) {
  std::vector<AlignedView> placed;
  for (const RegisteredView& view : registrar.finish()) {
    if (view.fate != ViewFate::kRejected) placed.push_back({view.view, view.T_world_sensor});
  }
  return file.write_poses(stage, placed);
}

Result<void> make_case(const Wish& wish) {
  const Result<Recording> recording = open_recording(wish.recording);
  if (!recording) return tl::unexpected(recording.error());
  const Result<Calibration> calibration = read_calibration(wish.calibration);
  if (!calibration) return tl::unexpected(calibration.error());
  Result<CaseFile> file = open_or_create(wish.case_file);
  if (!file) return tl::unexpected(file.error());
  Registrar registrar = Registrar::create().value();
  for (std::size_t i = 0; i < recording->frames.size(); ++i) {
    const auto kept = load_frame(*recording, FrameIndex(i)).and_then([&](const Frame& frame) {
      return keep_frame(*file, wish.stage, frame, *calibration, registrar);
    });
    if (!kept) return kept;
  }
  if (wish.is_placed) {
    if (auto placed = place(*file, wish.stage, registrar); !placed) return placed;
  }
  return file->write_calibration(to_json(*calibration)).and_then([&] { return file->commit(); });
}

}  // namespace
}  // namespace flytri

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  if (words.size() != 6) return 2;
  const flytri::ScanStage stage =
      words[4] == "upper" ? flytri::ScanStage::kUpper : flytri::ScanStage::kLower;
  const auto made = flytri::make_case({words[1], words[2], words[3], stage, words[5] == "placed"});
  fmt::print("{}\n", made ? "made " + words[3] : made.error().message);
  return made ? 0 : 1;
}
