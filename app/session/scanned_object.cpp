#include "app/session/scanned_object.h"

#include "assets/sample_face/sample_face.h"
#include "assets/sample_jaw/sample_jaw.h"
#include "core/io/models/model.h"
#include "hw/simulated/optics/sensor_layout.h"

namespace flytri::session {

Result<TriangleMesh> load_object(const ScannedObject& object, const std::string& sensor,
                                 const Workers& workers) {
  if (!object.mesh) {
    if (simulated::is_face_sensor(sensor) && !object.jaw) return sample_face::make_sample_face({});
    return sample_jaw::make_sample_jaw({.kind = object.jaw.value_or(JawKind::kUpper)}, workers);
  }
  Result<TexturedMesh> model = io::read_model(*object.mesh);
  if (!model) return tl::unexpected(model.error());
  return std::move(model->mesh);
}

}  // namespace flytri::session
