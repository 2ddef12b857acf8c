/// @file  Sorts by a number in a time that grows with the count alone.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace flytri {

/// Sorts by key_of(item), a std::uint64_t. Equal keys keep their order. Takes one pass for each
/// eleven bits in which the keys differ.
template <typename Item, typename KeyOf>
void radix_sort(std::vector<Item>& items, const KeyOf& key_of) {
  constexpr int kBits = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kBits;
  if (items.size() < 2) return;
  std::uint64_t least = key_of(items.front()), most = least;
  for (const Item& item : items) {
    least = std::min<std::uint64_t>(least, key_of(item));
    most = std::max<std::uint64_t>(most, key_of(item));
  }
  std::vector<Item> sorted(items.size());
  for (int shift = 0; shift < static_cast<int>(std::bit_width(most - least)); shift += kBits) {
    const auto bucket_of = [&](const Item& item) {
      return static_cast<std::size_t>((key_of(item) - least) >> shift) & (kBuckets - 1);
    };
    std::array<std::size_t, kBuckets> next{};
    for (const Item& item : items) ++next[bucket_of(item)];
    std::size_t start = 0;
    for (std::size_t& bucket : next) start += std::exchange(bucket, start);
    for (const Item& item : items) sorted[next[bucket_of(item)]++] = item;
    items.swap(sorted);
  }
}

}  // namespace flytri
