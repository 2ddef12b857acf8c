#include "app/report/write_report.h"

#include "app/report/report_json.h"
#include "app/report/report_page.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/former_file.h"

namespace flytri::report {

Result<std::string> report_kind(const std::filesystem::path& path) {
  const std::string kind = io::kind_by_name(path);
  if (kind == ".html") return kind;
  if (kind == ".json") return std::string(kScanReportFormat);
  return fail(ErrorCode::kBadOption, "{}: reports are written as .html or .json; rename it",
              path.string());
}

Result<void> write_report(const std::filesystem::path& path, const ScanFacts& facts) {
  const auto kind = report_kind(path);
  if (!kind) return tl::unexpected(kind.error());
  if (*kind != ".html") return io::write_file(path, report_json(facts), io::Access::kOwnerOnly);
  return report_page(facts).and_then(
      [&](const std::string& page) { return io::write_file(path, page, io::Access::kOwnerOnly); });
}

}  // namespace flytri::report
