/// @file  The program of the sequencer (hw/firmware) on a pseudo terminal, with pins to look at.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace flytri::testing {

/// Only one at a time: the program has one state.
class SequencerBoard {
 public:
  /// Pins by number: lights first, then triggers.
  static constexpr int kFirstTrigger = 3;

  struct PinChange {
    double time_s = 0.0;  ///< on machine_clock()
    int pin = 0;
    bool is_high = false;
  };

  SequencerBoard();
  ~SequencerBoard();
  SequencerBoard(const SequencerBoard&) = delete;
  SequencerBoard& operator=(const SequencerBoard&) = delete;

  /// Device file of its serial port.
  [[nodiscard]] const std::string& node() const { return node_; }
  [[nodiscard]] std::vector<PinChange> changes() const;
  [[nodiscard]] bool is_high(int pin) const;
  [[nodiscard]] bool is_dark() const;
  /// It neither reads nor answers; its pins still follow its program.
  void mute(bool is_mute) { is_mute_ = is_mute; }
  void unplug();

  // What its program calls.
  void set_pin(int pin, bool is_high);
  void send(const std::string& line) const;

 private:
  void run();

  int computer_ = -1;  // end of the terminal that the program reads
  std::string node_;
  std::atomic<bool> is_mute_ = false, ends_ = false;
  mutable std::mutex mutex_;  // guards all members below
  std::vector<PinChange> changes_;
  bool pins_[5] = {};
  std::thread thread_;
};

}  // namespace flytri::testing
