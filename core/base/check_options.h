/// @file  Checks the fields of an options struct: the first field out of its range is the error.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace flytri {

/// Collects the checks of one `validate()`. Every message has the form
/// "<struct>.<field> is <value>, but must be <rule>". NaN fails each check of a number.
///
///     return OptionCheck("AlignOptions").at_least("max_iterations", max_iterations, 2).result();
class OptionCheck {
 public:
  /// @param options  name of the struct; must outlive the check
  explicit OptionCheck(std::string_view options) : options_(options) {}

  OptionCheck& positive(std::string_view field, double value);
  OptionCheck& not_negative(std::string_view field, double value);
  OptionCheck& above(std::string_view field, double value, double bound);
  OptionCheck& at_least(std::string_view field, double value, double least);
  /// Both ends are allowed.
  OptionCheck& in_range(std::string_view field, double value, double low, double high);
  OptionCheck& positive_up_to(std::string_view field, double value, double high);

  /// Any other rule.
  /// @param rule  completes "must be ..."
  template <typename Value>
  OptionCheck& must(std::string_view field, const Value& value, bool good, std::string_view rule) {
    if (valid_ && !good) refuse(field, fmt::format("{}", value), rule);
    return *this;
  }

  /// A field with its own `validate()`. Its message names its own struct.
  template <typename Options>
  OptionCheck& nested(const Options& options) {
    if (valid_) valid_ = options.validate();
    return *this;
  }

  /// @errors  kBadOption: the first check that failed.
  [[nodiscard]] Result<void> result() const { return valid_; }

 private:
  void refuse(std::string_view field, const std::string& value, std::string_view rule);

  std::string_view options_;
  Result<void> valid_;
};

}  // namespace flytri
