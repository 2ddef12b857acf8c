// The sequencer on a Raspberry Pi Pico (RP2040), with its SDK: docs/sequencer.md says how to build
// it.
#include <hardware/watchdog.h>
#include <pico/stdlib.h>
#include <stdio.h>

#include "sequencer.h"

static const uint kLightPins[kLights] = {2, 3, 4};   // vertical, horizontal, flash
static const uint kTriggerPins[kTriggers] = {6, 7};  // measurement camera, texture camera

void board_light(int light, bool high) { gpio_put(kLightPins[light], high); }
void board_trigger(int trigger, bool high) { gpio_put(kTriggerPins[trigger], high); }
void board_send(const char* text) { printf("%s\n", text); }

static void drive_low(uint pin) {
  gpio_init(pin);
  gpio_put(pin, false);
  gpio_set_dir(pin, GPIO_OUT);
}

int main(void) {
  for (int i = 0; i < kLights; ++i) drive_low(kLightPins[i]);
  for (int i = 0; i < kTriggers; ++i) drive_low(kTriggerPins[i]);
  stdio_init_all();
  sequencer_start(time_us_32());
  // A program that hangs is restarted, and starts dark.
  watchdog_enable(50, true);
  for (;;) {
    const int byte = getchar_timeout_us(0);
    if (byte >= 0) sequencer_byte((char)byte, time_us_32());
    sequencer_tick(time_us_32());
    watchdog_update();
  }
}
