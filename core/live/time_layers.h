/// @file  What was seen at a place between one edit and the next, layer by layer. The edits in
/// effect show a layer or hide it, so that to undo an edit needs no view again.
#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

namespace flytri::live {

/// What was seen after the layer before and up to a time.
template <typename Content>
struct TimeLayer {
  double until_s = std::numeric_limits<double>::infinity();
  bool is_kept = true;  ///< by the edits in effect
  Content content{};
};

/// At least one layer, by rising time; the last has no end.
template <typename Content>
class TimeLayers {
 public:
  explicit TimeLayers(const Content& so_far) : layers_(1) { layers_[0].content = so_far; }

  /// Begins a new layer after this time. What the place has seen so far counts as seen before.
  void split(double at_s) {
    const auto later = std::lower_bound(
        layers_.begin(), layers_.end(), at_s,
        [](const TimeLayer<Content>& layer, double time_s) { return layer.until_s < time_s; });
    if (later->until_s == at_s) return;
    TimeLayer<Content> before = *later;
    before.until_s = at_s;
    later->content = {};
    layers_.insert(later, before);
  }
  /// The layer of what is seen at this time.
  [[nodiscard]] TimeLayer<Content>& at(double time_s) {
    return *std::find_if(layers_.begin(), std::prev(layers_.end()),
                         [&](const auto& layer) { return time_s <= layer.until_s; });
  }
  [[nodiscard]] auto begin() { return layers_.begin(); }
  [[nodiscard]] auto end() { return layers_.end(); }
  [[nodiscard]] auto begin() const { return layers_.begin(); }
  [[nodiscard]] auto end() const { return layers_.end(); }

 private:
  std::vector<TimeLayer<Content>> layers_;
};

}  // namespace flytri::live
