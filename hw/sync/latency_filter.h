/// @file  Learns how long after its exposure a frame is stamped, and how long it collects light.
///
/// Between a call to the light switch and the stamp of the first frame that shows it lie the
/// switch, the projector, the exposure, the bus and what the stamp means. All of it is one unknown,
/// the latency: from the middle of the exposure to the stamp. A second one is the window: the time
/// in which light gets into a frame, with a rolling shutter longer than a row's exposure. A third
/// one is whether the patterns are swapped. The filter holds the probability of each combination on
/// a grid and weighs it by how well it explains each image.
/// @source  Bayes' rule on a grid, e.g. Thrun, Burgard, Fox, "Probabilistic Robotics", 2005,
/// ch. 4.1.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "hw/sync/light_evidence.h"
#include "hw/sync/light_history.h"

namespace flytri::sync {

struct LatencyOptions {
  double frame_period_s = 1.0 / 30.0;  ///< > 0; the grid is a 32nd of it
  /// <= 0 periods: a stamp of the start lies before the middle of the exposure.
  double min_latency_periods = -1.0;
  /// 1..16 periods: three frames wait in drivers, and a half for the exposure.
  double max_latency_periods = 4.0;
  /// >= 0. No frame collects light for a shorter time: exposure and, of a rolling shutter, readout.
  /// Rows without a scene do not show what got into them.
  double min_window_s = 0.0;
  /// 0..0.5. An image that misleads: a reflection, an edge that looks like a line.
  double outlier_share = 0.02;
  /// > 0. Standard deviation of the share of light in columns about what the clock predicts: the
  /// patterns differ in brightness and the scene is not lit evenly.
  double share_sigma = 0.1;
  /// >= 0. Places of lines at which that is twice as much: little light misleads more easily.
  double few_line_places = 100.0;
  /// 0..0.1 a frame. The chance that the latency moves to the next place of the grid.
  double drift = 0.002;
  [[nodiscard]] Result<void> validate() const;
};

struct LatencyEstimate {
  double latency_s = 0.0;        ///< mean
  double latency_sigma_s = 0.0;  ///< standard deviation
  double window_s = 0.0;         ///< mean
  double swapped = 0.0;          ///< probability that the patterns are swapped
};

/// What the clock alone says of a frame: probabilities.
struct LightPrediction {
  /// That all light of the frame is of this one, by Light.
  std::array<double, kLightCount> alone = {};
  /// That nearly all of it is: at least nine tenths.
  std::array<double, kLightCount> nearly_alone = {};
};

class LatencyFilter {
 public:
  /// @param options  valid ones
  explicit LatencyFilter(const LatencyOptions& options = {});

  /// What lit a frame with this stamp, before its image is looked at.
  [[nodiscard]] LightPrediction predict(const LightHistory& history, double stamp_s) const;
  /// Learns from what the image of that frame says.
  void learn(const LightHistory& history, double stamp_s, const LightEvidence& evidence);

  [[nodiscard]] LatencyEstimate estimate() const;
  /// The latency is known to an eighth of a period, and whether the patterns are swapped.
  [[nodiscard]] bool is_learned() const;

 private:
  /// Calls `use(cell, times, window_s)` for each combination, swapped ones after the others.
  template <typename Use>
  void visit(const LightHistory& history, double stamp_s, const Use& use) const;
  [[nodiscard]] double likelihood(const LightTimes& times, double window_s,
                                  const LightEvidence& evidence) const;
  void drift();
  void normalize();
  [[nodiscard]] std::size_t window_of(std::size_t cell) const;
  /// What is not has probability 0 for good, however well it would explain the images.
  [[nodiscard]] bool is_possible(std::size_t cell) const {
    return window_of(cell) >= first_window_;
  }
  [[nodiscard]] double latency_s(std::size_t place) const;
  [[nodiscard]] double window_s(std::size_t window) const;

  LatencyOptions options_;
  double step_s_;
  std::size_t latency_count_;
  std::size_t first_window_ = 0;     // shorter ones are not possible
  std::vector<double> probability_;  // [swapped][window][latency]
};

}  // namespace flytri::sync
