#include "core/calibration/guide/calibration_plan.h"

#include "core/calibration/fit/check_set.h"

namespace flytri::calibration {

std::string_view to_string(TargetFace face) {
  return face == TargetFace::kDots ? "dot target" : "white plane";
}

std::string_view to_string(ShotKind kind) {
  switch (kind) {
    case ShotKind::kDark:
      return "dark";
    case ShotKind::kVertical:
      return "vertical lines";
    case ShotKind::kHorizontal:
      return "horizontal lines";
    case ShotKind::kVerticalAgain:
      return "vertical lines again";
    case ShotKind::kDots:
      return "dots";
    case ShotKind::kDotsTexture:
      return "dots in color";
  }
  return "";
}

TargetFace face_of(ShotKind kind) {
  return kind == ShotKind::kDots || kind == ShotKind::kDotsTexture ? TargetFace::kDots
                                                                   : TargetFace::kWhitePlane;
}

const std::vector<ShotKind>& shots_of(TargetFace face, bool has_texture) {
  static const std::vector<ShotKind> kWhite = {ShotKind::kDark, ShotKind::kVertical,
                                               ShotKind::kHorizontal, ShotKind::kVerticalAgain};
  static const std::vector<ShotKind> kDots = {ShotKind::kDots, ShotKind::kDotsTexture};
  static const std::vector<ShotKind> kGrayDots = {ShotKind::kDots};
  if (face == TargetFace::kWhitePlane) return kWhite;
  return has_texture ? kDots : kGrayDots;
}

Result<void> CalibrationPlan::validate() const {
  return check_numbers({volume, line_counts, dots}, z_mm);
}

std::vector<Placement> placements_of(const CalibrationPlan& plan) {
  std::vector<Placement> placements;
  const std::size_t planes = plan.z_mm.size();
  if (plan.order == PlacementOrder::kByPlane) {
    for (std::size_t i = 0; i < planes; ++i) {
      placements.push_back({i, TargetFace::kWhitePlane});
      placements.push_back({i, TargetFace::kDots});
    }
    return placements;
  }
  for (const TargetFace face : {TargetFace::kWhitePlane, TargetFace::kDots}) {
    for (std::size_t i = 0; i < planes; ++i) placements.push_back({i, face});
  }
  return placements;
}

std::vector<double> even_depths_mm(const MeasurementVolume& volume, int count, double depth_share) {
  std::vector<double> z_mm;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1) - 0.5;
    z_mm.push_back(share * depth_share * volume.size_mm.z());
  }
  return z_mm;
}

}  // namespace flytri::calibration
