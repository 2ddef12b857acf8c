/// @file  Controls the source of a session's frames: opens it, captures from it, checks its devices
/// and steers the simulated hand.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/session/background_work.h"
#include "app/session/frame_router.h"
#include "app/session/notices.h"
#include "app/session/source.h"
#include "hw/device/capture_loop.h"
#include "ui/state/app_view.h"
#include "ui/state/command.h"

namespace flytri::session {

class SourceController {
 public:
  /// @param opened  called each time the source has been opened, before it captures
  SourceController(SourceChoice choice, BackgroundWork& background, Notices& notices,
                   std::function<void()> opened);

  /// Opens the chosen source in the background, then captures from it.
  void open();
  /// Forgets the source, until open() opens it again.
  void forget() { source_ = {}; }
  /// Takes another source in place of this one, until open() opens it.
  void choose(SourceChoice choice);
  /// Stops capturing and leaves the devices to somebody else.
  /// @param why  told meanwhile
  void lend(ui::Text why);
  /// The devices are back: captures again, if the source is open.
  void take_back();
  /// Call often: the lights are dark while nobody needs frames, see device::Sensor::rest().
  void rest(bool rests);
  /// Ends capturing for good.
  void stop();
  /// Plays a recording from its beginning. Other sources go on.
  void replay();

  /// Begins or ends the recording of raw frames, at once or as soon as there are any.
  void record(const ui::RecordFrames& command);
  /// Records in exactly this folder, as the command line asks.
  void record_in(const std::filesystem::path& folder);
  void check_devices();
  /// Call often: once the devices of a rig fail, checks all of them, as the failure names one.
  void check_failed_devices();
  void steer(const ui::SteerHand& command);
  /// Call often: relates the frame of the simulated hand to the world of the scan, as soon as a
  /// view has been registered.
  /// @param T_world_sensor  pose of the latest registered view; none in a scan that has none yet
  void relate_hand(const std::optional<Isometry>& T_world_sensor);
  /// Points the simulated hand at a place in the world of the scan.
  void point(const ui::PointHand& command);
  void follow_path(bool follows);
  void take_away(bool is_away);

  [[nodiscard]] const Source& source() const { return source_; }
  [[nodiscard]] const SourceChoice& choice() const { return choice_; }
  /// Null until the source is open.
  [[nodiscard]] const std::shared_ptr<const calibration::Calibration>& calibration() const {
    return source_.calibration;
  }
  /// See RigCamera::readout_s; 0 of other sources.
  [[nodiscard]] double readout_s() const {
    return source_.rig ? source_.rig->settings.measurement.readout_s : 0.0;
  }
  /// Adds a check to those of a calibration, if it is still that of the source.
  void note_check(const calibration::Calibration& checked,
                  const calibration::CalibrationCheck& check);
  [[nodiscard]] FrameRouter& router() { return *router_; }
  [[nodiscard]] ui::SourceState state() const;
  /// Call it once a frame of the window. Looks at the disk once a second.
  [[nodiscard]] ui::RecordingState recording_state(double now_s);
  /// None without a rig.
  [[nodiscard]] std::optional<ui::DevicesState> devices_state() const;

 private:
  void start_capture();
  void begin_recording();
  void remind_of_check();
  void retry();
  [[nodiscard]] bool is_running() const;
  [[nodiscard]] bool has_failed() const;

  SourceChoice choice_;
  BackgroundWork& background_;
  Notices& notices_;
  const std::function<void()> opened_;
  Source source_;
  std::optional<Isometry> T_model_world_;  ///< of the hand's model and the scan's world
  std::optional<Isometry> related_at_;     ///< the registered pose that gave it
  std::string failure_;                    ///< why the source could not be opened
  ui::DevicesState checked_;  ///< result of the latest check; devices_state() adds the devices
  int opening_ = 0;  ///< number of the latest source; an earlier one is not wanted any more
  std::optional<ui::Text> lent_;  ///< why the devices are lent; none: they are not
  bool rests_ = false;
  std::filesystem::path records_in_;      ///< folder of recordings, or of the next one; empty: off
  bool records_in_named_folder_ = false;  ///< `records_in_` is the next recording's own
  std::optional<std::uint64_t> free_bytes_;
  double space_known_s_ = -1e9;
  std::shared_ptr<FrameRouter> router_ = std::make_shared<FrameRouter>();
  std::unique_ptr<device::CaptureLoop> capture_;  ///< destroyed first: it uses the router
};

}  // namespace flytri::session
