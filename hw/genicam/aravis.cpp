#include "hw/genicam/aravis.h"

#include <string_view>

namespace flytri::genicam {
namespace {

struct Cause {
  ErrorCode code;
  std::string_view text;
};

Cause cause_of(const GError& error) {
  if (error.domain == ARV_DEVICE_ERROR) {
    switch (error.code) {
      case ARV_DEVICE_ERROR_FEATURE_NOT_FOUND:
      case ARV_DEVICE_ERROR_INVALID_PARAMETER:
      case ARV_DEVICE_ERROR_WRONG_FEATURE:
        return {ErrorCode::kBadOption,
                "it does not support this setting: \"flytri devices\" lists what it supports"};
      case ARV_DEVICE_ERROR_NOT_CONTROLLER:
      case ARV_DEVICE_ERROR_PROTOCOL_ERROR_ACCESS_DENIED:
      case ARV_DEVICE_ERROR_PROTOCOL_ERROR_BUSY:
        return {ErrorCode::kInconsistent, "another program uses it: close that program"};
      default:
        break;
    }
  }
  if (error.domain == G_IO_ERROR && error.code == G_IO_ERROR_PERMISSION_DENIED)
    return {ErrorCode::kNotPermitted,
            "you have no permission to use it: install the udev rules of this program"};
  return {ErrorCode::kNotFound,
          "it does not answer: check its cable and power; a network camera needs an address in the "
          "network of this computer"};
}

}  // namespace

Error ArvFailure::told(const std::string& label, const std::string& doing) const {
  if (error_ == nullptr)
    return {ErrorCode::kNotFound, fmt::format("camera {}: {} failed", label, doing)};
  const auto [code, text] = cause_of(*error_);
  return {code, fmt::format("camera {}: {} failed ({}): {}", label, doing, error_->message, text)};
}

}  // namespace flytri::genicam
