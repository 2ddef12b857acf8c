#include "tests/support/fake_setup.h"

namespace flytri::testing {

ui::RunningSetup fake_setup(ui::SetupStep step) {
  ui::RunningSetup setup;
  setup.step = step;
  setup.told = {
      "Only DMK 33UX287 (serial 17) is monochrome. Is it the measurement camera, which sees the "
      "lines? Yes",
      "Which one is the texture camera, in color? HD Pro Webcam C920 (usb-0000:00:14.0-2)",
      "Light switch: FT232H (serial FT4ZS6I3)",
      "Put a white sheet before the sensor, as near as you will scan. Do not look into the lights.",
      "Turning on FT232H, line 3 (C3) for a moment ..."};
  switch (step) {
    case ui::SetupStep::kAsking:
      setup.question = {1,
                        "What lit up? The camera saw: vertical lines.",
                        {"Vertical lines", "Horizontal lines", "The flash", "Nothing",
                         "It was lit and went dark", "Show it again"},
                        0};
      break;
    case ui::SetupStep::kDone:
      setup.told.emplace_back("Running cameras and lights together ...");
      setup.told.emplace_back(
          "Measurement camera: latency 41 ms; light reaches a frame for 12.0 ms; a call to the "
          "light switch takes up to 0.4 ms");
      setup.told.emplace_back("The lights change between two frames: each frame can be used.");
      setup.file = "/home/clinic/.local/share/flytri/sensors/2026-11-26-091500/rig.json";
      break;
    case ui::SetupStep::kFailed:
      setup.message =
          "no line turned on the horizontal lines: check the cable of that projector and its "
          "supply; then start again";
      break;
    case ui::SetupStep::kWorking:
      break;
  }
  return setup;
}

}  // namespace flytri::testing
