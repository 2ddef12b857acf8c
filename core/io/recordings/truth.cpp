#include "core/io/recordings/truth.h"

#include <cmath>
#include <utility>

#include "core/io/files/file_bytes.h"
#include "core/io/files/json_place.h"

namespace flytri::io {
namespace {

constexpr std::string_view kTruthFormat = "flytri.truth";
constexpr int kTruthVersion = 1;

}  // namespace

Result<Truth> parse_truth(std::string_view text, const std::string& name) {
  const Result<JsonPlace> json = JsonPlace::parse(text, name);
  if (!json) return tl::unexpected(json.error());
  json->expect_format(kTruthFormat, kTruthVersion);
  Truth truth;
  truth.mesh = json->at("mesh").text();
  for (const JsonPlace& place : json->at("poses").elements()) {
    truth.poses.push_back({FrameIndex(place.at("frame").whole_number()), place.at("file").text(),
                           place.at("time_s").number(), place.pose()});
  }
  if (Result<void> outcome = json->outcome(); !outcome) return tl::unexpected(outcome.error());
  return truth;
}

Result<Truth> read_truth(const std::filesystem::path& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  Result<Truth> truth = parse_truth(*text, path.string());
  if (truth) truth->mesh = path.parent_path() / truth->mesh;
  return truth;
}

Result<void> write_truth(const std::filesystem::path& path, const Truth& truth) {
  nlohmann::ordered_json json = {{"format", kTruthFormat},
                                 {"version", kTruthVersion},
                                 {"mesh", truth.mesh.generic_string()},
                                 {"poses", nlohmann::ordered_json::array()}};
  for (const TruthPose& pose : truth.poses) {
    const Eigen::Quaterniond q(pose.T_model_sensor.linear());
    const Vec3 t = pose.T_model_sensor.translation();
    json["poses"].push_back({{"frame", pose.frame.value},
                             {"file", pose.file},
                             {"time_s", pose.time_s},
                             {"q_wxyz", {q.w(), q.x(), q.y(), q.z()}},
                             {"t_mm", {t.x(), t.y(), t.z()}}});
  }
  return write_file(path, json.dump(1) + "\n");
}

}  // namespace flytri::io
