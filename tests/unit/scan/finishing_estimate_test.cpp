#include "core/scan/finishing_estimate.h"

#include <gtest/gtest.h>

#include <array>

#include "core/reconstruct/finish_scan.h"

namespace flytri::scan {
namespace {

/// Real times of the stages, s, in their order.
using Times = std::array<double, 6>;

constexpr std::array kStages = {reconstruct::kRecovering, reconstruct::kAligning,
                                reconstruct::kNormals,    reconstruct::kSimplifying,
                                reconstruct::kMeshing,    reconstruct::kTexturing};

struct Told {
  double at_s = 0.0;
  FinishingState state;
};

/// What is told every tenth of a second.
std::vector<Told> run(const FinishingWork& work, const Times& times) {
  FinishingEstimate estimate(work, 100.0);
  std::vector<Told> told;
  double before_s = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (double in_s = 0.0; in_s < times[i]; in_s += 0.1) {
      const double at_s = before_s + in_s;
      told.push_back({at_s, estimate.at({kStages[i], in_s / times[i]}, 100.0 + at_s)});
    }
    before_s += times[i];
  }
  return told;
}

double sum(const Times& times) {
  double all_s = 0.0;
  for (const double time_s : times) all_s += time_s;
  return all_s;
}

/// From a tenth of the time on, the whole time is told to within a factor, and the share rises.
void expect_honest(const std::vector<Told>& told, double whole_s, double factor) {
  double share = 0.0;
  for (const Told& now : told) {
    EXPECT_GE(now.state.fraction, share);
    share = now.state.fraction;
    if (now.at_s < 0.1 * whole_s) continue;
    const double told_s = now.at_s + now.state.remaining_s;
    EXPECT_GT(told_s, whole_s / factor) << "after " << now.at_s << " s of " << whole_s;
    EXPECT_LT(told_s, whole_s * factor) << "after " << now.at_s << " s of " << whole_s;
  }
  EXPECT_GT(share, 0.95);
}

const FinishingWork kArch{16, 1726, 59, 6000.0};
/// A real upper jaw, on a busy machine.
constexpr Times kArchTimes = {1.0, 32.4, 11.1, 44.9, 12.1, 28.2};

TEST(FinishingEstimate, IsHonestOnScansThatWereMeasured) {
  expect_honest(run(kArch, kArchTimes), sum(kArchTimes), 1.3);
  const FinishingWork quadrant{6, 204, 6, 1500.0};
  constexpr Times kTimes = {0.3, 4.4, 1.1, 6.2, 2.4, 4.0};
  expect_honest(run(quadrant, kTimes), sum(kTimes), 1.4);
}

TEST(FinishingEstimate, LearnsTheSpeedOfTheComputer) {
  for (const double slowness : {0.2, 3.0, 10.0}) {
    Times times = kArchTimes;
    for (double& time_s : times) time_s *= slowness;
    expect_honest(run(kArch, times), sum(times), 1.5);
  }
}

TEST(FinishingEstimate, TellsNoTimeAtTheVeryBeginning) {
  FinishingEstimate estimate(kArch, 0.0);
  EXPECT_LT(estimate.at({"", 0.0}, 0.0).remaining_s, 0.0);
  EXPECT_LT(estimate.at({reconstruct::kAligning, 0.01}, 0.5).remaining_s, 0.0);
  EXPECT_GT(estimate.at({reconstruct::kAligning, 0.5}, 16.0).remaining_s, 50.0);
}

TEST(FinishingEstimate, AStageThatTakesLongerThanPlannedDelaysTheEnd) {
  FinishingEstimate estimate(kArch, 0.0);
  const auto planned = estimate.at({reconstruct::kAligning, 0.5}, 16.0);
  const auto late = estimate.at({reconstruct::kAligning, 0.5}, 60.0);
  EXPECT_GT(late.remaining_s, 2.0 * planned.remaining_s);
  EXPECT_GE(late.fraction, planned.fraction);
}

}  // namespace
}  // namespace flytri::scan
