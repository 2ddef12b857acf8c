#include "core/io/files/json_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace flytri::io {

struct JsonPlace::Document {
  explicit Document(std::string file_name) : name(std::move(file_name)) {}
  Document(const Document&) = delete;  // places point into a document
  Document& operator=(const Document&) = delete;

  std::string name;
  nlohmann::json root;
  std::optional<Error> error;
};

JsonPlace::JsonPlace(std::shared_ptr<Document> document, const nlohmann::json* value,
                     std::string path)
    : document_(std::move(document)), value_(value), path_(std::move(path)) {}

namespace {

/// More than any document of this project needs; deeper nesting would exhaust the stack.
constexpr int kMaxDepth = 64;

bool too_deep(int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
  return depth <= kMaxDepth;
}

std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t start = before.rfind('\n');
  const std::size_t column =
      start == std::string_view::npos ? before.size() : before.size() - start - 1;
  return fmt::format("line {}, column {}", line, column);
}

}  // namespace

Result<JsonPlace> JsonPlace::parse(std::string_view text, const std::string& name) {
  auto document = std::make_shared<Document>(name);
  try {
    document->root = nlohmann::json::parse(text.begin(), text.end(), too_deep);
  } catch (const nlohmann::json::parse_error& error) {
    return fail(ErrorCode::kBadFormat, "{}: not valid JSON at {}", name,
                line_and_column(text, error.byte));
  } catch (const nlohmann::json::exception&) {
    return fail(ErrorCode::kBadFormat, "{}: not valid JSON: a number is out of range", name);
  }
  if (!document->root.is_object()) {
    return fail(ErrorCode::kBadFormat, "{}: expected a JSON object", name);
  }
  const nlohmann::json* root = &document->root;
  return JsonPlace(std::move(document), root, "");
}

void JsonPlace::reject(std::string_view expected) const {
  if (document_->error) return;
  document_->error = Error{ErrorCode::kBadFormat, fmt::format("{}: \"{}\": expected {}",
                                                              document_->name, path_, expected)};
}

Result<void> JsonPlace::outcome() const {
  if (document_->error) return tl::unexpected(*document_->error);
  return {};
}

void JsonPlace::expect_format(std::string_view format, int version) const {
  if (at("format").text() != format) at("format").reject(fmt::format("\"{}\"", format));
  const JsonPlace place = at("version");
  if (place.whole_number() != version) {
    place.reject(fmt::format("{}; this version of flytri reads no other", version));
  }
}

bool JsonPlace::has(std::string_view key) const {
  return value_ != nullptr && value_->is_object() && value_->contains(key);
}

JsonPlace JsonPlace::at(std::string_view key) const {
  JsonPlace place(document_, nullptr,
                  path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key));
  if (has(key)) {
    place.value_ = &(*value_)[std::string(key)];
  } else {
    place.reject("this key, which is missing");
  }
  return place;
}

std::vector<JsonPlace> JsonPlace::elements() const {
  std::vector<JsonPlace> places;
  if (value_ == nullptr) return places;
  if (!value_->is_array()) {
    reject("an array");
    return places;
  }
  for (std::size_t i = 0; i < value_->size(); ++i) {
    places.push_back(JsonPlace(document_, &(*value_)[i], fmt::format("{}[{}]", path_, i)));
  }
  return places;
}

std::vector<std::string> JsonPlace::keys() const {
  std::vector<std::string> keys;
  if (value_ == nullptr) return keys;
  if (!value_->is_object()) {
    reject("an object");
    return keys;
  }
  for (const auto& [key, value] : value_->items()) keys.push_back(key);
  return keys;
}

bool JsonPlace::is_empty_array() const {
  return value_ != nullptr && value_->is_array() && value_->empty();
}

double JsonPlace::number() const {
  if (value_ == nullptr) return 0.0;
  const double value =
      value_->is_number() ? value_->get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(value)) reject("a finite number");
  return std::isfinite(value) ? value : 0.0;
}

double JsonPlace::positive_number() const {
  const double value = number();
  if (value <= 0.0) reject("a number above 0");
  return value;
}

int JsonPlace::whole_number() const {
  const double value = number();
  constexpr double kLargest = std::numeric_limits<int>::max();
  if (value >= 0.0 && value <= kLargest && value == std::floor(value))
    return static_cast<int>(value);
  reject("a whole number of at least 0");
  return 0;
}

std::string JsonPlace::text() const {
  if (value_ == nullptr) return {};
  std::string value = value_->is_string() ? value_->get<std::string>() : std::string();
  if (value.empty()) reject("a text that is not empty");
  return value;
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
  std::vector<double> values(count, 0.0);
  if (value_ == nullptr) return values;
  if (!value_->is_array() || value_->size() != count) {
    reject(fmt::format("an array of {} numbers", count));
    return values;
  }
  // A calibration has half a million numbers: make places only for those that fail.
  for (std::size_t i = 0; i < count; ++i) {
    const nlohmann::json& value = (*value_)[i];
    if (value.is_number()) values[i] = value.get<double>();
    if (value.is_number() && std::isfinite(values[i])) continue;
    values[i] = JsonPlace(document_, &value, fmt::format("{}[{}]", path_, i)).number();
  }
  return values;
}

Isometry JsonPlace::pose() const {
  const JsonPlace rotation = at("q_wxyz");
  const std::vector<double> q = rotation.numbers(4);
  const std::vector<double> t = at("t_mm").numbers(3);
  const Eigen::Quaterniond q_a_b(q[0], q[1], q[2], q[3]);
  // Rounding to few digits changes the norm a little; a larger error is not rounding.
  constexpr double kTolerance = 1e-3;
  if (std::abs(q_a_b.norm() - 1.0) > kTolerance) {
    rotation.reject("a unit quaternion");
    return Isometry::Identity();
  }
  return make_isometry(q_a_b, Vec3(t[0], t[1], t[2]));
}

}  // namespace flytri::io
