/// @file  Plays the sounds of a scan where there is a sound device, and is silent where there is
/// none.
#pragma once

#include <memory>

#include "ui/sound/tones.h"

namespace flytri::ui {

/// For the thread of the user interface alone. Never fails, waits or prints: without a device every
/// call does nothing. Playing itself is done by OpenAL.
class SoundPlayer {
 public:
  /// Opens the default device, which takes some milliseconds.
  SoundPlayer();
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  /// Muted, nothing new is played and what sounds is cut off.
  void set_muted(bool muted);
  /// From its beginning, also if it sounds already.
  void play(Sound sound);

  [[nodiscard]] bool has_device() const { return device_ != nullptr; }

 private:
  struct Device;
  std::unique_ptr<Device> device_;  // null: none
  bool muted_ = false;
};

}  // namespace flytri::ui
