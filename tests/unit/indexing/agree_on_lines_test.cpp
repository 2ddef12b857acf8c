#include "core/indexing/agree_on_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace flytri::indexing {
namespace {

constexpr int kLines = 12;

/// A part whose width is right for line `n`.
/// @param sigma  standard deviation, in lines
WidthEvidence width_of(double n, double sigma = 0.5) {
  WidthEvidence evidence;
  for (int i = 0; i < kLines; ++i) {
    const double distance = (i - n) / sigma;
    evidence.of_line.push_back(static_cast<float>(std::max(-0.5 * distance * distance, -5.0)));
  }
  evidence.information = 100.0F;
  return evidence;
}

/// Two neighbors in the image, whose numbers probably differ by `difference`.
PairEvidence pair_of(std::size_t first, std::size_t second, int difference, float clarity) {
  PairEvidence pair{first, second, {}};
  for (int d = -PairEvidence::kReach; d <= PairEvidence::kReach; ++d)
    pair.log_likelihood[static_cast<std::size_t>(d + PairEvidence::kReach)] =
        -clarity * static_cast<float>(std::abs(d - difference));
  return pair;
}

std::vector<int> numbers_of(const LineEvidence& evidence, const AgreeOptions& options = {}) {
  std::vector<int> numbers;
  for (const auto& line : agree_on_lines(evidence, options))
    numbers.push_back(line ? line->value : -1);
  return numbers;
}

TEST(AgreeOnLines, NeighborsTogetherKnowWhatEachAloneDoesNot) {
  // Each width alone is wrong by one line; together they are right.
  LineEvidence evidence;
  const std::array<double, 6> errors = {1.0, -1.0, 1.0, -1.0, 1.0, -1.0};
  for (std::size_t i = 0; i < errors.size(); ++i)
    evidence.widths.push_back(width_of(3.0 + double(i) + errors[i], 0.8));
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    evidence.pairs.push_back(pair_of(i, i + 1, 1, 6.0F));
  EXPECT_EQ(numbers_of(evidence), (std::vector<int>{3, 4, 5, 6, 7, 8}));
}

TEST(AgreeOnLines, WidthsDecideWhereNeighborsDoNotKnow) {
  // Between parts 2 and 3 there is a depth step: two lines are hidden there.
  LineEvidence evidence;
  for (const int n : {2, 3, 4, 7, 8, 9}) evidence.widths.push_back(width_of(n));
  for (const std::size_t i : {0, 1, 3, 4}) evidence.pairs.push_back(pair_of(i, i + 1, 1, 6.0F));
  evidence.pairs.push_back(pair_of(2, 3, 1, 0.2F));
  EXPECT_EQ(numbers_of(evidence), (std::vector<int>{2, 3, 4, 7, 8, 9}));
}

TEST(AgreeOnLines, LeavesOutWhatIsAmbiguous) {
  // Part 2 stands alone, and its width is between those of two lines.
  LineEvidence evidence;
  for (const double n : {4.0, 5.0, 7.5}) evidence.widths.push_back(width_of(n));
  evidence.pairs.push_back(pair_of(0, 1, 1, 6.0F));
  EXPECT_EQ(numbers_of(evidence), (std::vector<int>{4, 5, -1}));
  AgreeOptions options;
  options.min_margin = 0.0;
  EXPECT_NE(numbers_of(evidence, options)[2], -1);
}

TEST(AgreeOnLines, ACommonErrorOfTheWidthsIsNotTakenForKnowledge) {
  // Five parts, all a little nearer to the next number.
  LineEvidence evidence;
  for (int i = 0; i < 5; ++i) evidence.widths.push_back(width_of(i + 0.6));
  for (std::size_t i = 0; i < 4; ++i) evidence.pairs.push_back(pair_of(i, i + 1, 1, 9.0F));
  AgreeOptions trusting;
  trusting.common_width_error = 0.0;
  trusting.min_margin = 0.1;
  EXPECT_EQ(numbers_of(evidence, trusting), (std::vector<int>{1, 2, 3, 4, 5}));
  AgreeOptions careful = trusting;
  careful.common_width_error = 0.3;
  EXPECT_EQ(numbers_of(evidence, careful), std::vector<int>(5, -1));
}

TEST(AgreeOnLines, NothingIsFoundInNothing) {
  EXPECT_TRUE(agree_on_lines({}, {}).empty());
  LineEvidence evidence;
  evidence.widths.push_back({std::vector<float>(kLines, -8.0F), 100.0F});
  EXPECT_EQ(numbers_of(evidence), std::vector<int>{-1});
}

}  // namespace
}  // namespace flytri::indexing
