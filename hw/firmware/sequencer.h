/// @file  The sequencer: a microcontroller that switches the lights and triggers the cameras.
///
/// The board calls sequencer_byte() for each byte, and sequencer_tick() at least once a
/// millisecond. docs/sequencer.md has the protocol and the wiring. Portable C without a heap.
#pragma once

#include <stdbool.h>
#include <stdint.h>

enum {
  kLights = 3,   ///< outputs 0 to 2
  kTriggers = 2  ///< trigger outputs 0 and 1
};
/// Without a byte for so long, all lights go dark.
static const uint32_t kSilence_us = 100000;
static const long kLongestExposure_us = 50000;

/// All lights dark, all triggers low.
void sequencer_start(uint32_t now_us);
/// A byte from the computer.
void sequencer_byte(char byte, uint32_t now_us);
/// Ends exposures, and turns lights off at their limits and when the computer is silent.
/// @param now_us  may wrap around
void sequencer_tick(uint32_t now_us);

// What the board provides.

/// Sets a pin that drives a light; high is on.
void board_light(int light, bool high);
/// Sets a pin that triggers a camera.
void board_trigger(int trigger, bool high);
/// Sends one line to the computer. `text` has no line end.
void board_send(const char* text);
