#include "sequencer.h"

#include <stdio.h>
#include <stdlib.h>

enum { kDark = -1, kLineLength = 48 };

typedef struct {
  int64_t max_on_us;
  int64_t duty_permille;
  int64_t credit_us;  // on-time that is left
  bool is_resting;    // used up its credit; rests until it is full
} Limit;

static Limit limits[kLights];
static int lit;               // light that is on, or kDark
static int trigger;           // trigger that is high, or kDark
static uint32_t exposure_us;  // of the exposure in progress; 0: none
static uint32_t exposed_at_us;
static uint32_t exposures;  // so far
static uint32_t heard_at_us;
static uint32_t ticked_at_us;
static char line[kLineLength];
static int length;

static void send(const char* format, int light, uint32_t number, uint32_t time_us) {
  char text[kLineLength];
  snprintf(text, sizeof text, format, light, (unsigned long)number, (unsigned long)time_us);
  board_send(text);
}

// The old light goes off before the new one goes on.
static void shine(int light) {
  for (int i = 0; i < kLights; ++i) {
    if (i != light) board_light(i, false);
  }
  if (light != kDark) board_light(light, true);
  lit = light;
}

static void end_exposure(void) {
  if (trigger != kDark) board_trigger(trigger, false);
  trigger = kDark;
  exposure_us = 0;
}

static void go_dark(const char* reason) {
  end_exposure();
  shine(kDark);
  board_send(reason);
}

static void set_limit(int light, long max_on_ms, long duty_permille) {
  limits[light].max_on_us = 1000 * (int64_t)max_on_ms;
  limits[light].duty_permille = duty_permille;
  if (limits[light].credit_us > limits[light].max_on_us)
    limits[light].credit_us = limits[light].max_on_us;
}

// On for max_on_us, then dark for max_on_us * (1 - duty) / duty.
static void keep_account(uint32_t passed_us) {
  for (int i = 0; i < kLights; ++i) {
    Limit* limit = &limits[i];
    if (i == lit) {
      limit->credit_us -= passed_us;
      continue;
    }
    limit->credit_us += (int64_t)passed_us * limit->duty_permille / (1000 - limit->duty_permille);
    if (limit->credit_us < limit->max_on_us) continue;
    limit->credit_us = limit->max_on_us;
    limit->is_resting = false;
  }
}

void sequencer_start(uint32_t now_us) {
  for (int i = 0; i < kLights; ++i) {
    limits[i].credit_us = 2000000;
    limits[i].is_resting = false;
    set_limit(i, 2000, i == kLights - 1 ? 250 : 600);
  }
  for (int i = 0; i < kTriggers; ++i) board_trigger(i, false);
  trigger = kDark;
  exposure_us = exposures = 0;
  length = 0;
  heard_at_us = ticked_at_us = now_us;
  shine(kDark);
}

void sequencer_tick(uint32_t now_us) {
  keep_account(now_us - ticked_at_us);
  ticked_at_us = now_us;
  if (exposure_us > 0 && now_us - exposed_at_us >= exposure_us) {
    end_exposure();
    shine(kDark);
  }
  if (lit == kDark) return;
  if (limits[lit].credit_us <= 0) {
    limits[lit].is_resting = true;
    go_dark("dark limit");
  } else if (now_us - heard_at_us >= kSilence_us) {
    go_dark("dark silence");
  }
}

static bool may_shine(int light) {
  if (light < 0 || light >= kLights) {
    board_send("no such light");
    return false;
  }
  if (limits[light].is_resting || limits[light].credit_us <= 0) {
    board_send("no limit");
    return false;
  }
  return true;
}

static void obey(uint32_t now_us) {
  char* rest = line + 1;
  const long light = strtol(rest, &rest, 10), second = strtol(rest, &rest, 10),
             third = strtol(rest, &rest, 10);
  switch (line[0]) {
    case 'H':  // hello
      end_exposure();
      shine(kDark);
      exposures = 0;
      board_send("flytri sequencer 1");
      return;
    case 'M':  // limit of a light: longest time on, ms; largest share of time, permille
      if (light < 0 || light >= kLights || second < 1 || second > 60000 || third < 1 ||
          third > 950) {
        board_send("no such limit");
        return;
      }
      set_limit((int)light, second, third);
      board_send("ok");
      return;
    case 'D':  // dark
      end_exposure();
      shine(kDark);
      board_send("ok");
      return;
    case 'L':  // light on
      if (exposure_us > 0) {
        board_send("no exposing");
        return;
      }
      if (!may_shine((int)light)) return;
      shine((int)light);
      board_send("ok");
      return;
    case 'E':  // exposure with a light, by a trigger, of so many microseconds
      if (second < 0 || second >= kTriggers || third < 1 || third > kLongestExposure_us) {
        board_send("no such exposure");
        return;
      }
      if (exposure_us > 0) {
        board_send("no exposing");
        return;
      }
      if (!may_shine((int)light)) return;
      shine((int)light);
      trigger = (int)second;
      board_trigger(trigger, true);
      exposure_us = (uint32_t)third;
      exposed_at_us = now_us;
      send("exposed %d %lu %lu", (int)light, ++exposures, now_us);
      return;
    default:
      board_send("no such command");
  }
}

void sequencer_byte(char byte, uint32_t now_us) {
  sequencer_tick(now_us);
  heard_at_us = now_us;
  if (byte != '\n') {
    if (length < kLineLength) line[length++] = byte;
    return;
  }
  // An empty line only says that the computer is there.
  if (length == kLineLength) {
    board_send("no such command");
  } else if (length > 0) {
    line[length] = '\0';
    obey(now_us);
  }
  length = 0;
}
