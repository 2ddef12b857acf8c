#include "app/report/report_json.h"

#include <nlohmann/json.hpp>

#include "app/report/coverage_figures.h"
#include "app/report/span_json.h"

namespace flytri::report {
namespace {

using Json = nlohmann::ordered_json;

Json patient_json(const io::CaseFields& fields) {
  return {{"name", fields.patient_name},
          {"number", fields.patient_id},
          {"birth_date", fields.birth_date},
          {"dentist", fields.clinician},
          {"case_created", fields.created}};
}

Json coverage_json(const CoverageFigures& figures) {
  return {{"surface_mm2", figures.surface_mm2},
          {"sigma_median_mm", figures.sigma_median_mm},
          {"sigma_95_mm", figures.sigma_95_mm},
          {"vertices_not_measured", figures.not_measured}};
}

Json hole_json(const meshing::BoundaryLoop& hole) {
  return {{"width_mm", hole.width_mm},
          {"area_mm2", hole.area_mm2},
          {"center_mm", {hole.center_mm.x(), hole.center_mm.y(), hole.center_mm.z()}}};
}

Json calibration_json(const CalibrationFacts& facts) {
  Json json = {{"fingerprint", facts.fingerprint},
               {"vertical_rms_mm", facts.vertical_rms_mm},
               {"horizontal_rms_mm", facts.horizontal_rms_mm}};
  if (!facts.history.made_at.empty()) json["made_at"] = facts.history.made_at;
  if (!facts.history.note.empty()) json["note"] = facts.history.note;
  const calibration::CalibrationCheck* check = facts.history.last_check();
  if (check == nullptr) return json;
  json["checked_at"] = check->at;
  json["check"] = check->has_passed ? "passed" : "failed";
  if (!check->note.empty()) json["check_note"] = check->note;
  return json;
}

}  // namespace

std::string report_json(const ScanFacts& facts) {
  Json json = {{"format", kScanReportFormat},
               {"version", 1},
               {"program", facts.program},
               {"made_at", facts.made_at},
               {"source", facts.source}};
  if (facts.patient) json["patient"] = patient_json(*facts.patient);
  if (facts.stage) json["stage"] = to_string(*facts.stage);
  json[kDistancesKey] = to_json(facts.spans);
  json["coverage"] = coverage_json(coverage_figures(facts.surface.mesh));
  json["frames"] = {{"used", facts.registered}, {"rejected", facts.rejected}};
  json["holes"] = Json::array();
  for (const auto& hole : facts.holes()) {
    json["holes"].push_back(hole_json(hole));
  }
  json["calibration"] = calibration_json(facts.calibration);
  json["edits"] = {
      {"trims", facts.edits.trims}, {"locks", facts.edits.locks}, {"unlocks", facts.edits.unlocks}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace flytri::report
