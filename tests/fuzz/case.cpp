/// @file  Any bytes as a case: opened with what is left, or refused, never worse.
#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/interchange/case_file.h"
#include "core/interchange/file_bytes.h"

namespace {

/// A file of this process, gone at its end. In memory where the system has such a folder.
const std::filesystem::path& scratch_file() {
  static const struct Scratch {
    Scratch() {
      std::string folder =
          std::filesystem::exists("/dev/shm") ? "/dev/shm/fuzz-XXXXXX" : "/tmp/fuzz-XXXXXX";
      if (::mkdtemp(folder.data()) == nullptr) std::abort();
      path = std::filesystem::path(folder) / "case.flytri";
    }
    ~Scratch() {
      std::error_code ignored;
      std::filesystem::remove_all(path.parent_path(), ignored);
    }
    std::filesystem::path path;
  } kScratch;
  return kScratch.path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (!flytri::write_file(scratch_file(), bytes)) std::abort();
  auto file = flytri::CaseFile::open(scratch_file());
  if (!file) return 0;
  (void)file->fields();
  (void)file->calibration();
  for (const flytri::ScanStage stage : flytri::kScanStages) {
    (void)file->load_stage(stage);
    (void)file->counts(stage);
    (void)file->load_result(stage);
  }
  return 0;
}
