/// @file  Interprets the light measured in an image, compared with the images before it.
#pragma once

#include <deque>

#include "core/base/result.h"
#include "hw/sync/image_light.h"

namespace flytri::sync {

struct EvidenceOptions {
  /// 5..1000. Number of recent images used as the reference; 30 are one second at 30 Hz.
  int reference_images = 30;
  /// > 1. Under a flash, areas are this many times as bright as usual ...
  double flash_ratio = 2.5;
  /// 0..1. ... and brighter by at least this share of full scale.
  double flash_step = 0.02;
  /// 0..1. Under a flash, the lines have less than this share of the light.
  double flash_line_share = 0.3;
  /// >= 1. Least number of line places; fewer may be an edge or a reflection.
  int min_line_places = 32;
  [[nodiscard]] Result<void> validate() const;
};

struct LightEvidence {
  bool is_flash = false;
  bool has_lines = false;  ///< lines but no flash
  /// Share of the line light along columns, 0..1. Edges of the scene look like some light of the
  /// other direction even in an image of one pattern, so shares are scaled to map the usual
  /// extremes to 0 and 1.
  double column_share = 0.5;
  int line_places = 0;   ///< see ImageLight
  double area = 0.0;     ///< see ImageLight; the brightness of a flash
  double darkest = 0.0;  ///< see ImageLight
  /// No light seen: it is dark, or no object is in front of the sensor.
  [[nodiscard]] bool is_empty() const { return !is_flash && !has_lines; }
};

/// Recognizes a flash by comparison with the usual brightness, so that room light and scene do not
/// matter.
class EvidenceReader {
 public:
  /// @param options  must be valid
  explicit EvidenceReader(const EvidenceOptions& options = {}) : options_(options) {}
  /// Pass the images in the order in which they were taken.
  [[nodiscard]] LightEvidence read(const ImageLight& light);

 private:
  [[nodiscard]] bool is_flash(const ImageLight& light) const;
  [[nodiscard]] double stretched(double column_share);

  EvidenceOptions options_;
  std::deque<double> areas_;   // area light of the latest images
  std::deque<double> shares_;  // column shares of the latest images with lines
};

}  // namespace flytri::sync
