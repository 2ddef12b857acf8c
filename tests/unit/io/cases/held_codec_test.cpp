/// @file  The surface of a finished model, which locks hold: as bytes, and in a case.
#include "core/io/cases/held_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/io/cases/case_file.h"
#include "tests/support/case_samples.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr ScanStage kHeldStage = ScanStage::kUpper;

editing::HeldSurface sample_surface(int number) {
  editing::HeldSurface held;
  held.spacing_mm = 0.1 / 3.0;
  held.seen_until_s = 20.0 / 3.0;
  held.edited_at_s = {0.1, 0.2};
  for (int i = 0; i < 3; ++i) held.views.push_back({i / 3.0, testing::sample_pose(number + i)});
  held.textures.push_back({1.0 / 7.0, testing::sample_pose(number), Vec3f(0.9F, 1.0F, 1.1F)});
  for (int i = 0; i < 5; ++i) {
    SurfacePoint point;
    point.position_mm = Vec3f(0.1F * static_cast<float>(i), 1.0F / 3.0F, -7.0F);
    point.normal = Vec3f(0.6F, 0.0F, 0.8F);
    point.sigma_mm = i == 2 ? std::numeric_limits<float>::infinity() : 0.004F;
    point.color = {static_cast<std::uint8_t>(i), 128, 255};
    point.patterns = 3;
    held.points.push_back(point);
    if (i < 4) held.vertices.push_back(point);
  }
  return held;
}

std::shared_ptr<const editing::HeldSurface> shared_surface(int number) {
  return std::make_shared<const editing::HeldSurface>(sample_surface(number));
}

bool holds(const StoredStage& stage, int number) {
  return stage.held != nullptr &&
         encode_held_surface(*stage.held) == encode_held_surface(sample_surface(number));
}

TEST(HeldCodec, GivesTheSameBits) {
  const editing::HeldSurface held = sample_surface(1);
  const std::string bytes = encode_held_surface(held);
  const auto decoded = decode_held_surface(bytes);
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(encode_held_surface(*decoded), bytes);
  EXPECT_EQ(decoded->edited_at_s, held.edited_at_s);
  EXPECT_EQ(decoded->views[2].time_s, held.views[2].time_s);
  EXPECT_TRUE(testing::same_bits(decoded->views[2].T_world_sensor, held.views[2].T_world_sensor));
  EXPECT_EQ(decoded->textures[0].gain, held.textures[0].gain);
  ASSERT_EQ(decoded->points.size(), 5U);
  ASSERT_EQ(decoded->vertices.size(), 4U);
  EXPECT_EQ(decoded->points[4].position_mm, held.points[4].position_mm);
  EXPECT_EQ(decoded->points[4].color, held.points[4].color);
  EXPECT_EQ(decoded->vertices[2].sigma_mm, held.vertices[2].sigma_mm);
}

TEST(HeldCodec, RefusesWhatIsCutOffTooLongOrImpossible) {
  const std::string bytes = encode_held_surface(sample_surface(1));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode_held_surface(std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(decode_held_surface(bytes + '\0'));
  const auto refused = [](const auto& change) {
    editing::HeldSurface held = sample_surface(1);
    change(held);
    const auto decoded = decode_held_surface(encode_held_surface(held));
    return !decoded && decoded.error().code == ErrorCode::kBadFormat;
  };
  EXPECT_TRUE(refused([](auto& held) { held.spacing_mm = 0.0; }));
  EXPECT_TRUE(refused([](auto& held) { held.seen_until_s = NAN; }));
  EXPECT_TRUE(refused([](auto& held) { held.points[1].position_mm.x() = NAN; }));
  EXPECT_TRUE(refused([](auto& held) { held.points[1].position_mm.x() = 1e9F; }));
  EXPECT_TRUE(refused([](auto& held) { held.vertices[1].normal.y() = NAN; }));
  EXPECT_TRUE(refused([](auto& held) { held.vertices[1].sigma_mm = -1.0F; }));
  EXPECT_TRUE(refused([](auto& held) { held.views[0].T_world_sensor.linear() *= 2.0; }));
  EXPECT_TRUE(refused([](auto& held) { held.textures[0].gain.x() = 0.0F; }));
}

TEST(HeldSurfaceOfACase, IsKeptWithTheModelAndIsNoModelItself) {
  const TemporaryFolder folder;
  const auto path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    ASSERT_TRUE(file.write_result(kHeldStage, {"model", "{}", {}, shared_surface(1)}));
    ASSERT_TRUE(file.commit());
  }
  CaseFile file = CaseFile::open(path).value();
  EXPECT_TRUE(holds(file.load_stage(kHeldStage).value(), 1));
  EXPECT_EQ(file.load_result(kHeldStage)->glb, "model");
  EXPECT_TRUE(file.counts(kHeldStage)->has_result);
  // A model from elsewhere comes without.
  ASSERT_TRUE(file.write_result(kHeldStage, {"other", "{}"}));
  EXPECT_EQ(file.load_stage(kHeldStage)->held, nullptr);
}

TEST(HeldSurfaceOfACase, GoesIntoCopiesClearedStagesAndRescueCopies) {
  const TemporaryFolder folder;
  CaseFile file = CaseFile::create(folder / "a.flytri", {}).value();
  ASSERT_TRUE(testing::append_registered_views(file, kHeldStage, 0, 2));
  ASSERT_TRUE(file.write_result(kHeldStage, {"model", "{}", {}, shared_surface(1)}));
  ASSERT_TRUE(file.copy_stage(kHeldStage, ScanStage::kUpperPreop, true));
  ASSERT_TRUE(file.copy_stage(kHeldStage, ScanStage::kUpperScanBody, false));
  EXPECT_TRUE(holds(file.load_stage(ScanStage::kUpperPreop).value(), 1));
  EXPECT_TRUE(holds(file.load_stage(ScanStage::kUpperScanBody).value(), 1));
  EXPECT_FALSE(file.counts(ScanStage::kUpperScanBody)->has_result);
  const auto survey = file.rescue_to(folder / "b.flytri");
  ASSERT_TRUE(survey);
  EXPECT_THAT(survey->lost, IsEmpty());
  EXPECT_FALSE(survey->readable[index_of(ScanStage::kUpperScanBody)].has_result);
  EXPECT_TRUE(holds(CaseFile::open(folder / "b.flytri")->load_stage(kHeldStage).value(), 1));
  ASSERT_TRUE(file.clear_stage(kHeldStage));
  EXPECT_EQ(file.load_stage(kHeldStage)->held, nullptr);
  ASSERT_TRUE(file.bring_back_stage(kHeldStage));
  EXPECT_TRUE(holds(file.load_stage(kHeldStage).value(), 1));
}

TEST(HeldSurfaceOfACase, ThatIsDamagedCostsOnlyItself) {
  const TemporaryFolder folder;
  const auto path = folder / "a.flytri";
  {
    CaseFile file = CaseFile::create(path, {}).value();
    ASSERT_TRUE(testing::append_registered_views(file, kHeldStage, 0, 2));
    ASSERT_TRUE(file.write_result(kHeldStage, {"model", "{}", {}, shared_surface(1)}));
    ASSERT_TRUE(file.commit());
  }
  ASSERT_EQ(testing::run_sql(path, "UPDATE models SET data = x'00' WHERE id % 2 = 1"), "");
  CaseFile file = CaseFile::open(path).value();
  const StoredStage stage = file.load_stage(kHeldStage).value();
  EXPECT_EQ(stage.held, nullptr);
  EXPECT_EQ(stage.views.size(), 2U);
  EXPECT_THAT(stage.damage, ::testing::ElementsAre(HasSubstr("models")));
  EXPECT_EQ(file.load_result(kHeldStage)->glb, "model");
}

}  // namespace
}  // namespace flytri::io
