#include "app/cli/case_part.h"

#include <fmt/format.h>

#include <utility>

#include "core/io/models/glb.h"
#include "core/reconstruct/finish_scan.h"

namespace flytri::cli {

Result<Part> load_part(io::CaseFile& file, io::ScanStage stage) {
  const std::string name = fmt::format("{}, stage {}", file.path().string(), to_string(stage));
  const Result<io::StageResult> result = file.load_result(stage);
  if (!result) {
    return fail(result.error().code,
                "{}; make the model with flytri reconstruct {} --stage {} --keep",
                result.error().message, file.path().string(), to_string(stage));
  }
  Result<TexturedMesh> model = io::parse_glb(result->glb, name);
  if (!model) return tl::unexpected(model.error());
  reconstruct::FinishedScan finished = reconstruct::finished_scan_of(*std::move(model));
  const auto plane = file.plane(stage);
  if (!plane) return tl::unexpected(plane.error());
  return Part{name, std::move(finished.surface.mesh), std::move(finished.model), *plane};
}

}  // namespace flytri::cli
