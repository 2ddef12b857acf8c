#include "hw/device/light_limits.h"

#include "core/base/check_options.h"

namespace flytri::device {

namespace {

constexpr double kMaxOn_s = 60.0;
constexpr double kMaxDuty = 0.95;

LightLimit scaled(const LightLimit& limit, double share) {
  return {share * limit.max_on_s, share * limit.max_duty};
}

}  // namespace

Result<void> LightLimit::validate() const {
  return OptionCheck("LightLimit")
      .positive_up_to("max_on_s", max_on_s, kMaxOn_s)
      .positive_up_to("max_duty", max_duty, kMaxDuty)
      .result();
}

const LightLimit& LightLimits::of(Light light) const {
  switch (light) {
    case Light::kVertical:
      return vertical;
    case Light::kHorizontal:
      return horizontal;
    case Light::kDark:
    case Light::kFlash:
      break;
  }
  return flash;
}

LightLimits LightLimits::tightened(double share) const {
  return {scaled(vertical, share), scaled(horizontal, share), scaled(flash, share)};
}

Result<void> LightLimits::validate() const {
  return OptionCheck("LightLimits").nested(vertical).nested(horizontal).nested(flash).result();
}

}  // namespace flytri::device
