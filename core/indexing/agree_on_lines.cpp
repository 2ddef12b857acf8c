#include "core/indexing/agree_on_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/check_options.h"

namespace flytri::indexing {
namespace {

constexpr float kNoLine = -8.0F;  // log likelihood of a number that the sensor does not have

/// Log likelihoods of the numbers first, first + 1, ...
struct Scores {
  int first = 0;
  std::vector<float> values;

  [[nodiscard]] int end() const { return first + static_cast<int>(values.size()); }
  [[nodiscard]] float of(int number) const {
    return number < first || number >= end() ? below
                                             : values[static_cast<std::size_t>(number - first)];
  }
  float below = kNoLine;  ///< of all other numbers
};

/// Sum of two, the second one for numbers larger by `difference`.
Scores joined(const Scores& a, const Scores& b, int difference) {
  Scores sum;
  sum.first = std::min(a.first, b.first - difference);
  const int end = std::max(a.end(), b.end() - difference);
  for (int n = sum.first; n < end; ++n) sum.values.push_back(a.of(n) + b.of(n + difference));
  sum.below = a.below + b.below;
  return sum;
}

/// A best choice, and how much less likely the second best one is.
struct Choice {
  int number = 0;
  float value = -std::numeric_limits<float>::max();
  float margin = 0.0F;

  void offer(int other, float other_value) {
    if (other_value > value) {
      margin = other_value - value;
      value = other_value;
      number = other;
    } else {
      margin = std::min(margin, value - other_value);
    }
  }
};

/// Sum of log likelihoods that say partly the same: along a depth step, all lines jump together.
/// The cube root of the sum of cubes lies between the plain sum, for statements that have nothing
/// in common, and the clearest one alone.
class RelatedSum {
 public:
  void add(float value) { (value < 0 ? losses_ : gains_) += std::abs(value * value * value); }
  [[nodiscard]] float value() const { return std::cbrt(gains_) - std::cbrt(losses_); }

 private:
  float gains_ = 0.0F, losses_ = 0.0F;
};

/// Parts whose numbers differ by known amounts.
struct Group {
  std::vector<std::size_t> parts;
  Scores widths;  ///< by the number of the group: that of a part less its offset
  float information = 0.0F;
};

/// Other numbers that a group is tried with.
constexpr std::array<int, 6> kMoves = {-3, -2, -1, 1, 2, 3};

class Agreement {
 public:
  Agreement(const LineEvidence& evidence, const AgreeOptions& options)
      : evidence_(evidence), options_(options), numbers_(evidence.widths.size(), 0) {
    for (std::size_t p = 0; p < evidence.widths.size(); ++p) add_part(p);
    pairs_of_.resize(numbers_.size());
    for (std::size_t e = 0; e < evidence.pairs.size(); ++e) {
      const PairEvidence& pair = evidence.pairs[e];
      if (pair.first == pair.second) continue;
      pairs_of_[pair.first].push_back(e);
      pairs_of_[pair.second].push_back(e);
      links_[key(pair.first, pair.second)].pairs.push_back(e);
    }
  }

  std::vector<std::optional<LineIndex>> agree() {
    join_all();
    number_groups();
    move_to_best();
    const std::vector<float> margins = margins_of_parts();
    std::vector<std::optional<LineIndex>> lines(numbers_.size());
    for (std::size_t p = 0; p < lines.size(); ++p) {
      const bool is_line =
          numbers_[p] >= 0 && numbers_[p] < int(evidence_.widths[p].of_line.size());
      if (is_line && margins[p] >= options_.min_margin) lines[p] = LineIndex(numbers_[p]);
    }
    return lines;
  }

 private:
  using Key = std::pair<std::size_t, std::size_t>;
  /// Evidence between two groups, and what it suggests.
  struct Link {
    std::vector<std::size_t> pairs;
    std::optional<Choice> difference;  ///< none: to be found anew
  };

  static Key key(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

  void add_part(std::size_t p) {
    const auto& of_line = evidence_.widths[p].of_line;
    Scores scores;
    const auto is_seen = [](float value) { return value > kNoLine; };
    const auto begin = std::find_if(of_line.begin(), of_line.end(), is_seen);
    const auto end = std::find_if(of_line.rbegin(), of_line.rend(), is_seen).base();
    if (begin < end) {
      scores.first = static_cast<int>(begin - of_line.begin());
      scores.values.assign(begin, end);
    }
    groups_.push_back({{p}, scores, evidence_.widths[p].information});
    group_of_.push_back(p);
    joined_.push_back({p});
  }

  /// The more a group knows, the more the common error counts.
  [[nodiscard]] float trust(float information) const {
    const auto error = static_cast<float>(options_.common_width_error);
    return 1.0F / (1.0F + error * error * information);
  }

  /// The difference of the numbers of two groups: the second less the first.
  [[nodiscard]] Choice difference_of(const Key& groups, const Link& link) const {
    const Group &a = groups_[groups.first], &b = groups_[groups.second];
    const float trust_a = trust(a.information), trust_b = trust(b.information);
    Choice choice;
    const int first = b.widths.first - a.widths.end();
    const int last = b.widths.end() - a.widths.first;
    for (int d = first; d <= last; ++d) {
      float best = trust_a * a.widths.below + trust_b * b.widths.below;
      for (int n = a.widths.first; n < a.widths.end(); ++n)
        best = std::max(best, trust_a * a.widths.of(n) + trust_b * b.widths.of(n + d));
      choice.offer(d, best + pair_score(link, groups, d));
    }
    return choice;
  }

  /// Log likelihood of the pairs between two groups whose numbers differ by d.
  [[nodiscard]] float pair_score(const Link& link, const Key& groups, int d) const {
    RelatedSum sum;
    for (const std::size_t e : link.pairs) {
      const PairEvidence& pair = evidence_.pairs[e];
      const int offset = numbers_[pair.second] - numbers_[pair.first];
      sum.add(pair.of(group_of_[pair.first] == groups.first ? offset + d : offset - d));
    }
    return sum.value();
  }

  void join_all() {
    while (true) {
      auto best = links_.end();
      for (auto it = links_.begin(); it != links_.end(); ++it) {
        Link& link = it->second;
        if (!link.difference) link.difference = difference_of(it->first, link);
        if (best == links_.end() || link.difference->margin > best->second.difference->margin)
          best = it;
      }
      if (best == links_.end() || !(best->second.difference->margin > 0.0F)) return;
      join(best->first, best->second.difference->number);
    }
  }

  void join(const Key& groups, int difference) {
    const auto [a, b] = groups;
    Group &kept = groups_[a], &gone = groups_[b];
    for (const std::size_t p : gone.parts) {
      numbers_[p] += difference;
      group_of_[p] = a;
    }
    kept.widths = joined(kept.widths, gone.widths, difference);
    kept.information += gone.information;
    kept.parts.insert(kept.parts.end(), gone.parts.begin(), gone.parts.end());
    gone = {};
    joined_.push_back(kept.parts);
    links_.erase(groups);
    relink(a, b);
  }

  /// Links of group b become links of group a; all links of a are found anew.
  void relink(std::size_t a, std::size_t b) {
    std::vector<std::pair<Key, Link>> moved;
    for (auto it = links_.begin(); it != links_.end();) {
      const auto [first, second] = it->first;
      if (first != b && second != b) {
        if (first == a || second == a) it->second.difference.reset();
        ++it;
        continue;
      }
      moved.emplace_back(key(a, first == b ? second : first), std::move(it->second));
      it = links_.erase(it);
    }
    for (auto& [k, link] : moved) {
      Link& whole = links_[k];
      whole.difference.reset();
      whole.pairs.insert(whole.pairs.end(), link.pairs.begin(), link.pairs.end());
    }
  }

  void number_groups() {
    for (const Group& group : groups_) {
      Choice choice;
      for (int n = group.widths.first; n < group.widths.end(); ++n)
        choice.offer(n, group.widths.of(n));
      for (const std::size_t p : group.parts) numbers_[p] += choice.number;
    }
  }

  /// What the log likelihood of all gains if the numbers of these parts change by each move.
  [[nodiscard]] std::array<float, kMoves.size()> gains_of(const std::vector<std::size_t>& parts) {
    inside_.assign(numbers_.size(), false);
    for (const std::size_t p : parts) inside_[p] = true;
    float information = 0.0F;
    std::array<float, kMoves.size()> widths{};
    std::array<RelatedSum, kMoves.size()> pairs{};
    for (const std::size_t p : parts) {
      information += evidence_.widths[p].information;
      const float width = width_of(p, numbers_[p]);
      for (std::size_t m = 0; m < kMoves.size(); ++m)
        widths[m] += width_of(p, numbers_[p] + kMoves[m]) - width;
      for (const std::size_t e : pairs_of_[p]) {
        const PairEvidence& pair = evidence_.pairs[e];
        if (inside_[pair.first] == inside_[pair.second]) continue;
        const int now = numbers_[pair.second] - numbers_[pair.first];
        const int sign = inside_[pair.first] ? -1 : 1;
        for (std::size_t m = 0; m < kMoves.size(); ++m)
          pairs[m].add(pair.of(now + sign * kMoves[m]) - pair.of(now));
      }
    }
    std::array<float, kMoves.size()> gains{};
    for (std::size_t m = 0; m < kMoves.size(); ++m)
      gains[m] = trust(information) * widths[m] + pairs[m].value();
    return gains;
  }

  [[nodiscard]] float width_of(std::size_t p, int number) const {
    const auto& of_line = evidence_.widths[p].of_line;
    return number < 0 || number >= int(of_line.size()) ? kNoLine : of_line[std::size_t(number)];
  }

  void move_to_best() {
    constexpr int kPasses = 3;
    bool has_moved = true;
    for (int pass = 0; pass < kPasses && has_moved; ++pass) {
      has_moved = false;
      for (const auto& parts : joined_) {
        const Choice move = best_move(parts);
        if (!(move.value > 0.0F)) continue;
        for (const std::size_t p : parts) numbers_[p] += move.number;
        has_moved = true;
      }
    }
  }

  Choice best_move(const std::vector<std::size_t>& parts) {
    const auto gains = gains_of(parts);
    Choice best;
    for (std::size_t m = 0; m < kMoves.size(); ++m) best.offer(kMoves[m], gains[m]);
    return best;
  }

  std::vector<float> margins_of_parts() {
    std::vector<float> margins(numbers_.size(), std::numeric_limits<float>::max());
    for (const auto& parts : joined_) {
      const float margin = -best_move(parts).value;
      for (const std::size_t p : parts) margins[p] = std::min(margins[p], margin);
    }
    return margins;
  }

  const LineEvidence& evidence_;
  const AgreeOptions& options_;
  std::vector<int> numbers_;  // by part; in its group, until the groups have numbers
  std::vector<Group> groups_;
  std::vector<std::size_t> group_of_;               // by part
  std::map<Key, Link> links_;                       // by groups
  std::vector<std::vector<std::size_t>> joined_;    // each group that there was
  std::vector<std::vector<std::size_t>> pairs_of_;  // by part
  std::vector<bool> inside_;                        // by part, for gains_of
};

}  // namespace

Result<void> AgreeOptions::validate() const {
  return OptionCheck("AgreeOptions")
      .in_range("common_width_error", common_width_error, 0.0, 1.0)
      .not_negative("min_margin", min_margin)
      .result();
}

std::vector<std::optional<LineIndex>> agree_on_lines(const LineEvidence& evidence,
                                                     const AgreeOptions& options) {
  return Agreement(evidence, options).agree();
}

}  // namespace flytri::indexing
