#include "core/calibration/calibration_json.h"

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

namespace flytri {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "flytri.calibration";
constexpr int kVersion = 1;
constexpr std::size_t kRowNumbers = 9;  // area_min, area_max, Z0..Z3, W0..W2
constexpr int kMaxImageSide = 32768;
constexpr std::size_t kMaxLines = 1000;

// ---- writing ----

template <typename Numbers>
std::string list(const Numbers& numbers) {
  std::string text = "[";
  for (const auto number : numbers) {
    fmt::format_to(std::back_inserter(text), "{}{:.10g}", text.size() > 1 ? "," : "", number);
  }
  return text + "]";
}

std::string write(const FitResidual& residual) {
  return fmt::format(R"({{"rms":{:.10g},"max":{:.10g},"count":{}}})", residual.rms, residual.max,
                     residual.count);
}

std::string write(const TrivariateCubic& cubic) {
  return fmt::format(R"({{"center":{},"half_range":{},"coefficients":{},"residual":{}}})",
                     list(cubic.center), list(cubic.half_range), list(cubic.coefficients),
                     write(cubic.residual));
}

std::string write(const LineRow& row) {
  if (!row.valid()) return "[]";
  std::array<double, kRowNumbers> numbers{row.area_min_px, row.area_max_px};
  std::copy(row.depth_mm.coefficients.begin(), row.depth_mm.coefficients.end(), &numbers[2]);
  std::copy(row.width_px.coefficients.begin(), row.width_px.coefficients.end(), &numbers[6]);
  return list(numbers);
}

std::string write_line(const std::vector<LineRow>& rows, const Vec3& normal) {
  std::size_t first = 0, end = rows.size();
  while (first < end && !rows[first].valid()) ++first;
  while (end > first && !rows[end - 1].valid()) --end;
  const LineRow sample = first < end ? rows[first] : LineRow{};
  std::string text = fmt::format(
      R"({{"sheet_normal":{},"center_px":{:.17g},"half_range_px":{:.17g},"first_row":{},"rows":[)",
      list(normal), sample.depth_mm.center, sample.depth_mm.half_range, first);
  for (std::size_t i = first; i < end; ++i) text += (i > first ? ",\n" : "\n") + write(rows[i]);
  return text + "]}";
}

std::string write(const PatternCalibration& pattern) {
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

// ---- reading ----

/// Reads values by key and remembers the first failure: after it, everything reads as zero.
class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  void reject(const std::string& key, const std::string& expected) {
    if (!error_) {
      error_ =
          Error{ErrorCode::kBadFormat, fmt::format("{}: key \"{}\": {}", name_, key, expected)};
    }
  }

  const json& member(const json& parent, const std::string& path, const char* key) {
    static const json kNothing;
    const auto found = parent.is_object() ? parent.find(key) : parent.end();
    if (!parent.is_object() || found == parent.end()) {
      reject(path + key, "missing");
      return kNothing;
    }
    return *found;
  }

  double number(const json& value, const std::string& key) {
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    reject(key, "expected a finite number");
    return 0.0;
  }

  /// Fills `out` from an array of exactly its size.
  template <typename Numbers>
  void numbers(const json& value, const std::string& key, Numbers& out) {
    const auto size = static_cast<std::size_t>(out.size());
    if (!value.is_array() || value.size() != size) {
      return reject(key, fmt::format("expected a list of {} numbers", size));
    }
    for (std::size_t i = 0; i < size; ++i) {
      out[static_cast<int>(i)] = number(value[i], fmt::format("{}[{}]", key, i));
    }
  }

  int integer(const json& value, const std::string& key, int low, int high) {
    if (value.is_number_integer()) {
      const auto wide = value.get<std::int64_t>();
      if (wide >= low && wide <= high) return static_cast<int>(wide);
    }
    reject(key, fmt::format("expected a whole number from {} to {}", low, high));
    return low;
  }

  const json& array(const json& value, const std::string& key, std::size_t max_size) {
    static const json kEmpty = json::array();
    if (value.is_array() && !value.empty() && value.size() <= max_size) return value;
    reject(key, fmt::format("expected a list of 1 to {} items", max_size));
    return kEmpty;
  }

 private:
  std::string name_;
  std::optional<Error> error_;
};

FitResidual read_residual(Reader& reader, const json& parent, const std::string& path,
                          const char* key) {
  const json& value = reader.member(parent, path, key);
  const std::string inner = path + key + ".";
  FitResidual residual;
  residual.rms = reader.number(reader.member(value, inner, "rms"), inner + "rms");
  residual.max = reader.number(reader.member(value, inner, "max"), inner + "max");
  residual.count = reader.integer(reader.member(value, inner, "count"), inner + "count", 0,
                                  std::numeric_limits<int>::max());
  return residual;
}

TrivariateCubic read_cubic(Reader& reader, const json& root, const char* key) {
  const json& value = reader.member(root, "", key);
  const std::string path = std::string(key) + ".";
  TrivariateCubic cubic;
  reader.numbers(reader.member(value, path, "center"), path + "center", cubic.center);
  reader.numbers(reader.member(value, path, "half_range"), path + "half_range", cubic.half_range);
  reader.numbers(reader.member(value, path, "coefficients"), path + "coefficients",
                 cubic.coefficients);
  cubic.residual = read_residual(reader, value, path, "residual");
  if (!(cubic.half_range.minCoeff() > 0)) {
    reader.reject(path + "half_range", "expected positive numbers");
  }
  return cubic;
}

LineRow read_row(Reader& reader, const json& value, const std::string& key, double center_px,
                 double half_range_px) {
  if (value.is_array() && value.empty()) return {};
  std::array<double, kRowNumbers> numbers{};
  reader.numbers(value, key, numbers);
  LineRow row;
  row.area_min_px = numbers[0];
  row.area_max_px = numbers[1];
  row.depth_mm = {center_px, half_range_px, {}};
  row.width_px = {center_px, half_range_px, {}};
  std::copy_n(&numbers[2], 4, row.depth_mm.coefficients.begin());
  std::copy_n(&numbers[6], 3, row.width_px.coefficients.begin());
  if (!row.valid()) reader.reject(key, "the unique area ends before it begins");
  return row;
}

/// One line: its rows, and its sheet normal in `normal`.
std::vector<LineRow> read_line(Reader& reader, const json& value, const std::string& path,
                               int along_count, Vec3& normal) {
  reader.numbers(reader.member(value, path, "sheet_normal"), path + "sheet_normal", normal);
  if (!(std::abs(normal.norm() - 1.0) < 1e-6)) {
    reader.reject(path + "sheet_normal", "expected a unit vector");
  }
  const double center = reader.number(reader.member(value, path, "center_px"), path + "center_px");
  const double half_range =
      reader.number(reader.member(value, path, "half_range_px"), path + "half_range_px");
  if (!(half_range > 0)) reader.reject(path + "half_range_px", "expected a positive number");
  const int first = reader.integer(reader.member(value, path, "first_row"), path + "first_row", 0,
                                   along_count - 1);
  std::vector<LineRow> rows(static_cast<std::size_t>(along_count));
  const json& list = reader.array(reader.member(value, path, "rows"), path + "rows",
                                  static_cast<std::size_t>(along_count - first));
  for (std::size_t i = 0; i < list.size() && !reader.error(); ++i) {
    rows[static_cast<std::size_t>(first) + i] =
        read_row(reader, list[i], fmt::format("{}rows[{}]", path, i), center, half_range);
  }
  return rows;
}

PatternCalibration read_pattern(Reader& reader, const json& root, Pattern pattern,
                                ImageSize image) {
  const std::string key(to_string(pattern));
  const json& value = reader.member(root, "", key.c_str());
  const std::string path = key + ".";
  PatternCalibration result;
  result.depth_residual_mm = read_residual(reader, value, path, "depth_residual_mm");
  result.width_residual_px = read_residual(reader, value, path, "width_residual_px");
  const json& lines = reader.array(reader.member(value, path, "lines"), path + "lines", kMaxLines);
  const int along_count = pattern == Pattern::kVertical ? image.height_px : image.width_px;
  for (std::size_t n = 0; n < lines.size() && !reader.error(); ++n) {
    Vec3 normal = Vec3::Zero();
    result.lines.push_back(
        read_line(reader, lines[n], fmt::format("{}lines[{}].", path, n), along_count, normal));
    result.sheet_normals.push_back(normal);
  }
  return result;
}

ImageSize read_size(Reader& reader, const json& root, const char* key) {
  const json& value = reader.member(root, "", key);
  if (!value.is_array() || value.size() != 2) {
    reader.reject(key, "expected [width, height]");
    return {1, 1};
  }
  return {reader.integer(value[0], key, 1, kMaxImageSide),
          reader.integer(value[1], key, 1, kMaxImageSide)};
}

void check_head(Reader& reader, const json& root) {
  const json& format = reader.member(root, "", "format");
  if (!format.is_string() || format.get<std::string>() != kFormat) {
    reader.reject("format", fmt::format("expected \"{}\"", kFormat));
  }
  const json& version = reader.member(root, "", "version");
  if (!version.is_number_integer() || version.get<std::int64_t>() != kVersion) {
    reader.reject("version", fmt::format("this program reads version {}", kVersion));
  }
}

}  // namespace

std::string to_json(const Calibration& calibration) {
  std::string text = fmt::format("{{\"format\":\"{}\",\"version\":{},\n", kFormat, kVersion) +
                     fmt::format(
                         "\"measurement_volume_mm\":{},\n\"measurement_size_px\":{},\n"
                         "\"texture_size_px\":{},\n",
                         list(calibration.volume.size_mm), write(calibration.measurement_size),
                         write(calibration.texture_size)) +
                     fmt::format("\"x_mm\":{},\n\"y_mm\":{},\n", write(calibration.x_mm),
                                 write(calibration.y_mm)) +
                     fmt::format("\"texture_u_px\":{},\n\"texture_v_px\":{},\n",
                                 write(calibration.texture_u_px), write(calibration.texture_v_px));
  for (const Pattern pattern : kPatterns) {
    text += fmt::format("\"{}\":{}{}\n", to_string(pattern), write(calibration.of(pattern)),
                        pattern == kPatterns.back() ? "}" : ",");
  }
  return text;
}

Result<Calibration> parse_calibration(std::string_view text, const std::string& name) {
  const json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) {
    return fail(ErrorCode::kBadFormat, "{}: not JSON, or cut off in the middle", name);
  }
  Reader reader(name);
  check_head(reader, root);
  Calibration calibration;
  if (!reader.error()) {
    reader.numbers(reader.member(root, "", "measurement_volume_mm"), "measurement_volume_mm",
                   calibration.volume.size_mm);
    if (!(calibration.volume.size_mm.minCoeff() > 0)) {
      reader.reject("measurement_volume_mm", "expected positive numbers");
    }
    calibration.measurement_size = read_size(reader, root, "measurement_size_px");
    calibration.texture_size = read_size(reader, root, "texture_size_px");
    calibration.x_mm = read_cubic(reader, root, "x_mm");
    calibration.y_mm = read_cubic(reader, root, "y_mm");
    calibration.texture_u_px = read_cubic(reader, root, "texture_u_px");
    calibration.texture_v_px = read_cubic(reader, root, "texture_v_px");
  }
  for (const Pattern pattern : kPatterns) {
    if (reader.error()) break;
    calibration.of(pattern) = read_pattern(reader, root, pattern, calibration.measurement_size);
  }
  if (reader.error()) return tl::unexpected(*reader.error());
  return calibration;
}

}  // namespace flytri
