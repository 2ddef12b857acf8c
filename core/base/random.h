/// @file  Seeded random numbers that are the same on every machine and for every number of threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace flytri {

/// SplitMix64: small, fast, and cheap to seed, so each loop index can own a generator.
/// @source  Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// The generator of item `stream` under `seed`. It does not depend on the order in which items
  /// draw.
  Random(std::uint64_t seed, std::uint64_t stream) : state_(seed) {
    state_ ^= Random(stream + 0x632be59bd9b4e019ULL).next();
  }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, count), count > 0.
  std::uint64_t below(std::uint64_t count) { return next() % count; }
  /// Mean 0, standard deviation 1 (Box-Muller, one of the pair).
  double normal() {
    const double r = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return r * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace flytri
