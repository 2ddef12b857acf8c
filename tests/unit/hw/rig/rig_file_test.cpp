#include "hw/rig/rig_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::rig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kRig = R"({
  "format": "flytri.rig", "version": 1, "name": "chair 2", "someday": true,
  "measurement_camera": {
    "match": {"name": "mono", "serial": "17"}, "format": "Y12", "size_px": [1024, 768],
    "rate_hz": 30, "exposure_s": 0.01, "gain": 4, "readout_s": 0.02, "later": [],
    "controls": {"gamma": 120, "LED": 0}},
  "texture_camera": {
    "match": {"bus_path": "1-4.2"}, "format": "MJPG", "size_px": [1280, 960], "rate_hz": 25,
    "white_balance_k": 5000, "focus": 30},
  "lights": {
    "chip": {"label": "ftdi-cbus"}, "vertical": {"line": 0, "active": "low"},
    "horizontal": {"line_name": "H"}, "flash": {"line": 2, "max_on_s": 0.5, "max_duty": 0.1}},
  "flash_period_s": 1.5, "calibration": "calibration.json"
})";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kRig;
  return text.replace(text.find(from), from.size(), to);
}

TEST(RigFile, ReadsEveryKeyAndIgnoresUnknownOnes) {
  const RigSettings rig = parse_rig(kRig, "rig.json").value();
  EXPECT_EQ(rig.name, "chair 2");
  EXPECT_EQ(rig.measurement.match.name, "mono");
  EXPECT_EQ(rig.measurement.match.serial, "17");
  EXPECT_EQ(rig.measurement.settings.format, device::PixelFormat::kGrey12);
  EXPECT_EQ(rig.measurement.settings.channels, device::Channels::kGrey);
  EXPECT_EQ(rig.measurement.settings.exposure_s, 0.01);
  EXPECT_EQ(rig.measurement.settings.gain, 4.0);
  EXPECT_EQ(rig.measurement.readout_s, 0.02);
  EXPECT_EQ(rig.measurement.settings.controls.at("gamma"), 120.0);
  EXPECT_EQ(rig.measurement.settings.controls.at("LED"), 0.0);
  ASSERT_TRUE(rig.texture);
  EXPECT_EQ(rig.texture->settings.channels, device::Channels::kRgb);
  EXPECT_EQ(rig.texture->settings.size, (ImageSize{1280, 960}));
  EXPECT_EQ(rig.texture->settings.white_balance_k, 5000.0);
  EXPECT_FALSE(rig.texture->settings.exposure_s);
  EXPECT_TRUE(rig.lights.vertical.active_low);
  EXPECT_EQ(rig.lights.horizontal.name, "H");
  EXPECT_EQ(rig.lights.flash->offset, 2);
  EXPECT_EQ(rig.lights.limits.flash.max_on_s, 0.5);
  EXPECT_EQ(rig.lights.limits.flash.max_duty, 0.1);
  EXPECT_EQ(rig.lights.limits.vertical.max_on_s, device::LightLimits().vertical.max_on_s);
  EXPECT_EQ(rig.flash_period_s, 1.5);
  EXPECT_EQ(rig.calibration, "calibration.json");
}

TEST(RigFile, WritingAndReadingGivesTheSameSettings) {
  const std::string text = rig_to_json(parse_rig(kRig, "rig.json").value());
  EXPECT_EQ(rig_to_json(parse_rig(text, "again").value()), text);
}

TEST(RigFile, ReportsFileAndKeyAndExpectedValueOfABadKey) {
  const auto message = [](const std::string& from, const std::string& to) {
    const auto rig = parse_rig(replaced(from, to), "chair.json");
    return rig ? std::string("no error") : rig.error().message;
  };
  EXPECT_THAT(message("\"rate_hz\": 30,", ""),
              AllOf(HasSubstr("chair.json"), HasSubstr("rate_hz")));
  EXPECT_THAT(message("\"Y12\"", "\"H264\""), AllOf(HasSubstr("format"), HasSubstr("GREY")));
  EXPECT_THAT(message("[1024, 768]", "[1024]"), AllOf(HasSubstr("size_px"), HasSubstr("height")));
  EXPECT_THAT(message("\"low\"", "\"down\""), AllOf(HasSubstr("active"), HasSubstr("high")));
  EXPECT_THAT(message("\"vertical\"", "\"vertikal\""), HasSubstr("lights.vertical"));
  EXPECT_THAT(message("\"name\": \"mono\", \"serial\": \"17\"", ""), HasSubstr("match"));
  EXPECT_THAT(message(", \"flash\": {\"line\": 2, \"max_on_s\": 0.5, \"max_duty\": 0.1}", ""),
              HasSubstr("flash"));
  EXPECT_THAT(message("\"gain\": 4", "\"bits\": 10"), HasSubstr("only Y16"));
  EXPECT_THAT(message("{\"gamma\": 120, \"LED\": 0}", "[1]"), HasSubstr("controls"));
  EXPECT_THAT(message("\"max_duty\": 0.1", "\"max_duty\": 0.98"), HasSubstr("max_duty"));
}

TEST(RigFile, TriggersAreForGenicamCamerasAndForAllOrNone) {
  RigSettings rig = parse_rig(kRig, "rig.json").value();
  const auto message = [&] {
    const auto valid = rig.validate();
    return valid ? std::string() : valid.error().message;
  };
  rig.measurement.settings.trigger = "Line1";
  EXPECT_THAT(message(), HasSubstr("genicam"));
  rig.measurement.driver = DriverKind::kGenicam;
  EXPECT_THAT(message(), HasSubstr("both cameras"));
  rig.texture->driver = DriverKind::kGenicam;
  rig.texture->settings.trigger = "Line0";
  EXPECT_EQ(message(), "");
  EXPECT_TRUE(rig.is_triggered());
  const RigSettings again = parse_rig(rig_to_json(rig), "again").value();
  EXPECT_EQ(again.texture->settings.trigger, "Line0");
  EXPECT_FALSE(again.free_running().is_triggered());
  EXPECT_EQ(again.free_running().texture->settings.trigger, "");
}

TEST(RigFile, CalibrationPathIsRelativeToTheFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_file(folder.path() / "rig.json", kRig));
  const RigSettings rig = read_rig(folder.path() / "rig.json").value();
  EXPECT_EQ(*rig.calibration, folder.path() / "calibration.json");
  EXPECT_FALSE(read_rig(folder.path() / "none.json"));
}

}  // namespace
}  // namespace flytri::rig
