/// @file  A case with any of its bytes changed, cut off anywhere: opened with what is left, or
/// refused, never worse. The input is a list of changes: u32 where, u8 what; the first one cuts.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/cases/case_file.h"
#include "core/io/files/byte_stream.h"
#include "core/io/files/file_bytes.h"
#include "tests/fuzz/scratch.h"

namespace flytri {
namespace {

namespace fs = std::filesystem;
constexpr io::ScanStage kStage = io::ScanStage::kUpper;

bool fill(io::CaseFile& file) {
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 1.0, {editing::BrushDab{}}});
  bool done = file.write_edits(kStage, edits) && file.write_calibration("{}") &&
              file.write_result(kStage, {"glb", "{}"}) && file.add_measurement(kStage, {});
  for (int i = 0; i < 40; ++i) {
    // Some fill several pages.
    const std::size_t point_count = i % 8 == 0 ? 2000 : 2;
    const Profile profile{LineIndex(0), Vec3::UnitX(), std::vector<ProfilePoint>(point_count)};
    done = done && file.append_view(kStage, {Pattern::kVertical, FrameIndex(i), 0.0, {profile}});
  }
  // The stage has two scans, of which one is kept.
  return done && file.clear_stage(kStage) && file.bring_back_stage(kStage) && file.commit();
}

std::string whole_case(const fs::path& path) {
  {
    auto file = io::CaseFile::create(path, {});
    if (!file || !fill(*file)) std::abort();
  }
  return io::read_file(path).value();
}

std::string changed(std::string bytes, std::string_view changes) {
  io::ByteReader reader(changes);
  const auto size = reader.number<std::uint32_t>();
  if (size && *size != 0) bytes.resize(*size % bytes.size());
  while (!bytes.empty()) {
    const auto at = reader.number<std::uint32_t>();
    const auto value = reader.number<char>();
    if (!value) break;
    bytes[*at % bytes.size()] = *value;
  }
  return bytes;
}

/// Of what can be read, a copy without damage is made.
void rescue(io::CaseFile& file, const fs::path& path) {
  fs::remove(path);
  if (!file.rescue_to(path)) return;
  auto copy = io::CaseFile::open(path);
  if (!copy || !copy->survey() || copy->is_damaged()) std::abort();
}

void read_all(const fs::path& path) {
  auto file = io::CaseFile::open(path);
  if (!file) return;
  (void)file->fields();
  (void)file->calibration();
  for (const io::ScanStage stage : io::kScanStages) {
    (void)file->counts(stage);
    (void)file->load_stage(stage);
    (void)file->load_result(stage);
    (void)file->kept_counts(stage);
  }
  rescue(*file, path.string() + ".rescued.flytri");
}

}  // namespace
}  // namespace flytri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const flytri::Scratch kScratch;
  static const std::string kWhole = flytri::whole_case(kScratch.file());
  const std::string_view changes(reinterpret_cast<const char*>(data), size);
  if (!flytri::io::write_file(kScratch.file(), flytri::changed(kWhole, changes))) std::abort();
  flytri::read_all(kScratch.file());
  return 0;
}
