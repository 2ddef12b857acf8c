#include "hw/simulated/optics/line_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flytri::simulated {
namespace {

constexpr int kBlurs = 48;
constexpr int kOffsets = 384;
constexpr int kChords = 41;  // number of strips that approximate the defocus disk

}  // namespace

LineProfile::LineProfile(const ProjectorModel& projector, double max_blur)
    : half_width_(projector.half_width_across),
      sigma_(std::max(projector.diffraction_sigma, 1e-3 * projector.half_width_across)),
      blur_step_(std::max(max_blur, 1e-12) / (kBlurs - 2)),
      offset_step_(reach(max_blur) / (kOffsets - 2)) {
  table_.reserve(static_cast<std::size_t>(kBlurs) * kOffsets);
  for (int i = 0; i < kBlurs; ++i)
    for (int j = 0; j < kOffsets; ++j)
      table_.push_back(static_cast<float>(compute(j * offset_step_, i * blur_step_)));
}

double LineProfile::compute(double offset, double blur) const {
  // A box convolved with a Gaussian is a difference of error functions; sum over the strips of the
  // disk.
  const double scale = 1.0 / (std::numbers::sqrt2 * sigma_);
  double sum = 0.0;
  double weights = 0.0;
  for (int k = 0; k < kChords; ++k) {
    const double strip = 2.0 * (k + 0.5) / kChords - 1.0;
    const double weight = std::sqrt(1.0 - strip * strip);
    const double x = offset - strip * blur;
    sum +=
        weight * 0.5 * (std::erf((x + half_width_) * scale) - std::erf((x - half_width_) * scale));
    weights += weight;
  }
  return sum / weights;
}

double LineProfile::operator()(double offset, double blur) const {
  const double x = std::abs(offset) / offset_step_;
  if (x >= kOffsets - 1) return 0.0;
  const double y = std::min(blur / blur_step_, kBlurs - 1.001);
  const int i = static_cast<int>(y);
  const int j = static_cast<int>(x);
  const double ty = y - i;
  const double tx = x - j;
  const float* row = &table_[static_cast<std::size_t>(i) * kOffsets + j];
  return (1.0 - ty) * ((1.0 - tx) * row[0] + tx * row[1]) +
         ty * ((1.0 - tx) * row[kOffsets] + tx * row[kOffsets + 1]);
}

LineProfile::Section LineProfile::section(double blur) const {
  const double y = std::min(blur / blur_step_, kBlurs - 1.001);
  const int i = static_cast<int>(y);
  Section section;
  section.near_ = &table_[static_cast<std::size_t>(i) * kOffsets];
  section.far_ = section.near_ + kOffsets;
  section.ty_ = static_cast<float>(y - i);
  section.steps_ = static_cast<float>(1.0 / offset_step_);
  section.last_ = kOffsets - 1;
  return section;
}

}  // namespace flytri::simulated
