/// @file  What an image says of the light that lit it, in the course of the images before.
#pragma once

#include <deque>

#include "core/base/result.h"
#include "hw/sync/image_light.h"

namespace flytri::sync {

struct EvidenceOptions {
  /// 5..1000. Images that are the reference for what is usual: a second at 30 Hz.
  int reference_images = 30;
  /// > 1. A flash makes areas this many times as bright as they usually are ...
  double flash_ratio = 2.5;
  /// 0..1, of full scale ... and by at least so much brighter.
  double flash_step = 0.02;
  /// 0..1. Lines are less than this share of the light under a flash.
  double flash_line_share = 0.3;
  /// >= 1. Fewer places of lines may be an edge or a reflection.
  int min_line_places = 32;
  [[nodiscard]] Result<void> validate() const;
};

struct LightEvidence {
  bool is_flash = false;
  bool has_lines = false;  ///< and no flash
  /// Of the lines' light, what runs along columns, 0..1. Even an image of one pattern has some
  /// light that seems to run the other way, at edges of the scene: shares are stretched so that the
  /// usual extremes are 0 and 1.
  double column_share = 0.5;
  int line_places = 0;  ///< see ImageLight
  double area = 0.0;    ///< see ImageLight: how bright a flash is
  /// Nothing to be seen: it is dark, or nothing is in front of the sensor.
  [[nodiscard]] bool is_empty() const { return !is_flash && !has_lines; }
};

/// A flash is told by what areas usually are, so that room light and the scene do not matter.
class EvidenceReader {
 public:
  /// @param options  valid ones
  explicit EvidenceReader(const EvidenceOptions& options = {}) : options_(options) {}
  /// Images in the order in which they were taken.
  [[nodiscard]] LightEvidence read(const ImageLight& light);

 private:
  [[nodiscard]] bool is_flash(const ImageLight& light) const;
  [[nodiscard]] double stretched(double column_share);

  EvidenceOptions options_;
  std::deque<double> areas_;   // of the latest images
  std::deque<double> shares_;  // of light in columns, of the latest images with lines
};

}  // namespace flytri::sync
