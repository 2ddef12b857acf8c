/// @file  The labeled frames of two cameras become one stream, in order of time.
///
/// Patterns come from one camera, texture from the other, which may be later: a pattern that was
/// lit after a flash waits for the image of that flash.
#pragma once

#include <deque>
#include <optional>

#include "core/imaging/frame.h"
#include "hw/sync/frame_labeler.h"

namespace flytri::rig {

struct FrameMergerOptions {
  double start_s = 0.0;      ///< what the times of the frames that come out count from
  double flash_s = 0.1;      ///< > 0, how long a flash lasts
  double patience_s = 0.25;  ///< >= 0. No frame waits longer for one of the other camera
};

/// All times that go in are on one clock.
class FrameMerger {
 public:
  /// @param options  valid ones
  explicit FrameMerger(const FrameMergerOptions& options = {})
      : options_(options), last_s_(options.start_s), texture_seen_s_(options.start_s) {}

  /// A flash is to begin.
  void flash_at(double begin_s);
  /// A frame of the measurement camera, whose pattern is known.
  void add_pattern(Pattern pattern, const cv::Mat& image, double time_s, double now_s);
  /// Any frame of the texture camera. Of those that show one flash the brightest is taken, which
  /// was lit all the time; an image in which no flash is seen only tells that the flash is over.
  void add_texture(const cv::Mat& image, const sync::FrameLabel& label, double now_s);

  /// The next frame of the stream, with its index.
  /// @param texture_comes  the texture camera is there and runs
  /// @return  nothing: none, or it waits for the other camera
  [[nodiscard]] std::optional<Frame> next(double now_s, bool texture_comes);

  /// Frames given up because a later one was out already.
  [[nodiscard]] std::int64_t late() const { return late_; }

 private:
  struct Waiting {
    Frame frame;
    double arrived_s = 0.0;
  };
  [[nodiscard]] bool waits_for_texture(const Waiting& pattern) const;
  [[nodiscard]] std::optional<Frame> numbered(Frame frame);

  FrameMergerOptions options_;
  std::deque<double> flashes_s_;  // when they were to begin
  std::deque<Waiting> patterns_, textures_;
  std::optional<Waiting> brightest_;  // of the frames that show the present flash
  double brightest_area_ = 0.0;
  double last_s_;          // of the frame that came out last
  double texture_seen_s_;  // of the latest frame of the texture camera without a flash
  std::int64_t count_ = 0;
  std::int64_t late_ = 0;
};

}  // namespace flytri::rig
