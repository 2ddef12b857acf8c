/// @file  A microcontroller on a serial port that switches the lights and triggers the cameras.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "hw/device/light_limits.h"

namespace flytri::gpio {

/// Name of the USB product, by which it is found.
inline constexpr const char* kSequencerName = "flytri sequencer";
/// Its outputs for lights; see hw/firmware/sequencer.h.
inline constexpr int kSequencerOutputs = 3;

/// An exposure that the sequencer made: light on, camera triggered, light off.
struct SequencedExposure {
  std::int64_t number = 0;  ///< counts from 1 since open()
  double board_s = 0.0;     ///< its begin on the clock of the board; wraps around every 71 minutes
};

/// A sequencer turns all lights off if this program sends nothing for 0.1 s, and each light off at
/// its limits. A thread of this object keeps sending while the program runs.
/// Thread-safe.
class Sequencer {
 public:
  /// Opens the port, for this program alone; all lights are dark, and the exposures count from 1.
  /// @param limits  by output, at most kSequencerOutputs
  /// @errors  kNotPermitted; kNotFound: it cannot be opened, or what answers is no sequencer;
  ///          kInconsistent: another program uses it, or its version is another one.
  [[nodiscard]] static Result<std::unique_ptr<Sequencer>> open(
      const std::string& node, const std::vector<device::LightLimit>& limits);
  /// The lights are dark afterwards.
  ~Sequencer();
  Sequencer(const Sequencer&) = delete;
  Sequencer& operator=(const Sequencer&) = delete;

  /// Turns one light on and the others off.
  /// @param output  nothing: all dark
  /// @return  0, or the errno; EPERM: the light is at its limit; ETIMEDOUT: no answer
  [[nodiscard]] int shine(std::optional<int> output);

  /// Begins an exposure of a camera with a light; all lights are dark afterwards.
  /// @param trigger     0: measurement camera; 1: texture camera
  /// @param duration_s  above 0, at most 0.05
  /// @errors  kInconsistent: an exposure is in progress, the light is at its limit, or no answer.
  [[nodiscard]] Result<SequencedExposure> expose(int output, int trigger, double duration_s);

  /// False: unplugged, or it went dark by itself, because this program was stopped or a light had
  /// reached its limit. Then open it again.
  [[nodiscard]] bool is_well() const;

 private:
  class Port;
  explicit Sequencer(std::unique_ptr<Port> port);
  std::unique_ptr<Port> port_;
};

}  // namespace flytri::gpio
