#include "core/reduction/witness_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/base/square.h"

namespace flytri::reduction {
namespace {

/// Bit i is set if byte i is 1; all bytes are 0 or 1.
std::uint64_t bits_of(const std::array<std::uint8_t, 64>& bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t eight = 0;
    for (std::size_t k = 0; k < 8; ++k) eight |= std::uint64_t{bytes[i + k]} << (8 * k);
    // The product has byte k's bit at place 56 + k; no two bits meet.
    bits |= (eight * 0x0102040810204080ULL >> 56U) << i;
  }
  return bits;
}

/// Collects, word by word, for which views at least one bit is set: in its last bit.
class AnyOfView {
 public:
  std::uint64_t next(std::uint64_t bits, std::uint64_t last_of_view) {
    // Ones are added to all bits of a view but the last: if any of these was set, there is a carry
    // into the last one.
    const std::uint64_t others = bits & ~last_of_view;
    const std::uint64_t sum = others + ~last_of_view;
    const std::uint64_t with_carry = sum + carry_;
    carry_ =
        static_cast<std::uint64_t>(sum < others) | static_cast<std::uint64_t>(with_carry < sum);
    return (with_carry | bits) & last_of_view;
  }

 private:
  std::uint64_t carry_ = 0;  ///< of a view that goes on in the next word
};

}  // namespace

void WitnessTable::clear() {
  for (auto* field : {&x_mm_, &y_mm_, &z_mm_, &height_mm_, &variance_mm2_}) field->clear();
  views_.clear();
  ends_.clear();
}

void WitnessTable::add(const Witness& witness) {
  x_mm_.push_back(witness.position_mm.x());
  y_mm_.push_back(witness.position_mm.y());
  z_mm_.push_back(witness.position_mm.z());
  height_mm_.push_back(witness.height_mm);
  variance_mm2_.push_back(witness.variance_mm2);
  if (views_.empty() || views_.back() != witness.view) {
    views_.push_back(witness.view);
    ends_.push_back(0);
  }
  ends_.back() = x_mm_.size();
}

void WitnessTable::finish() {
  const std::size_t words = (x_mm_.size() + kWordBits - 1) / kWordBits;
  last_of_view_.assign(words, 0);
  for (const std::size_t end : ends_)
    last_of_view_[(end - 1) / kWordBits] |= Word{1} << (end - 1) % kWordBits;
  // Nothing is near what fills the last word.
  constexpr float kFar = 1e15F;
  for (auto* field : {&x_mm_, &y_mm_, &z_mm_, &height_mm_, &variance_mm2_})
    field->resize(words * kWordBits, kFar);
}

WitnessTable::Statement WitnessTable::compare(std::size_t word, const Witness& sample,
                                              const AgreementLimits& limits) const {
  const std::size_t first = word * kWordBits;
  const float *x = &x_mm_[first], *y = &y_mm_[first], *z = &z_mm_[first], *h = &height_mm_[first],
              *v = &variance_mm2_[first];
  std::array<std::uint8_t, kWordBits> near, agrees;
  for (std::size_t w = 0; w < kWordBits; ++w) {
    const float rise2 = square(h[w] - sample.height_mm);
    const float distance2 = square(x[w] - sample.position_mm.x()) +
                            square(y[w] - sample.position_mm.y()) +
                            square(z[w] - sample.position_mm.z());
    const int is_near =
        int(rise2 <= limits.along2_mm2) & int(distance2 - rise2 <= limits.across2_mm2);
    near[w] = static_cast<std::uint8_t>(is_near);
    agrees[w] = static_cast<std::uint8_t>(
        is_near & int(rise2 <= limits.sigmas2 * (sample.variance_mm2 + v[w])));
  }
  return {bits_of(near), bits_of(agrees)};
}

Votes WitnessTable::vote(const Witness& sample, const AgreementLimits& limits) const {
  const auto own = std::lower_bound(views_.begin(), views_.end(), sample.view);
  std::size_t own_last = std::numeric_limits<std::size_t>::max();
  if (own != views_.end() && *own == sample.view)
    own_last = ends_[static_cast<std::size_t>(own - views_.begin())] - 1;
  Votes votes;
  AnyOfView any_near, any_agrees;
  for (std::size_t word = 0; word < last_of_view_.size(); ++word) {
    const Statement statement = compare(word, sample, limits);
    Word counted = last_of_view_[word];
    if (own_last / kWordBits == word) counted &= ~(Word{1} << own_last % kWordBits);
    const Word near = any_near.next(statement.near, last_of_view_[word]);
    const Word agrees = any_agrees.next(statement.agrees, last_of_view_[word]);
    votes.agreeing_samples += std::popcount(statement.agrees);
    votes.agreeing_views += std::popcount(agrees & counted);
    votes.opposing_views += std::popcount(near & ~agrees & counted);
  }
  return votes;
}

}  // namespace flytri::reduction
