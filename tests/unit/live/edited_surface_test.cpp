/// @file  Edits of the live surface: what undo and redo give is what all views give.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/live/live_surface.h"
#include "tests/support/scan_scene.h"

namespace flytri::live {
namespace {

using editing::EditKind;
using editing::EditStack;

/// All that a surfel shows, sorted by place.
std::vector<Surfel> sorted_surfels(LiveSurface& surface) {
  std::vector<Surfel> all;
  for (const auto& block : surface.publish())
    all.insert(all.end(), block->surfels.begin(), block->surfels.end());
  std::sort(all.begin(), all.end(), [](const Surfel& a, const Surfel& b) {
    const Vec3f &p = a.position_mm, &q = b.position_mm;
    return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
  });
  return all;
}

/// A scan of cusps that is edited as it grows.
class EditedSurface : public ::testing::Test {
 protected:
  void scan_more(std::size_t view_count) {
    for (const std::size_t end = seen_ + view_count; seen_ < end; ++seen_)
      surface_.add(views_[seen_]);
  }
  /// A stroke of three dabs that begins at this place.
  void paint(EditKind kind, float x_mm, float y_mm) {
    editing::Edit edit{kind, views_[seen_ - 1].view->time_s, {}};
    for (int i = 0; i < 3; ++i) {
      const Vec3f center_mm(x_mm + static_cast<float>(i), y_mm, -0.5F);
      edit.dabs.push_back({center_mm, Vec3f(0.3F, 0, -1).normalized(), 2.5F});
    }
    edits_.push(std::move(edit));
    surface_.set_edits(edits_);
  }
  void undo() {
    edits_.undo();
    surface_.set_edits(edits_);
  }
  void redo() {
    edits_.redo();
    surface_.set_edits(edits_);
  }
  /// The surface that the views so far give with the present edits.
  [[nodiscard]] std::vector<Surfel> rebuilt() const {
    LiveSurface surface = LiveSurface::create().value();
    surface.set_edits(edits_);
    for (std::size_t i = 0; i < seen_; ++i) surface.add(views_[i]);
    surface.settle_edits();
    return sorted_surfels(surface);
  }
  /// Whether the surface is, bit for bit, the one that the views give.
  [[nodiscard]] bool is_as_rebuilt() {
    surface_.settle_edits();
    return sorted_surfels(surface_) == rebuilt();
  }

  std::vector<AlignedView> views_ = testing::scan_cusps(80, {}, 5).views;
  LiveSurface surface_ = LiveSurface::create().value();
  EditStack edits_;
  std::size_t seen_ = 0;
};

TEST_F(EditedSurface, UndoAndRedoGiveWhatAllViewsGive) {
  scan_more(40);
  paint(EditKind::kTrim, -3.0F, 0.0F);
  EXPECT_TRUE(is_as_rebuilt());
  paint(EditKind::kTrim, -1.0F, 2.0F);
  EXPECT_TRUE(is_as_rebuilt());
  for (int i = 0; i < 2; ++i) {
    undo();
    EXPECT_TRUE(is_as_rebuilt()) << "undone " << i + 1;
  }
  for (int i = 0; i < 2; ++i) {
    redo();
    EXPECT_TRUE(is_as_rebuilt()) << "redone " << i + 1;
  }
}

TEST_F(EditedSurface, ViewsAfterAnEditStayWhereTheyBelong) {
  scan_more(30);
  paint(EditKind::kTrim, -3.0F, 0.0F);
  scan_more(10);
  paint(EditKind::kLock, -1.0F, 2.0F);
  scan_more(15);
  paint(EditKind::kTrim, -2.0F, 1.0F);
  scan_more(10);
  paint(EditKind::kUnlock, 0.0F, 2.0F);
  EXPECT_TRUE(is_as_rebuilt());
  for (int i = 0; i < 4; ++i) {
    undo();
    EXPECT_TRUE(is_as_rebuilt()) << "undone " << i + 1;
  }
  scan_more(15);
  EXPECT_TRUE(is_as_rebuilt()) << "scanned while all was undone";
  for (int i = 0; i < 4; ++i) {
    redo();
    EXPECT_TRUE(is_as_rebuilt()) << "redone " << i + 1;
  }
}

TEST_F(EditedSurface, ANewEditAfterUndoActsAsIfTheUndoneOneHadNeverBeen) {
  scan_more(30);
  paint(EditKind::kTrim, -2.0F, 0.0F);
  undo();
  scan_more(20);
  paint(EditKind::kTrim, -2.0F, 0.0F);
  scan_more(10);
  EXPECT_TRUE(is_as_rebuilt());
  undo();
  EXPECT_TRUE(is_as_rebuilt());
}

TEST_F(EditedSurface, UndoBringsBackEverySurfel) {
  scan_more(40);
  const std::size_t before = sorted_surfels(surface_).size();
  paint(EditKind::kTrim, -3.0F, 0.0F);
  const std::size_t trimmed = sorted_surfels(surface_).size();
  EXPECT_LT(trimmed, before - 300);
  undo();
  EXPECT_EQ(sorted_surfels(surface_).size(), before);
  redo();
  EXPECT_EQ(sorted_surfels(surface_).size(), trimmed);
}

TEST(SurfaceSums, DoNotDependOnTheOrderOfThePoints) {
  Random random(3);
  std::vector<CellSums> points(1000);
  for (CellSums& point : points) {
    point.point_count = 1;
    const Vec3f v(random.normal(), random.normal(), random.normal());
    point.offset_mm = (0.1F * v).cast<double>().unaryExpr([](double x) { return rounded<24>(x); });
    point.covariance_mm2 = rounded_square<44>(0.03F * v, 0.7);
    point.directions.tangents = rounded_square<30>(v.normalized());
  }
  CellSums forwards, backwards, half;
  for (std::size_t i = 0; i < points.size(); ++i) {
    forwards += points[i];
    backwards += points[points.size() - 1 - i];
    if (i % 2 == 0) half += points[i];
  }
  EXPECT_EQ(forwards.offset_mm, backwards.offset_mm);
  EXPECT_EQ(forwards.covariance_mm2, backwards.covariance_mm2);
  EXPECT_EQ(forwards.directions.tangents, backwards.directions.tangents);
  forwards -= half;
  for (std::size_t i = 0; i < points.size(); i += 2) backwards -= points[i];
  EXPECT_EQ(forwards.offset_mm, backwards.offset_mm);
  EXPECT_EQ(forwards.covariance_mm2, backwards.covariance_mm2);
}

}  // namespace
}  // namespace flytri::live
