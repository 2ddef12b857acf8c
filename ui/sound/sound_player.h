/// @file  Plays the sounds of a scan; silent without a sound device.
#pragma once

#include <memory>

#include "ui/sound/tones.h"

namespace flytri::ui {

/// Only for the thread of the user interface. Never fails, waits or prints; without a device every
/// call does nothing.
class SoundPlayer {
 public:
  /// Opens the default device, which takes some milliseconds.
  SoundPlayer();
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  /// Stops the current sound; while muted, play() does nothing.
  void set_muted(bool muted);
  /// Restarts a sound that is still playing.
  void play(Sound sound);

  [[nodiscard]] bool has_device() const { return device_ != nullptr; }

 private:
  struct Device;
  std::unique_ptr<Device> device_;  // null: none
  bool muted_ = false;
};

}  // namespace flytri::ui
