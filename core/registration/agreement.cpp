#include "core/registration/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/check_options.h"

namespace flytri::registration {
namespace {

constexpr double kAgreesIfRight = 0.95;
constexpr double kAgreesIfWrong = 0.5;
constexpr int kPlacesOfTheFit = 6;

}  // namespace

Result<void> AgreementOptions::validate() const {
  return OptionCheck("AgreementOptions")
      .in_range("max_sigmas", max_sigmas, 2.0, 20.0)
      .in_range("min_distance_share", min_distance_share, 0.0, 0.1)
      .positive_up_to("place_share", place_share, 1.0)
      .result();
}

Agreement judge(std::span<const Crossing> crossings, const Isometry& T_world_source,
                double radius_mm, const AgreementOptions& options) {
  const Isometry T_source_world = T_world_source.inverse();
  const double side_mm = options.place_share * radius_mm;
  const double least_mm = options.min_distance_share * radius_mm;
  std::map<std::array<int, 2>, int> balance;  // agreeing less disagreeing crossings
  for (const Crossing& c : crossings) {
    const Vec3 p_source = T_source_world * c.p_mm;
    const Eigen::Array2i place = (p_source.head<2>() / side_mm).array().floor().cast<int>();
    const bool agrees =
        std::abs(c.distance_mm) <= std::max(options.max_sigmas * c.sigma_mm, least_mm);
    balance[{place.x(), place.y()}] += agrees ? 1 : -1;
  }
  Agreement result;
  result.places = static_cast<int>(balance.size());
  for (const auto& [place, votes] : balance) result.agreeing += votes > 0 ? 1 : 0;
  const int proofs = std::max(0, result.agreeing - kPlacesOfTheFit);
  const int contradictions = result.places - result.agreeing;
  result.proof = proofs * std::log(kAgreesIfRight / kAgreesIfWrong);
  result.contradiction = contradictions * std::log((1.0 - kAgreesIfWrong) / (1.0 - kAgreesIfRight));
  result.evidence = result.proof - result.contradiction;
  return result;
}

}  // namespace flytri::registration
