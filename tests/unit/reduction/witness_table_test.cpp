#include "core/reduction/witness_table.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"
#include "core/base/square.h"

namespace flytri::reduction {
namespace {

constexpr AgreementLimits kLimits{0.04F, 0.09F, 12.0F};

Witness random_witness(Random& random, ViewIndex view) {
  const auto coordinate = [&] { return static_cast<float>(0.5 * random.normal()); };
  const Vec3f p(0.5F * coordinate(), 0.5F * coordinate(), 0.2F * coordinate());
  return {p, p.z(), 1e-4F * (1.0F + static_cast<float>(random.uniform())), view};
}

/// The votes, counted one by one.
Votes counted_votes(const std::vector<Witness>& witnesses, const Witness& sample) {
  Votes votes;
  std::map<ViewIndex, std::pair<bool, bool>> of_views;  // near, agrees
  for (const Witness& witness : witnesses) {
    const float rise2 = square(witness.height_mm - sample.height_mm);
    const float across2 = (witness.position_mm - sample.position_mm).squaredNorm() - rise2;
    const bool is_near = rise2 <= kLimits.along2_mm2 && across2 <= kLimits.across2_mm2;
    const bool agrees =
        is_near && rise2 <= kLimits.sigmas2 * (sample.variance_mm2 + witness.variance_mm2);
    votes.agreeing_samples += agrees ? 1 : 0;
    if (witness.view == sample.view) continue;
    of_views[witness.view].first |= is_near;
    of_views[witness.view].second |= agrees;
  }
  for (const auto& [view, said] : of_views) {
    votes.agreeing_views += said.second ? 1 : 0;
    votes.opposing_views += said.first && !said.second ? 1 : 0;
  }
  return votes;
}

/// @param view_sizes  number of witnesses of each view
void expect_same_votes(const std::vector<int>& view_sizes) {
  Random random(3);
  std::vector<Witness> witnesses;
  WitnessTable table;
  for (std::size_t v = 0; v < view_sizes.size(); ++v) {
    for (int i = 0; i < view_sizes[v]; ++i) {
      witnesses.push_back(random_witness(random, ViewIndex(2 * v)));
      table.add(witnesses.back());
    }
  }
  table.finish();
  int agreeing = 0, opposing = 0;
  for (int i = 0; i < 300; ++i) {
    // Every second view has no witness.
    const Witness sample = random_witness(random, ViewIndex(i % 20));
    const Votes votes = table.vote(sample, kLimits), expected = counted_votes(witnesses, sample);
    ASSERT_EQ(votes.agreeing_samples, expected.agreeing_samples);
    ASSERT_EQ(votes.agreeing_views, expected.agreeing_views);
    ASSERT_EQ(votes.opposing_views, expected.opposing_views);
    agreeing += votes.agreeing_views;
    opposing += votes.opposing_views;
  }
  EXPECT_GT(agreeing, 30);
  EXPECT_GT(opposing, 30);
}

TEST(WitnessTable, CountsAsOneByOne) { expect_same_votes({3, 1, 5, 12, 2, 1, 1, 7, 4, 9}); }

TEST(WitnessTable, AViewMayFillSeveralWords) { expect_same_votes({40, 200, 1, 64, 63, 64, 130}); }

TEST(WitnessTable, NobodyVotesInAnEmptyTable) {
  WitnessTable table;
  table.finish();
  Random random(1);
  const Votes votes = table.vote(random_witness(random, ViewIndex(0)), kLimits);
  EXPECT_EQ(votes.agreeing_views + votes.opposing_views + votes.agreeing_samples, 0);
}

TEST(WitnessTable, ForgetsWhatIsCleared) {
  WitnessTable table;
  const Witness witness{Vec3f::Zero(), 0.0F, 1e-4F, ViewIndex(1)};
  table.add(witness);
  table.finish();
  table.clear();
  table.add({Vec3f::Zero(), 0.0F, 1e-4F, ViewIndex(2)});
  table.finish();
  EXPECT_EQ(table.vote(witness, kLimits).agreeing_views, 1);
  EXPECT_EQ(table.vote(witness, kLimits).agreeing_samples, 1);
}

}  // namespace
}  // namespace flytri::reduction
