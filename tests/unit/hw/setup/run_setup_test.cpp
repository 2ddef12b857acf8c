#include "hw/setup/run_setup.h"

#include <gmock/gmock.h>

#include "hw/gpio/sequencer.h"
#include "tests/support/simulated_head.h"

namespace flytri::setup {
namespace {

using device::Light;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ScriptedTalk;
using testing::SimulatedHead;

class RunSetup : public ::testing::Test {
 protected:
  Result<rig::RigSettings> run() {
    const SetupMachine machine = head_.machine();
    return run_setup("chair 2", {machine, talk_, progress_});
  }

  /// The user covers this camera when asked, and takes the hand away afterwards.
  void cover(std::size_t camera) {
    talk_.on("Hold a hand", [this, camera](std::size_t suggested) {
      head_.cameras[camera].is_covered = true;
      return suggested;
    });
    talk_.on("texture camera", [this, camera](std::size_t suggested) {
      head_.cameras[camera].is_covered = false;
      return suggested;
    });
  }

  SimulatedHead head_;
  ScriptedTalk talk_;
  Progress progress_;
};

TEST_F(RunSetup, FindsWhatIsWhatByWhatTheCameraSees) {
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->name, "chair 2");
  EXPECT_EQ(rig->measurement.match.name, "Mono");
  EXPECT_EQ(rig->measurement.match.serial, "17");
  EXPECT_EQ(rig->measurement.settings.format, device::PixelFormat::kGrey8);
  ASSERT_TRUE(rig->texture);
  EXPECT_EQ(rig->texture->match.name, "Color");
  EXPECT_EQ(rig->texture->match.bus_path,
            head_.cameras[0].description.bus_path.substr(0, rig->texture->match.bus_path.size()));
  EXPECT_EQ(rig->texture->settings.format, device::PixelFormat::kYuyv);
  EXPECT_EQ(rig->lights.chip.serial, "L1");
  EXPECT_EQ(rig->lights.vertical.offset, 3);
  EXPECT_EQ(rig->lights.horizontal.offset, 2);
  EXPECT_EQ(rig->lights.flash.value().offset, 0);
  EXPECT_THAT(talk_.told, HasSubstr("The lights change between two frames"));
  EXPECT_THAT(talk_.told, HasSubstr("latency 40 ms"));
  EXPECT_THAT(talk_.told, Not(HasSubstr("To do")));
}

TEST_F(RunSetup, ExposesForLinesThatAreBrightAndNotSaturated) {
  for (const double brightness : {0.3, 1.0, 2.0}) {
    SCOPED_TRACE(brightness);
    for (auto& [line, lamp] : head_.lamps) lamp.brightness = brightness;
    const auto rig = run();
    ASSERT_TRUE(rig) << rig.error().message;
    const double exposure_s = rig->measurement.settings.exposure_s.value();
    // Lines are 120 - 8 above the room light at 10 ms, and are to reach 0.7 of 255.
    const double at_10_ms = 112.0 * brightness + head_.room;
    EXPECT_NEAR(exposure_s, std::min(0.45 / 30.0, 0.01 * 0.7 * 255.0 / at_10_ms), 0.0012);
    EXPECT_LE(rig->texture->settings.exposure_s.value(), 0.5 / 30.0);
  }
}

TEST_F(RunSetup, SaysThatALightIsTooWeakOrTooBright) {
  head_.lamps[2].brightness = head_.lamps[3].brightness = 0.2;
  head_.room = 1.0;
  ASSERT_TRUE(run());
  EXPECT_THAT(talk_.told, HasSubstr("raise the current of the LED"));
  talk_.told.clear();
  head_.lamps[2].brightness = head_.lamps[3].brightness = 300.0;
  ASSERT_TRUE(run());
  EXPECT_THAT(talk_.told, HasSubstr("saturated"));
}

TEST_F(RunSetup, FindsAnActiveLowLight) {
  head_.lamps[2].is_active_low = true;
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->lights.horizontal.offset, 2);
  EXPECT_TRUE(rig->lights.horizontal.active_low);
  EXPECT_FALSE(rig->lights.vertical.active_low);
}

TEST_F(RunSetup, TellsTwinsApartByTheHandInFrontOfOne) {
  for (const std::size_t measurement : {0U, 1U}) {
    head_.cameras = {{SimulatedHead::camera_named("Twin", "", {"YUYV"})},
                     {SimulatedHead::camera_named("Twin", "", {"YUYV"})}};
    cover(measurement);
    const auto rig = run();
    ASSERT_TRUE(rig) << rig.error().message;
    const std::string& socket = head_.cameras[measurement].description.bus_path;
    EXPECT_EQ(socket.rfind(rig->measurement.match.bus_path + " or ", 0), 0U) << socket;
    ASSERT_TRUE(rig->texture);
    EXPECT_NE(rig->texture->match, rig->measurement.match);
    EXPECT_THAT(talk_.told, Not(HasSubstr("To do")));
  }
}

TEST_F(RunSetup, OffersAListWhereNoCameraGotDark) {
  head_.cameras = {{SimulatedHead::camera_named("Left", "1", {"YUYV"})},
                   {SimulatedHead::camera_named("Right", "2", {"YUYV"})}};
  talk_.on("Which one is the measurement camera", [](std::size_t) { return std::size_t{1}; });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->measurement.match.name, "Right");
  EXPECT_THAT(talk_.told, HasSubstr("cover only one"));
}

TEST_F(RunSetup, MakesARigWithoutTexture) {
  head_.cameras.erase(head_.cameras.begin());
  head_.lamps.erase(0);
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_FALSE(rig->texture);
  EXPECT_FALSE(rig->lights.flash);
  EXPECT_THAT(talk_.told, HasSubstr("latency 40 ms"));
}

TEST_F(RunSetup, ExchangesThePatternsThatTheUserMixedUp) {
  // Without a suggestion, the user takes one pattern for the other.
  int shown = 0;
  talk_.on("What lit up", [&shown](std::size_t suggested) -> std::size_t {
    ++shown;
    if (suggested == 0) return 1;
    return suggested == 1 ? 0 : suggested;
  });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(shown, 4);
  EXPECT_EQ(rig->lights.vertical.offset, 3);
  EXPECT_EQ(rig->lights.horizontal.offset, 2);
  EXPECT_THAT(talk_.told, HasSubstr("are exchanged"));
}

class RunSetupWithASequencer : public RunSetup {
 protected:
  RunSetupWithASequencer() {
    head_.has_genicam = true;
    head_.chips[0].label = gpio::kSequencerName;
    head_.chips[0].is_sequencer = true;
    for (auto& camera : head_.cameras)
      camera.description.trigger_inputs = {"Counter0", "Line0", "Line1"};
  }
};

TEST_F(RunSetupWithASequencer, AsksForTheTriggerOfEachCamera) {
  talk_.on("trigger 1", [](std::size_t) { return std::size_t{1}; });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->measurement.settings.trigger, "Line0") << "sockets are suggested first";
  EXPECT_EQ(rig->texture.value().settings.trigger, "Line1");
  EXPECT_TRUE(head_.opened.is_triggered()) << "it is tried out with its triggers";
  EXPECT_TRUE(rig->validate());
}

TEST_F(RunSetupWithASequencer, WithoutAWireTheCamerasRunFreely) {
  talk_.on("trigger 0", [](std::size_t) { return std::size_t{3}; });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_FALSE(rig->is_triggered());
  EXPECT_TRUE(rig->texture);
}

TEST_F(RunSetupWithASequencer, ExposesUpToFourFifthsOfAPeriod) {
  for (auto& [line, lamp] : head_.lamps) lamp.brightness = 0.3;
  head_.room = 1.0;
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_NEAR(rig->measurement.settings.exposure_s.value(), 0.8 / 30.0, 1e-4);
}

TEST_F(RunSetupWithASequencer, SaysThatACameraHasNoTriggerInput) {
  head_.cameras[0].description.trigger_inputs.clear();
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_FALSE(rig->is_triggered());
  EXPECT_THAT(talk_.told, HasSubstr("has no trigger input"));
}

TEST_F(RunSetup, NamesTheLightThatNoLineSwitches) {
  head_.lamps.erase(3);
  const auto rig = run();
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(rig.error().message, HasSubstr("the projector of the vertical lines"));
}

TEST_F(RunSetup, TriesTheLinesAgainAfterACableWasPluggedIn) {
  const testing::HeadLamp lamp = head_.lamps[3];
  head_.lamps.erase(3);
  talk_.on("No line turned on", [&](std::size_t suggested) {
    head_.lamps[3] = lamp;
    return suggested;
  });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->lights.vertical.offset, 3);
}

TEST_F(RunSetup, GoesOnWithoutTextureWhereTheFlashIsMissing) {
  head_.lamps.erase(0);
  talk_.on("No line turned on the flash", [](std::size_t) { return std::size_t{2}; });
  const auto rig = run();
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_FALSE(rig->texture);
}

TEST_F(RunSetup, SaysWhatIsMissing) {
  head_.chips.clear();
  auto rig = run();
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("plug in its USB GPIO chip"));
  for (auto& camera : head_.cameras)
    camera.description.problems = {{ErrorCode::kNotPermitted, "you have no permission to use it"}};
  rig = run();
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("no camera can be used"));
  EXPECT_THAT(talk_.told, HasSubstr("you have no permission to use it"));
}

TEST_F(RunSetup, UsesNoChipOfTheComputerUnasked) {
  head_.chips[0].device.serial.clear();
  head_.chips[0].device.bus_path = "INT34C5:00";
  const auto rig = run();
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("no light switch was chosen"));
  EXPECT_EQ(head_.lights->truth(100.0, head_.clock.now_s()).lit(Light::kVertical), 0.0);
}

TEST_F(RunSetup, StopsWhenTheUserStops) {
  talk_.on("What lit up", [](std::size_t) { return std::optional<std::size_t>(); });
  const auto rig = run();
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::kCancelled);
  const double now_s = head_.clock.now_s();
  head_.clock.turn(1.0);
  EXPECT_EQ(head_.lights->truth(now_s, now_s + 1.0).lit(Light::kVertical), 0.0);
}

}  // namespace
}  // namespace flytri::setup
