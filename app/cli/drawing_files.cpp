#include "app/cli/drawing_files.h"

#include <string>
#include <utility>

#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "core/io/files/atomic_file.h"
#include "core/io/files/former_file.h"

namespace flytri::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSvg = ".svg";
constexpr std::string_view kPdf = ".pdf";

Result<io::AtomicFile> written_but_unnamed(const DrawingFile& file) {
  const auto bytes = io::kind_by_name(file.path) == kPdf ? file.drawing.pdf() : file.drawing.svg();
  if (!bytes) return tl::unexpected(bytes.error());
  auto unnamed = io::AtomicFile::create(file.path);
  if (!unnamed) return unnamed;
  if (auto written = unnamed->write(*bytes); !written) return tl::unexpected(written.error());
  return unnamed;
}

}  // namespace

Result<void> check_drawing_files(const std::vector<fs::path>& files, bool force) {
  std::vector<OtherOutput> outputs;
  for (const fs::path& file : files) {
    if (file.empty()) continue;
    const std::string kind = io::kind_by_name(file);
    if (kind != kSvg && kind != kPdf) {
      return fail(ErrorCode::kBadOption, "{}: drawings are written as .svg or .pdf; rename it",
                  file.string());
    }
    outputs.push_back({file, kind == kPdf ? kPdf : kSvg});
  }
  return check_output_files({}, outputs, force);
}

Result<void> write_drawings(const std::vector<DrawingFile>& files) {
  std::vector<io::AtomicFile> written;
  for (const DrawingFile& file : files) {
    auto unnamed = written_but_unnamed(file);
    if (!unnamed) return tl::unexpected(unnamed.error());
    written.push_back(*std::move(unnamed));
  }
  if (auto committed = io::commit_together(std::move(written)); !committed) return committed;
  for (const DrawingFile& file : files) print_out("wrote {}\n", file.path.string());
  return {};
}

}  // namespace flytri::cli
