#include "tests/support/scene_fixture.h"

#include <algorithm>

#include "core/base/random.h"
#include "tests/support/no_display.h"

namespace flytri::testing {

void SceneFixture::SetUp() {
  context_ = GlContext::create();
  if (!context_) GTEST_SKIP() << kNoDisplay;
  Result<ui::SceneRenderer> renderer = ui::SceneRenderer::create();
  ASSERT_TRUE(renderer) << renderer.error().message;
  renderer_ = std::move(*renderer);
  options_.background_top = options_.background_bottom = {0.0F, 0.0F, 0.0F, 1.0F};
  ui::CameraPose pose;
  pose.height_mm = kSize.height_px / kPxPerMm;
  camera_.set_pose(pose);
}

cv::Mat SceneFixture::one_picture() {
  renderer_->draw(content_, options_, camera_, kSize, now_s_);
  return renderer_->picture().read();
}

cv::Mat SceneFixture::picture() {
  cv::Mat latest = one_picture();
  // Each draw handles some blocks; 1000 draws are more than any test needs.
  for (int i = 0; i < 1000 && renderer_->wants_redraw(); ++i) {
    now_s_ += 0.1;
    latest = one_picture();
  }
  EXPECT_FALSE(renderer_->wants_redraw());
  return latest;
}

Vec2 SceneFixture::pixel(double x_mm, double y_mm) {
  return {0.5 * kSize.width_px + kPxPerMm * x_mm - 0.5,
          0.5 * kSize.height_px - kPxPerMm * y_mm - 0.5};
}

SurfelModel block_of(std::vector<Surfel> surfels, std::uint64_t place) {
  auto block = std::make_shared<SurfelBlock>();
  block->place = place;
  block->surfels = std::move(surfels);
  return {block};
}

std::vector<Surfel> surfel_square(double edge_mm, double spacing_mm) {
  std::vector<Surfel> surfels;
  for (double x = -0.5 * edge_mm; x <= 0.5 * edge_mm; x += spacing_mm) {
    for (double y = -0.5 * edge_mm; y <= 0.5 * edge_mm; y += spacing_mm) {
      Surfel s;
      s.position_mm = Vec3(x, y, 0.0).cast<float>();
      s.radius_mm = static_cast<float>(0.85 * spacing_mm);
      s.coverage = Coverage::kGood;
      surfels.push_back(s);
    }
  }
  Random random(1);
  for (std::size_t i = surfels.size(); i > 1; --i) {
    std::swap(surfels[i - 1], surfels[random.below(i)]);
  }
  return surfels;
}

double share_differing(const cv::Mat& a, const cv::Mat& b, int limit) {
  int differing = 0;
  for (int row = 0; row < a.rows; ++row) {
    for (int column = 0; column < a.cols; ++column) {
      const auto& p = a.at<cv::Vec3b>(row, column);
      const auto& q = b.at<cv::Vec3b>(row, column);
      int largest = 0;
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(p[c] - q[c]));
      differing += largest > limit ? 1 : 0;
    }
  }
  return static_cast<double>(differing) / static_cast<double>(a.total());
}

}  // namespace flytri::testing
