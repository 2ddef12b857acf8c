#include "core/io/calibrations/calibration_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/base/fingerprint.h"
#include "core/io/calibrations/plausible_calibration.h"
#include "core/io/files/json_place.h"

namespace flytri::io {
namespace {

constexpr const char* kCalibrationFormat = "flytri.calibration";
constexpr int kCalibrationVersion = 1;
constexpr std::size_t kRowNumbers = 9;  // area_min, area_max, Z0..Z3, W0..W2
constexpr int kMaxImageSide = 32768;
constexpr std::size_t kMaxLines = 1000;
constexpr const char *kPassed = "passed", *kFailed = "failed";

template <typename Numbers>
std::string list(const Numbers& numbers) {
  std::string text = "[";
  for (const auto number : numbers) {
    // A sum with zero is never -0, which JSON readers take for the whole number 0.
    fmt::format_to(std::back_inserter(text), "{}{:.10g}", text.size() > 1 ? "," : "", number + 0.0);
  }
  return text + "]";
}

std::string write(const calibration::FitResidual& residual) {
  return fmt::format(R"({{"rms":{:.10g},"max":{:.10g},"count":{}}})", residual.rms, residual.max,
                     residual.count);
}

std::string write(const calibration::TrivariateCubic& cubic) {
  return fmt::format(R"({{"center":{},"half_range":{},"coefficients":{},"residual":{}}})",
                     list(cubic.center), list(cubic.half_range), list(cubic.coefficients),
                     write(cubic.residual));
}

std::string write(const calibration::Flash& flash) {
  return fmt::format(R"({{"p_sensor_mm":{},"light":{},"vignetting":{:.10g},"residual":{}}})",
                     list(flash.p_sensor_mm), list(flash.light), flash.vignetting + 0.0,
                     write(flash.residual));
}

std::string write(const calibration::LineRow& row) {
  if (!row.valid()) return "[]";
  std::array<double, kRowNumbers> numbers{row.area_min_px, row.area_max_px};
  std::copy(row.depth_mm.coefficients.begin(), row.depth_mm.coefficients.end(), &numbers[2]);
  std::copy(row.width_px.coefficients.begin(), row.width_px.coefficients.end(), &numbers[6]);
  return list(numbers);
}

std::string write_line(const std::vector<calibration::LineRow>& rows, const Vec3& normal) {
  std::size_t first = 0, end = rows.size();
  while (first < end && !rows[first].valid()) ++first;
  while (end > first && !rows[end - 1].valid()) --end;
  const calibration::LineRow sample = first < end ? rows[first] : calibration::LineRow{};
  std::string text = fmt::format(
      R"({{"sheet_normal":{},"center_px":{:.17g},"half_range_px":{:.17g},"first_row":{},"rows":[)",
      list(normal), sample.depth_mm.center, sample.depth_mm.half_range, first);
  for (std::size_t i = first; i < end; ++i) text += (i > first ? ",\n" : "\n") + write(rows[i]);
  return text + "]}";
}

std::string write(const calibration::PatternCalibration& pattern) {
  std::string text =
      fmt::format(R"({{"depth_residual_mm":{},"width_residual_px":{},"lines":[)",
                  write(pattern.depth_residual_mm), write(pattern.width_residual_px));
  for (std::size_t n = 0; n < pattern.lines.size(); ++n) {
    text += (n > 0 ? ",\n" : "\n") + write_line(pattern.lines[n], pattern.sheet_normals[n]);
  }
  return text + "]}";
}

std::string write(const ImageSize& size) {
  return fmt::format("[{},{}]", size.width_px, size.height_px);
}

/// Fills `out` from an array of exactly its size.
template <typename Numbers>
void read_numbers(const JsonPlace& place, Numbers& out) {
  const std::vector<double> numbers = place.numbers(static_cast<std::size_t>(out.size()));
  std::copy(numbers.begin(), numbers.end(), out.begin());
}

calibration::FitResidual read_residual(const JsonPlace& place) {
  return {place.at("rms").number(), place.at("max").number(), place.at("count").whole_number()};
}

calibration::TrivariateCubic read_cubic(const JsonPlace& place) {
  calibration::TrivariateCubic cubic;
  read_numbers(place.at("center"), cubic.center);
  read_numbers(place.at("half_range"), cubic.half_range);
  read_numbers(place.at("coefficients"), cubic.coefficients);
  cubic.residual = read_residual(place.at("residual"));
  if (!(cubic.half_range.minCoeff() > 0)) place.at("half_range").reject("positive numbers");
  return cubic;
}

calibration::Flash read_flash(const JsonPlace& place, const Vec3& volume_mm) {
  calibration::Flash flash;
  read_numbers(place.at("p_sensor_mm"), flash.p_sensor_mm);
  read_numbers(place.at("light"), flash.light);
  flash.vignetting = place.at("vignetting").number();
  flash.residual = read_residual(place.at("residual"));
  if (!(flash.p_sensor_mm.z() < -0.5 * volume_mm.z()))
    place.at("p_sensor_mm").reject("a place between the sensor and the measurement volume");
  if (!(flash.light.minCoeff() > 0)) place.at("light").reject("positive numbers");
  if (!(flash.vignetting >= 0.0 && flash.vignetting < 1.0))
    place.at("vignetting").reject("a number from 0 to below 1");
  return flash;
}

calibration::LineRow read_row(const JsonPlace& place, double center_px, double half_range_px) {
  if (place.is_empty_array()) return {};
  std::array<double, kRowNumbers> numbers{};
  read_numbers(place, numbers);
  calibration::LineRow row;
  row.area_min_px = numbers[0];
  row.area_max_px = numbers[1];
  row.depth_mm = {center_px, half_range_px, {}};
  row.width_px = {center_px, half_range_px, {}};
  std::copy_n(&numbers[2], 4, row.depth_mm.coefficients.begin());
  std::copy_n(&numbers[6], 3, row.width_px.coefficients.begin());
  if (!row.valid()) place.reject("a unique area whose end is after its start");
  return row;
}

/// One line: its rows, and its sheet normal in `normal`.
std::vector<calibration::LineRow> read_line(const JsonPlace& place, int along_count, Vec3& normal) {
  read_numbers(place.at("sheet_normal"), normal);
  if (!(std::abs(normal.norm() - 1.0) < 1e-6)) place.at("sheet_normal").reject("a unit vector");
  const double center = place.at("center_px").number();
  const double half_range = place.at("half_range_px").positive_number();
  const auto first = static_cast<std::size_t>(place.at("first_row").whole_number());
  std::vector<calibration::LineRow> rows(static_cast<std::size_t>(along_count));
  if (first >= rows.size()) place.at("first_row").reject("a row of the image");
  const std::vector<JsonPlace> list = place.at("rows").elements();
  if (first + list.size() > rows.size()) {
    place.at("rows").reject(fmt::format("rows within the image, which has {}", rows.size()));
    return rows;
  }
  for (std::size_t i = 0; i < list.size() && place.outcome(); ++i) {
    rows[first + i] = read_row(list[i], center, half_range);
  }
  return rows;
}

calibration::PatternCalibration read_pattern(const JsonPlace& place, int along_count) {
  calibration::PatternCalibration result;
  result.depth_residual_mm = read_residual(place.at("depth_residual_mm"));
  result.width_residual_px = read_residual(place.at("width_residual_px"));
  const std::vector<JsonPlace> lines = place.at("lines").elements();
  if (lines.empty() || lines.size() > kMaxLines) {
    place.at("lines").reject(fmt::format("1 to {} lines", kMaxLines));
    return result;
  }
  for (const JsonPlace& line : lines) {
    if (!place.outcome()) break;
    Vec3 normal = Vec3::Zero();
    result.lines.push_back(read_line(line, along_count, normal));
    result.sheet_normals.push_back(normal);
  }
  return result;
}

ImageSize read_size(const JsonPlace& place) {
  const std::vector<double> size = place.numbers(2);
  for (const double side : size) {
    if (side >= 1 && side <= kMaxImageSide && side == std::floor(side)) continue;
    place.reject(fmt::format("[width, height], whole numbers from 1 to {}", kMaxImageSide));
    return {1, 1};
  }
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

/// All of the file but its first keys.
std::string write_content(const calibration::Calibration& calibration) {
  std::string text =
      fmt::format("\"measurement_volume_mm\":{},\n\"measurement_size_px\":{},\n",
                  list(calibration.volume.size_mm), write(calibration.measurement_size));
  const bool has_texture = calibration.has_texture();
  if (has_texture)
    text += fmt::format("\"texture_size_px\":{},\n", write(calibration.texture_size));
  text +=
      fmt::format("\"x_mm\":{},\n\"y_mm\":{},\n", write(calibration.x_mm), write(calibration.y_mm));
  if (has_texture) {
    text += fmt::format("\"texture_u_px\":{},\n\"texture_v_px\":{},\n",
                        write(calibration.texture_u_px), write(calibration.texture_v_px));
  }
  if (calibration.flash) text += fmt::format("\"flash\":{},\n", write(*calibration.flash));
  for (const Pattern pattern : kPatterns) {
    text += fmt::format("\"{}\":{}{}\n", to_string(pattern), write(calibration.of(pattern)),
                        pattern == kPatterns.back() ? "}" : ",");
  }
  return text;
}

using Json = nlohmann::ordered_json;

Json written(const std::vector<calibration::CalibrationCheck>& checks) {
  Json list = Json::array();
  for (const calibration::CalibrationCheck& check : checks) {
    Json written;
    if (!check.at.empty()) written["at"] = check.at;
    written["check"] = check.has_passed ? kPassed : kFailed;
    if (!check.note.empty()) written["note"] = check.note;
    list.push_back(std::move(written));
  }
  return list;
}

/// What the calibration in use and those before it have in common.
template <typename Calibration>
Json written(const Calibration& history) {
  Json json = Json::object();
  if (!history.made_at.empty()) json["made_at"] = history.made_at;
  if (!history.note.empty()) json["note"] = history.note;
  if (!history.checks.empty()) json["checks"] = written(history.checks);
  return json;
}

std::string write(const calibration::CalibrationHistory& history) {
  Json json = written(history);
  for (const calibration::PastCalibration& past : history.past) {
    Json of_past = written(past);
    if (!past.replaced_at.empty()) of_past["replaced_at"] = past.replaced_at;
    if (!past.kept_in.empty()) of_past["kept_in"] = past.kept_in;
    json["past"].push_back(std::move(of_past));
  }
  if (json.empty()) return "";
  return "\"history\":" + json.dump(-1, ' ', false, Json::error_handler_t::replace) + ",\n";
}

std::string read_time(const JsonPlace& json) {
  static const std::string kForm = "dddd-dd-ddTdd:dd:ddZ";
  std::string text = json.text();
  const bool is_time =
      std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(),
                 [](char c, char form) { return form == 'd' ? c >= '0' && c <= '9' : c == form; });
  if (!is_time) json.reject("a time such as \"2026-11-25T08:30:00Z\"");
  return text;
}

std::string optional_time(const JsonPlace& json, std::string_view key) {
  return json.has(key) ? read_time(json.at(key)) : std::string();
}

std::string optional_text(const JsonPlace& json, std::string_view key) {
  return json.has(key) ? json.at(key).text() : std::string();
}

bool read_passed(const JsonPlace& json) {
  const std::string check = json.text();
  if (check != kPassed && check != kFailed) json.reject("\"passed\" or \"failed\"");
  return check == kPassed;
}

template <typename Calibration>
Calibration read_life(const JsonPlace& json) {
  Calibration history;
  history.made_at = optional_time(json, "made_at");
  history.note = optional_text(json, "note");
  if (!json.has("checks")) return history;
  for (const JsonPlace& check : json.at("checks").elements()) {
    history.checks.push_back(
        {optional_time(check, "at"), read_passed(check.at("check")), optional_text(check, "note")});
  }
  return history;
}

calibration::CalibrationHistory read_history(const JsonPlace& json) {
  auto history = read_life<calibration::CalibrationHistory>(json);
  if (json.has("checked_at"))
    history.checks.push_back(
        {read_time(json.at("checked_at")), read_passed(json.at("check")), std::string()});
  if (!json.has("past")) return history;
  for (const JsonPlace& past : json.at("past").elements()) {
    auto& read = history.past.emplace_back(read_life<calibration::PastCalibration>(past));
    read.replaced_at = optional_time(past, "replaced_at");
    read.kept_in = optional_text(past, "kept_in");
  }
  return history;
}

std::string fingerprint_of(std::string_view content) {
  Fingerprint print;
  print.add(content);
  return fmt::format("{:016x}", print.value());
}

/// Files of older versions have no fingerprint.
void check_fingerprint(const JsonPlace& json, const calibration::Calibration& calibration) {
  if (!json.has("fingerprint")) return;
  const JsonPlace place = json.at("fingerprint");
  const std::string expected = fingerprint(calibration);
  if (place.text() != expected)
    place.reject(fmt::format("\"{}\" for these numbers: some were changed or damaged", expected));
}

}  // namespace

std::string fingerprint(const calibration::Calibration& calibration) {
  return fingerprint_of(write_content(calibration));
}

std::string to_json(const calibration::Calibration& calibration) {
  const std::string content = write_content(calibration);
  return fmt::format("{{\"format\":\"{}\",\"version\":{},\n{}\"fingerprint\":\"{}\",\n{}",
                     kCalibrationFormat, kCalibrationVersion, write(calibration.history),
                     fingerprint_of(content), content);
}

Result<calibration::Calibration> parse_calibration(std::string_view text, const std::string& name) {
  constexpr const char* kRemedy = "; make it again with flytri calibrate";
  return JsonPlace::parse(text, name)
      .and_then([](const JsonPlace& json) -> Result<calibration::Calibration> {
        json.expect_format(kCalibrationFormat, kCalibrationVersion);
        calibration::Calibration calibration;
        read_numbers(json.at("measurement_volume_mm"), calibration.volume.size_mm);
        if (!(calibration.volume.size_mm.minCoeff() > 0)) {
          json.at("measurement_volume_mm").reject("positive numbers");
        }
        calibration.measurement_size = read_size(json.at("measurement_size_px"));
        calibration.x_mm = read_cubic(json.at("x_mm"));
        calibration.y_mm = read_cubic(json.at("y_mm"));
        if (json.has("texture_size_px") || json.has("texture_u_px") || json.has("texture_v_px")) {
          calibration.texture_size = read_size(json.at("texture_size_px"));
          calibration.texture_u_px = read_cubic(json.at("texture_u_px"));
          calibration.texture_v_px = read_cubic(json.at("texture_v_px"));
        }
        if (json.has("flash")) {
          calibration.flash = read_flash(json.at("flash"), calibration.volume.size_mm);
        }
        if (json.has("history")) calibration.history = read_history(json.at("history"));
        for (const Pattern pattern : kPatterns) {
          // After a failure the sizes may be wrong.
          if (auto outcome = json.outcome(); !outcome) return tl::unexpected(outcome.error());
          const ImageSize& size = calibration.measurement_size;
          calibration.of(pattern) =
              read_pattern(json.at(to_string(pattern)),
                           pattern == Pattern::kVertical ? size.height_px : size.width_px);
        }
        if (json.outcome()) check_plausible(json, calibration);
        if (json.outcome()) check_fingerprint(json, calibration);
        if (auto outcome = json.outcome(); !outcome) return tl::unexpected(outcome.error());
        return calibration;
      })
      .map_error([](const Error& error) {
        return Error{error.code, error.message + kRemedy};
      });
}

}  // namespace flytri::io
