#include "app/session/scanned_object.h"

#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/models/model.h"

namespace flytri::session {

Result<TriangleMesh> load_object(const ScannedObject& object, const Workers& workers) {
  if (!object.mesh) return sample_jaw::make_sample_jaw({.kind = object.jaw}, workers);
  Result<TexturedMesh> model = io::read_model(*object.mesh);
  if (!model) return tl::unexpected(model.error());
  return std::move(model->mesh);
}

}  // namespace flytri::session
