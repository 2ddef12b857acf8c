/// @file  Learns a camera's latency (exposure to time stamp) and exposure window.
///
/// There are three unknowns. The latency is the time from the middle of the exposure to the stamp;
/// it includes the delays of switch, projector and bus, and the meaning of the stamp. The window is
/// the time in which light reaches a frame; with a rolling shutter it is longer than the exposure
/// of a row. The third unknown is whether the patterns are swapped. The filter keeps the
/// probability of each combination on a grid and updates it by how well it explains each image.
/// One more possibility is that no latency of the grid is true: then images follow the lights no
/// better than images of any other time. While it is likely, no frame gets a label.
/// @source  Bayes' rule on a grid, e.g. Thrun, Burgard, Fox, "Probabilistic Robotics", 2005,
/// ch. 4.1.
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "hw/sync/light_evidence.h"
#include "hw/sync/light_history.h"

namespace flytri::sync {

struct LatencyOptions {
  double frame_period_s = 1.0 / 30.0;  ///< > 0; the grid step is 1/32 of it
  /// <= 0, in periods. Negative if the stamp marks the start, which is before the middle.
  double min_latency_periods = -1.0;
  /// 1..32 periods. Drivers and hubs that queue a dozen frames exist.
  double max_latency_periods = 14.0;
  /// >= 0. Lower limit of the window: exposure plus readout of a rolling shutter. Needed because
  /// rows that see no object do not show which light they received.
  double min_window_s = 0.0;
  /// 0..0.5. Probability that an image misleads, e.g. by a reflection or an edge like a line.
  double outlier_share = 0.02;
  /// > 0. Standard deviation of the share of column light from its prediction; the patterns differ
  /// in brightness and light the scene unevenly.
  double share_sigma = 0.1;
  /// >= 0. Number of line places at which share_sigma doubles: with little light, images are less
  /// reliable.
  double few_line_places = 100.0;
  /// 0..0.1. Probability per frame that the latency moves to the next grid step.
  double drift = 0.002;
  [[nodiscard]] Result<void> validate() const;
};

struct LatencyEstimate {
  double latency_s = 0.0;        ///< mean
  double latency_sigma_s = 0.0;  ///< standard deviation
  double window_s = 0.0;         ///< mean
  double swapped = 0.0;          ///< probability that the patterns are swapped
  double unexplained = 0.0;      ///< probability that no latency of the grid is true
};

/// Probabilities of the lights of a frame, from times alone.
struct LightPrediction {
  /// Probability, by Light, that all light of the frame is of this kind.
  std::array<double, kLightCount> alone = {};
  /// Probability that at least 90 % of the light is of this kind.
  std::array<double, kLightCount> nearly_alone = {};
  /// The latency if all light of the frame is of this kind; only where `alone` is not 0.
  std::array<double, kLightCount> latency_s = {};
  std::array<double, kLightCount> latency_sigma_s = {};
};

class LatencyFilter {
 public:
  /// @param options  must be valid
  explicit LatencyFilter(const LatencyOptions& options = {});

  /// Predicts the light of a frame with this stamp, without its image.
  [[nodiscard]] LightPrediction predict(const LightHistory& history, double stamp_s) const;
  /// Updates the probabilities by the image of that frame.
  void learn(const LightHistory& history, double stamp_s, const LightEvidence& evidence);

  [[nodiscard]] LatencyEstimate estimate() const;
  /// Whether the latency is known to 1/16 period, whether the patterns are swapped is known, and
  /// the images follow the lights.
  [[nodiscard]] bool is_learned() const;

 private:
  /// Calls `use(cell, times, window_s)` for each combination; swapped ones come last.
  template <typename Use>
  void visit(const LightHistory& history, double stamp_s, const Use& use) const;
  [[nodiscard]] double likelihood(const LightTimes& times, double window_s,
                                  const LightEvidence& evidence) const;
  void drift();
  void learn_of_unexplained(std::span<const double> likelihoods, bool shows_light);
  void normalize();
  [[nodiscard]] std::size_t window_of(std::size_t cell) const;
  /// Impossible cells keep probability 0, however well they would explain the images.
  [[nodiscard]] bool is_possible(std::size_t cell) const {
    return window_of(cell) >= first_window_;
  }
  [[nodiscard]] double latency_s(std::size_t place) const;
  [[nodiscard]] double window_s(std::size_t window) const;

  LatencyOptions options_;
  double step_s_;
  std::size_t latency_count_;
  std::size_t first_window_ = 0;     // index of the shortest possible window
  std::vector<double> probability_;  // [swapped][window][latency]
  double unexplained_ = 0.0;         // with those above, the sum is 1; at first 1/2
};

}  // namespace flytri::sync
