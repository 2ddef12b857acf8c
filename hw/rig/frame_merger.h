/// @file  Merges the labeled frames of two cameras into one stream sorted by time.
///
/// Pattern frames come from one camera and texture frames from the other, possibly later. So a
/// pattern frame taken after a flash waits for the image of that flash.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "core/imaging/frame.h"
#include "hw/sync/frame_labeler.h"

namespace flytri::rig {

struct FrameMergerOptions {
  double start_s = 0.0;      ///< zero of the times of the merged frames
  double flash_s = 0.1;      ///< > 0, duration of a flash
  double patience_s = 0.25;  ///< >= 0, longest wait for a frame of the other camera
};

/// All times passed in are on one clock.
class FrameMerger {
 public:
  /// @param options  must be valid
  explicit FrameMerger(const FrameMergerOptions& options = {})
      : options_(options), last_s_(options.start_s), texture_seen_s_(options.start_s) {}

  /// Announces a flash that begins at `begin_s`.
  void flash_at(double begin_s);
  /// Adds a frame of the measurement camera with its pattern.
  void add_pattern(Pattern pattern, const cv::Mat& image, double time_s, double now_s);
  /// Adds any frame of the texture camera. Of the frames that show the same flash, one with a
  /// certain label is used, and of several or none of these the brightest: the flash was on during
  /// its whole exposure. Without a time it is not used: nobody would know from where it was taken.
  /// A frame without flash only shows that the flash is over.
  void add_texture(const cv::Mat& image, const sync::FrameLabel& label, double now_s);

  /// Adds the one image of a flash.
  /// @param time_s  middle of its exposure
  void add_flash(const cv::Mat& image, double time_s, double now_s);

  /// The next frame of the stream, with its index.
  /// @param texture_comes  whether the texture camera is running
  /// @return  nothing if there is none, or the next one waits for the other camera
  [[nodiscard]] std::optional<Frame> next(double now_s, bool texture_comes);

  /// Frames dropped because a later frame was already delivered.
  [[nodiscard]] std::int64_t late() const { return late_; }

 private:
  struct Waiting {
    Frame frame;
    double arrived_s = 0.0;
  };
  struct FlashImage {
    Waiting image;
    bool has_time = false;         ///< see FrameLabel
    std::pair<bool, double> rank;  ///< whether its label is certain, and its brightness
  };
  [[nodiscard]] bool waits_for_texture(const Waiting& pattern) const;
  [[nodiscard]] std::optional<Frame> numbered(Frame frame);

  FrameMergerOptions options_;
  std::deque<double> flashes_s_;  // planned begin of each flash
  std::deque<Waiting> patterns_, textures_;
  std::optional<FlashImage> best_;  // of the current flash
  double last_s_;                   // time of the last delivered frame
  double texture_seen_s_;           // time of the texture camera's latest frame without flash
  std::int64_t count_ = 0;
  std::int64_t late_ = 0;
};

}  // namespace flytri::rig
