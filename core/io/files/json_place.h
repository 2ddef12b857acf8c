/// @file  Reads JSON; errors name the file, the key and what was expected.
///
/// Include it only in sources that read a file format: it includes the JSON library.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace flytri::io {

/// One place in a JSON document. A failed read returns a default; the document keeps the first
/// failure, and the caller asks for it once at the end.
class JsonPlace {
 public:
  /// @param name  of the file, for messages
  [[nodiscard]] static Result<JsonPlace> parse(std::string_view text, const std::string& name);

  /// Requires the keys "format" and "version", which all documents of this project have.
  void expect_format(std::string_view format, int version) const;

  [[nodiscard]] JsonPlace at(std::string_view key) const;
  [[nodiscard]] bool has(std::string_view key) const;
  /// The elements of an array.
  [[nodiscard]] std::vector<JsonPlace> elements() const;
  [[nodiscard]] bool is_empty_array() const;
  /// The keys of an object, in their order.
  [[nodiscard]] std::vector<std::string> keys() const;

  [[nodiscard]] double number() const;           ///< finite
  [[nodiscard]] double positive_number() const;  ///< finite, > 0
  [[nodiscard]] int whole_number() const;        ///< >= 0
  [[nodiscard]] std::string text() const;        ///< not empty
  /// An array of exactly `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;

  /// The keys "q_wxyz", a unit quaternion, and "t_mm" of this place.
  [[nodiscard]] Isometry pose() const;

  /// Records a failure at this place.
  void reject(std::string_view expected) const;
  /// The first failure, if any.
  [[nodiscard]] Result<void> outcome() const;

 private:
  struct Document;
  JsonPlace(std::shared_ptr<Document> document, const nlohmann::json* value, std::string path);

  std::shared_ptr<Document> document_;
  const nlohmann::json* value_;  ///< null: the place is missing, and that is recorded
  std::string path_;             ///< such as frames[3].time_s
};

}  // namespace flytri::io
