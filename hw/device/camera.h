/// @file  Interface of a camera of the rig: raw images with time stamps, and counts of faults.
///
///          start      ┌──── unplugged ────▶ lost
///     idle ─────▶ running ◀─ plugged in ──────┘
///       │             │ ▲
///       └─▶ failed    │ └──────▶ frozen         no frames arrive; the next frame ends this state
///                     ▼
///     idle ◀── stop, from every state
///
/// failed: start() did not succeed; the message says what to do.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/imaging/frame.h"

namespace flytri::device {

/// Pixel format of the images. kGrey10 and kGrey12 use the low bits of 16-bit numbers. Bayer
/// formats are named after the first two pixels of the first two rows.
enum class PixelFormat {
  kGrey8,
  kGrey10,
  kGrey12,
  kGrey16,
  kYuyv,
  kUyvy,
  kMjpeg,
  kRgb8,
  kBayerRggb,
  kBayerGrbg,
  kBayerGbrg,
  kBayerBggr
};

/// The name in V4L2, e.g. "GREY" or "MJPG"; rig.json and the command line use the same names.
[[nodiscard]] std::string_view to_string(PixelFormat format);
[[nodiscard]] std::optional<PixelFormat> pixel_format_of(std::string_view name);
/// All names, for messages: "GREY, Y10, ... or BA81".
[[nodiscard]] std::string pixel_format_names();

/// What a color format is converted to; grey formats always give kGrey.
enum class Channels { kGrey, kRgb };

/// Settings to apply to a camera. Automatic modes are always turned off. Default of a control
/// without a value: leave the camera's setting unchanged.
struct CameraSettings {
  PixelFormat format = PixelFormat::kGrey8;
  Channels channels = Channels::kGrey;
  ImageSize size = {1024, 768};           ///< > 0
  double rate_hz = 30.0;                  ///< > 0
  std::optional<double> exposure_s;       ///< > 0
  std::optional<double> gain;             ///< in steps of the camera
  std::optional<double> white_balance_k;  ///< > 0, color temperature in kelvin
  std::optional<double> focus;            ///< in steps of the camera
  /// 8..16, only for kGrey16: how many low bits of each number the camera uses. Default: learned
  /// from the brightest pixel so far, one of 10, 12, 14 and 16.
  std::optional<int> bits;
  /// Name of the camera's trigger input, e.g. "Line1". Empty: it runs without triggers.
  std::string trigger = {};
  /// Further controls by name, in steps of the camera: "gamma", "contrast", "sharpness",
  /// "backlight_compensation", "power_line_frequency", "wide_dynamic_range", or the driver's own
  /// name. Default of those that bend the image: neutral.
  std::map<std::string, double> controls;
  [[nodiscard]] Result<void> validate() const;
};

/// Selects a camera: every given field must match, and exactly one camera may match.
struct CameraMatch {
  std::string name;    ///< or a part of it; case-sensitive
  std::string serial;  ///< the whole serial number
  std::string
      bus_path;  ///< the whole bus path or ID_PATH; distinguishes twins without serial numbers
  bool operator==(const CameraMatch&) const = default;
};

/// The moment that a frame's time stamp marks.
enum class StampMeaning { kStartOfExposure, kEndOfReadout };

/// One image of the camera with its time stamp.
struct CameraFrame {
  /// CV_8UC1 for GREY and for color as Channels::kGrey, CV_16UC1 with full scale 65535 for Y10, Y12
  /// and Y16, CV_8UC3 in R, G, B order for color as Channels::kRgb. The image owns its memory;
  /// copies share it, and nobody writes to it again.
  cv::Mat image;
  double time_s = 0.0;  ///< on machine_clock(); increases from frame to frame
  StampMeaning stamp = StampMeaning::kStartOfExposure;
  /// Number of the exposure. It keeps increasing after the camera was unplugged and plugged in
  /// again. A step of more than one means missing frames.
  std::int64_t sequence = 0;
  /// The driver marked the buffer as damaged, or it was too short, or it could not be decoded.
  /// Missing pixels are black; the others may be wrong.
  bool damaged = false;
};

enum class CameraState { kIdle, kRunning, kFrozen, kLost, kFailed };

[[nodiscard]] std::string_view to_string(CameraState state);

/// start() resets the counts. A damaged frame may increase several counts.
struct CameraStatus {
  CameraState state = CameraState::kIdle;
  std::string message;            ///< what is wrong and what to do; empty if nothing is wrong
  std::int64_t delivered = 0;     ///< frames that next() returned, including damaged ones
  std::int64_t dropped = 0;       ///< missing according to the camera's frame numbers
  std::int64_t flagged = 0;       ///< damaged: marked by the driver
  std::int64_t short_frames = 0;  ///< damaged: fewer bytes than the format needs
  std::int64_t undecodable = 0;   ///< damaged: a compressed image that cannot be decoded
  std::int64_t restamped =
      0;                    ///< frames whose implausible time was replaced by the time of arrival
  std::int64_t frozen = 0;  ///< how often frames stopped although the camera was plugged in
  std::int64_t restarted = 0;  ///< how often a frozen or broken stream was restarted
  std::int64_t lost = 0;       ///< how often the camera was disconnected
  std::int64_t returned = 0;   ///< how often it ran again after a disconnection
  bool operator==(const CameraStatus&) const = default;
};

/// A camera of the rig. Call start, stop and next from one thread at a time. All other members are
/// thread-safe.
class Camera {
 public:
  virtual ~Camera() = default;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  /// Finds the camera, configures it and starts the stream. Does nothing if it already runs.
  /// @errors  kNotFound (missing, or it does not answer), kNotPermitted, kInconsistent (several
  ///          match, or another program uses it), kBadOption (it lacks the format, size or
  ///          control). On an error, the state is kFailed and the status has the error's message.
  [[nodiscard]] virtual Result<void> start() = 0;

  /// Stops the stream and releases the camera. start() may be called again.
  virtual void stop() = 0;

  /// The next frame. Searches for a lost camera and restarts it with the same settings; also
  /// restarts a camera that stays frozen.
  /// @param timeout_s  longest wait, not counting the time to set up a camera
  /// @return  nothing if there is no frame yet; the status says why
  /// @errors  kBadOption: start() was not called or failed
  [[nodiscard]] virtual Result<std::optional<CameraFrame>> next(double timeout_s) = 0;

  [[nodiscard]] virtual CameraStatus status() const = 0;

  [[nodiscard]] virtual CameraSettings requested() const = 0;
  /// The settings read back from the camera at the last start. Rate and controls may differ from
  /// the requested ones; controls that the camera lacks have no value. Before the first start: the
  /// requested settings.
  [[nodiscard]] virtual CameraSettings read_back() const = 0;

  /// Name shown to the user.
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  Camera() = default;
};

/// An image size that a camera offers in one format, with its frame rates.
struct CameraMode {
  std::string format;  ///< the name in V4L2; may be missing in PixelFormat
  ImageSize size;
  std::vector<double> rates_hz;  ///< in decreasing order
};

struct CameraControl {
  std::string name;  ///< as in the driver
  double minimum = 0.0;
  double maximum = 0.0;
  double step = 0.0;
  double value = 0.0;
};

/// One entry of the list of cameras.
struct CameraDescription {
  std::string name;
  std::string serial;    ///< empty if it has none
  std::string node;      ///< e.g. /dev/video0; may change when the camera is plugged in again
  std::string bus_path;  ///< identifies the USB socket: bus path, and ID_PATH if known
  std::vector<CameraMode> modes;
  std::vector<CameraControl> controls;
  std::vector<std::string> trigger_inputs;  ///< names for CameraSettings::trigger
  std::vector<Error> problems;  ///< why it cannot be used, and what to do; empty if it can
};

}  // namespace flytri::device
