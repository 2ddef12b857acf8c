#include "core/io/cases/case_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/io/cases/view_codec.h"
#include "core/io/files/byte_stream.h"
#include "core/io/files/json_place.h"
#include "core/io/files/png.h"
#include "core/io/recordings/frame_kind.h"

namespace flytri::io {
namespace {

/// The keys of the fields.
constexpr std::array<std::pair<const char*, std::string CaseFields::*>, 6> kFieldKeys = {{
    {"patient_name", &CaseFields::patient_name},
    {"patient_id", &CaseFields::patient_id},
    {"birth_date", &CaseFields::birth_date},
    {"clinician", &CaseFields::clinician},
    {"notes", &CaseFields::notes},
    {"created", &CaseFields::created},
}};

/// The name of a record in messages about its JSON. The name of the record stands before it.
constexpr const char* kRecord = "damaged";

/// Replaces bytes that are not UTF-8, so that they do not cost the rest of the text.
std::string json_text(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Leaves the key out if the text is empty.
void put_text(nlohmann::json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}
std::string take_text(const JsonPlace& json, const char* key) {
  return json.has(key) ? json.at(key).text() : std::string();
}

Vec3 take_point(const JsonPlace& place) {
  const std::vector<double> numbers = place.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

constexpr auto kPlaneKey = "occlusal_points_mm";

tl::unexpected<Error> bad_size(std::size_t size) {
  return fail(ErrorCode::kBadFormat, "damaged: {} bytes do not fit", size);
}

constexpr std::size_t kDabSize = 7 * sizeof(float);

void put_dab(std::string& bytes, const editing::BrushDab& dab) {
  for (const float part : dab.center_mm) append_number(bytes, part);
  for (const float part : dab.normal) append_number(bytes, part);
  append_number(bytes, dab.radius_mm);
}

/// The caller has checked that there are enough bytes.
editing::BrushDab take_dab(ByteReader& reader) {
  editing::BrushDab dab;
  for (float& part : dab.center_mm) part = reader.number<float>().value_or(0.0F);
  for (float& part : dab.normal) part = reader.number<float>().value_or(0.0F);
  dab.radius_mm = reader.number<float>().value_or(0.0F);
  return dab;
}

/// Whether a sensor can have measured the points.
bool is_measurable(const View& view) {
  constexpr double kFarthest_mm = 1e4;
  const auto is_near = [&](const ProfilePoint& point) {
    return (point.position_mm.array().abs() <= kFarthest_mm).all() &&
           (point.deviation_mm.array().abs() <= static_cast<float>(kFarthest_mm)).all();
  };
  return std::isfinite(view.time_s) &&
         std::all_of(view.profiles.begin(), view.profiles.end(), [&](const Profile& profile) {
           return profile.line.value >= 0 && profile.sheet_normal.allFinite() &&
                  std::all_of(profile.points.begin(), profile.points.end(), is_near);
         });
}

}  // namespace

std::string encode_fields(const CaseFields& fields) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [key, field] : kFieldKeys) put_text(json, key, fields.*field);
  return json_text(json);
}

Result<CaseFields> decode_fields(std::string_view bytes) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, kRecord);
  if (!json) return tl::unexpected(json.error());
  CaseFields fields;
  for (const auto& [key, field] : kFieldKeys) fields.*field = take_text(*json, key);
  return json->outcome().map([&] { return fields; });
}

std::string encode_frame(const StoredFrame& frame) {
  nlohmann::json json = {{"time_s", frame.time_s}, {"kind", to_string(frame.kind)}};
  put_text(json, "fate", frame.fate);
  put_text(json, "reason", frame.reason);
  return json_text(json);
}

Result<StoredFrame> decode_frame(std::string_view bytes, FrameIndex index) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, kRecord);
  if (!json) return tl::unexpected(json.error());
  StoredFrame frame{index, json->at("time_s").number(), read_frame_kind(json->at("kind")),
                    take_text(*json, "fate"), take_text(*json, "reason")};
  return json->outcome().map([&] { return frame; });
}

std::string encode_measurement(const Measurement& measurement) {
  const Vec3 &a = measurement.from_mm, &b = measurement.to_mm;
  nlohmann::json json = {{"from_mm", {a.x(), a.y(), a.z()}}, {"to_mm", {b.x(), b.y(), b.z()}}};
  put_text(json, "label", measurement.label);
  return json_text(json);
}

Result<Measurement> decode_measurement(std::string_view bytes, std::int64_t id) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, kRecord);
  if (!json) return tl::unexpected(json.error());
  Measurement measurement{id, take_point(json->at("from_mm")), take_point(json->at("to_mm")),
                          take_text(*json, "label")};
  return json->outcome().map([&] { return measurement; });
}

std::string encode_plane(const OcclusalPoints& points) {
  nlohmann::json numbers = nlohmann::json::array();
  for (const Vec3& point : points) {
    for (const double number : point) numbers.push_back(number);
  }
  return nlohmann::json{{kPlaneKey, numbers}}.dump();
}

Result<OcclusalPoints> decode_plane(std::string_view bytes) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, kRecord);
  if (!json) return tl::unexpected(json.error());
  OcclusalPoints points;
  const std::vector<double> numbers = json->at(kPlaneKey).numbers(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return json->outcome().map([&] { return points; });
}

std::string encode_margin(const StoredMargin& margin) {
  nlohmann::json clicks = nlohmann::json::array(), points = nlohmann::json::array();
  for (const Vec3& p : margin.clicks_mm) clicks.push_back({p.x(), p.y(), p.z()});
  for (const review::MeasuredPoint& point : margin.margin.line.points) {
    const Vec3& p = point.position_mm;
    nlohmann::json numbers = {p.x(), p.y(), p.z()};
    if (std::isfinite(point.sigma_mm)) numbers.push_back(point.sigma_mm);
    points.push_back(std::move(numbers));
  }
  return json_text({{"clicks_mm", std::move(clicks)},
                    {"points_mm", std::move(points)},
                    {"edge_share", margin.margin.edge_share},
                    {"least_turn_rad", margin.margin.least_turn_rad}});
}

Result<StoredMargin> decode_margin(std::string_view bytes, std::int64_t id) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, kRecord);
  if (!json) return tl::unexpected(json.error());
  StoredMargin margin;
  margin.id = id;
  for (const JsonPlace& click : json->at("clicks_mm").elements())
    margin.clicks_mm.push_back(take_point(click));
  margin.margin.line.is_closed = true;
  for (const JsonPlace& place : json->at("points_mm").elements()) {
    const bool has_sigma = place.elements().size() == 4;
    const std::vector<double> numbers = place.numbers(has_sigma ? 4 : 3);
    margin.margin.line.points.push_back(
        {{numbers[0], numbers[1], numbers[2]},
         has_sigma ? numbers[3] : std::numeric_limits<double>::infinity()});
  }
  margin.margin.edge_share = json->at("edge_share").number();
  margin.margin.least_turn_rad = json->at("least_turn_rad").number();
  if (auto read = json->outcome(); !read) return tl::unexpected(read.error());
  if (auto plausible = check_margin(margin); !plausible)
    return fail(ErrorCode::kBadFormat, "damaged: this is no margin line");
  return margin;
}

Result<void> check_margin(const StoredMargin& margin) {
  constexpr double kFarthest_mm = 1e5;
  const auto is_near = [](const Vec3& p_mm) {
    return p_mm.allFinite() && p_mm.cwiseAbs().maxCoeff() <= kFarthest_mm;
  };
  const auto& points = margin.margin.line.points;
  const bool is_plausible =
      margin.clicks_mm.size() >= 3 && points.size() >= 3 && margin.margin.line.is_closed &&
      std::all_of(margin.clicks_mm.begin(), margin.clicks_mm.end(), is_near) &&
      std::all_of(points.begin(), points.end(), [&](const review::MeasuredPoint& point) {
        return is_near(point.position_mm) && point.sigma_mm >= 0.0;
      });
  if (is_plausible) return {};
  return fail(ErrorCode::kBadOption,
              "a margin line needs three clicks and three points with finite coordinates");
}

std::string encode_pose(const Isometry& T_world_sensor) {
  std::string bytes;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      append_number(bytes, T_world_sensor(row, column));
    }
  }
  return bytes;
}

/// Whether a hand can have held a sensor so: a crafted file may hold any numbers.
bool is_rigid(const Isometry& T_world_sensor) {
  constexpr double kRounding = 1e-3, kFarthest_mm = 1e5;
  const Eigen::Matrix3d R = T_world_sensor.linear();
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRounding &&
         R.determinant() > 0.0 && T_world_sensor.translation().norm() < kFarthest_mm;
}

Result<Isometry> decode_pose(std::string_view bytes) {
  if (bytes.size() != 12 * sizeof(double)) return bad_size(bytes.size());
  ByteReader reader(bytes);
  Isometry T_world_sensor = Isometry::Identity();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      T_world_sensor(row, column) = reader.number<double>().value_or(0.0);
    }
  }
  if (!is_rigid(T_world_sensor)) return fail(ErrorCode::kBadFormat, "damaged: this is no pose");
  return T_world_sensor;
}

std::string encode_edit(const editing::Edit& edit) {
  std::string bytes;
  append_number(bytes, static_cast<std::uint8_t>(edit.kind));
  append_number(bytes, edit.made_at_s);
  for (const editing::BrushDab& dab : edit.dabs) put_dab(bytes, dab);
  return bytes;
}

Result<editing::Edit> decode_edit(std::string_view bytes) {
  ByteReader reader(bytes);
  const auto kind = reader.number<std::uint8_t>();
  const auto made_at_s = reader.number<double>();
  if (!made_at_s || *kind > static_cast<std::uint8_t>(editing::EditKind::kUnlock) ||
      reader.rest().size() % kDabSize != 0) {
    return bad_size(bytes.size());
  }
  editing::Edit edit{static_cast<editing::EditKind>(*kind), *made_at_s, {}};
  while (!reader.rest().empty()) edit.dabs.push_back(take_dab(reader));
  return edit;
}

std::string encode_count(std::size_t count) {
  std::string bytes;
  append_number(bytes, static_cast<std::uint32_t>(count));
  return bytes;
}

Result<std::size_t> decode_count(std::string_view bytes) {
  if (bytes.size() != sizeof(std::uint32_t)) return bad_size(bytes.size());
  return ByteReader(bytes).number<std::uint32_t>().value_or(0);
}

std::string encode_summary(const std::string& summary_json,
                           const std::optional<ResultBasis>& made_of) {
  if (!made_of) return summary_json;
  nlohmann::json json = nlohmann::json::parse(summary_json, nullptr, false);
  if (!json.is_object()) json = nlohmann::json::object();
  json["made_of"] = {{"view_count", made_of->view_count}, {"edited_at_s", made_of->edited_at_s}};
  return json_text(json);
}

std::optional<ResultBasis> decode_made_of(std::string_view summary_json) {
  const Result<JsonPlace> json = JsonPlace::parse(summary_json, kRecord);
  if (!json || !json->has("made_of")) return std::nullopt;
  const JsonPlace made_of = json->at("made_of");
  ResultBasis basis{made_of.at("view_count").whole_number(), {}};
  for (const JsonPlace& time : made_of.at("edited_at_s").elements()) {
    basis.edited_at_s.push_back(time.number());
  }
  return json->outcome() ? std::optional(std::move(basis)) : std::nullopt;
}

Result<View> decode_measured_view(std::string_view bytes, FrameIndex index) {
  return decode_view(bytes).and_then([&](View&& view) -> Result<View> {
    if (view.frame != index) {
      return fail(ErrorCode::kBadFormat, "damaged: contains the view of frame {}",
                  view.frame.value);
    }
    if (!is_measurable(view)) {
      return fail(ErrorCode::kBadFormat, "damaged: its points cannot have been measured");
    }
    return std::move(view);
  });
}

Result<std::string> encode_texture(const Frame& frame) {
  return encode_png(frame.image).map([&](const std::string& png) {
    std::string bytes;
    append_number(bytes, frame.time_s);
    return bytes + png;
  });
}

Result<Frame> decode_texture(std::string_view bytes, FrameIndex index) {
  ByteReader reader(bytes);
  const auto time_s = reader.number<double>();
  if (!time_s) return bad_size(bytes.size());
  return decode_png(reader.rest(), kRecord).map([&](cv::Mat&& image) {
    return Frame{index, FrameKind::kTexture, *time_s, std::move(image)};
  });
}

}  // namespace flytri::io
