#include "hw/device/light_budget.h"

#include <algorithm>

namespace flytri::device {

namespace {

/// Rounding must not leave a light with a credit that ends at once.
constexpr double kNothing_s = 1e-6;

}  // namespace

LightBudget::LightBudget(const LightLimits& limits) {
  for (const Light light : {Light::kVertical, Light::kHorizontal, Light::kFlash}) {
    Account& account = *account_of(light);
    account.limit = limits.of(light);
    account.credit_s = account.limit.max_on_s;
  }
}

LightBudget::Account* LightBudget::account_of(Light light) {
  return light == Light::kDark ? nullptr : &accounts_[static_cast<std::size_t>(light) - 1];
}

// On for max_on_s, then dark for max_on_s * (1 - duty) / duty: both change the credit by max_on_s.
void LightBudget::advance(Account& account, double now_s) {
  if (now_s <= account.time_s) return;
  const LightLimit& limit = account.limit;
  const double passed_s = now_s - account.time_s;
  account.time_s = now_s;
  if (account.is_on) {
    // A light that was on for too long, because the program was stopped, rests twice as long.
    account.credit_s = std::max(account.credit_s - passed_s, -limit.max_on_s);
    return;
  }
  const double growth = limit.max_duty / (1.0 - limit.max_duty);
  account.credit_s = std::min(account.credit_s + growth * passed_s, limit.max_on_s);
  if (account.credit_s >= limit.max_on_s) account.is_resting = false;
}

void LightBudget::begin(Light light, double now_s) {
  Account* const account = account_of(light);
  if (account == nullptr) return;
  advance(*account, now_s);
  account->is_on = true;
}

void LightBudget::finish(Light light, double now_s) {
  for (Account& account : accounts_) {
    advance(account, now_s);
    const bool is_on = &account == account_of(light);
    if (account.is_on && !is_on && account.credit_s <= kNothing_s) account.is_resting = true;
    account.is_on = is_on;
  }
}

bool LightBudget::may_turn_on(Light light, double now_s) const {
  if (light == Light::kDark) return true;
  Account account = accounts_[static_cast<std::size_t>(light) - 1];
  advance(account, now_s);
  return !account.is_resting && account.credit_s > kNothing_s;
}

double LightBudget::dark_by_s() const {
  double dark_by_s = std::numeric_limits<double>::infinity();
  for (const Account& account : accounts_)
    if (account.is_on) dark_by_s = std::min(dark_by_s, account.time_s + account.credit_s);
  return dark_by_s;
}

}  // namespace flytri::device
