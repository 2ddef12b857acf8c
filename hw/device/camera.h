/// @file  What a camera of the rig delivers: raw images with times, counts of what went wrong.
///
///          start      ┌──── unplugged ────▶ lost
///     idle ─────▶ running ◀─ plugged in ──────┘
///       │             │ ▲
///       └─▶ failed    │ └──────▶ frozen         no frame comes; the next one ends it
///                     ▼
///     idle ◀── stop, from every state
///
/// failed: start() could not; the message names the remedy.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::device {

/// How a camera sends its pixels. kGrey10, kGrey12: in the low bits of 16.
enum class PixelFormat { kGrey8, kGrey10, kGrey12, kGrey16, kYuyv, kMjpeg };

/// As V4L2 names it, e.g. "GREY" or "MJPG"; rig.json and the command line use the same.
[[nodiscard]] std::string_view to_string(PixelFormat format);
[[nodiscard]] std::optional<PixelFormat> pixel_format_of(std::string_view name);

/// What is made of a color format; grey formats are always kGrey.
enum class Channels { kGrey, kRgb };

/// How a camera is to run. Automatic modes are always off. A control without a value is left at
/// what the camera has.
struct CameraSettings {
  PixelFormat format = PixelFormat::kGrey8;
  Channels channels = Channels::kGrey;
  ImageSize size = {1024, 768};           ///< > 0
  double rate_hz = 30.0;                  ///< > 0
  std::optional<double> exposure_s;       ///< > 0
  std::optional<double> gain;             ///< in the camera's own steps
  std::optional<double> white_balance_k;  ///< > 0, color temperature in kelvin
  std::optional<double> focus;            ///< in the camera's own steps
  [[nodiscard]] Result<void> validate() const;
};

/// Which camera is meant: what is given must all agree, and exactly one camera must be left.
struct CameraMatch {
  std::string name;      ///< a part of it is enough; upper and lower case count
  std::string serial;    ///< the whole number
  std::string bus_path;  ///< the whole path: tells two cameras apart that have no serial number
  bool operator==(const CameraMatch&) const = default;
};

/// What a frame's time means.
enum class StampMeaning { kStartOfExposure, kEndOfReadout };

/// One image as it came from the camera.
struct CameraFrame {
  /// CV_8UC1 for GREY and for color as Channels::kGrey, CV_16UC1 with full scale 65535 for Y10, Y12
  /// and Y16, CV_8UC3 in R, G, B order for color as Channels::kRgb. Own memory, shared, never
  /// written to again.
  cv::Mat image;
  double time_s = 0.0;  ///< on the clock of machine_clock(); rises from frame to frame
  StampMeaning stamp = StampMeaning::kStartOfExposure;
  /// Counts the camera's exposures and rises, also across a loss: a step above one is a gap.
  std::int64_t sequence = 0;
  /// The driver flagged the buffer, or it was short, or could not be decoded: what is missing is
  /// black, what is there may be wrong.
  bool damaged = false;
};

enum class CameraState { kIdle, kRunning, kFrozen, kLost, kFailed };

[[nodiscard]] std::string_view to_string(CameraState state);

/// Counts begin anew at start(). A damaged frame may count in more than one way.
struct CameraStatus {
  CameraState state = CameraState::kIdle;
  std::string message;            ///< what is wrong and its remedy; empty where nothing is
  std::int64_t delivered = 0;     ///< frames that next() returned, damaged ones among them
  std::int64_t dropped = 0;       ///< missing by the camera's own count
  std::int64_t flagged = 0;       ///< damaged: the driver said so
  std::int64_t short_frames = 0;  ///< damaged: fewer bytes than the format needs
  std::int64_t undecodable = 0;   ///< damaged: compressed, and no image comes out
  std::int64_t restamped = 0;     ///< the time was implausible: that of arrival is in its place
  std::int64_t frozen = 0;        ///< times that frames stopped coming though the camera is there
  std::int64_t restarted = 0;     ///< times that a stream which froze or broke was set up anew
  std::int64_t lost = 0;          ///< times that the camera went away
  std::int64_t returned = 0;      ///< times that it ran again after it was lost
  bool operator==(const CameraStatus&) const = default;
};

/// A camera of the rig. start, stop and next are called from one thread at a time, all else from
/// any thread at any time.
class Camera {
 public:
  virtual ~Camera() = default;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  /// Finds the camera, sets it up and begins to stream. Does nothing where it runs already.
  /// @errors  kNotFound (or it does not answer), kNotPermitted, kInconsistent (several match, or it
  ///          is in use), kBadOption (it has no such format, size or control); the state is then
  ///          kFailed and the message the error's.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Ends the stream and lets the camera go; start() may follow.
  virtual void stop() = 0;

  /// The next frame. A camera that is lost is looked for, and started again as it was; one that
  /// stays frozen is started again, too.
  /// @param timeout_s  blocks at most that long, apart from setting up a camera
  /// @return  nothing: no frame yet; for the reason see the state
  /// @errors  kBadOption: it was not started, or could not be
  [[nodiscard]] virtual Result<std::optional<CameraFrame>> next(double timeout_s) = 0;

  [[nodiscard]] virtual CameraStatus status() const = 0;

  [[nodiscard]] virtual CameraSettings asked() const = 0;
  /// As the camera gave them back when it was started last: rate and controls may differ from what
  /// was asked, controls that it does not have are missing. As asked before the first start.
  [[nodiscard]] virtual CameraSettings read_back() const = 0;

  /// What a user calls it.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  Camera() = default;
};

/// A size that a camera offers in one format, with the rates for it.
struct CameraMode {
  std::string format;  ///< as V4L2 names it; may be one that PixelFormat does not have
  ImageSize size;
  std::vector<double> rates_hz;  ///< falling
};

struct CameraControl {
  std::string name;  ///< as the driver calls it
  double minimum = 0.0;
  double maximum = 0.0;
  double step = 0.0;
  double value = 0.0;
};

/// A camera as it is listed.
struct CameraDescription {
  std::string name;
  std::string serial;    ///< empty where it has none
  std::string node;      ///< e.g. /dev/video0; changes when it is plugged in again
  std::string bus_path;  ///< the socket that it is plugged into
  std::vector<CameraMode> modes;
  std::vector<CameraControl> controls;
  std::vector<Error> problems;  ///< what keeps it from being used, with the remedy; empty: nothing
};

}  // namespace flytri::device
