#include "hw/shots/board_session.h"

#include <ctime>
#include <utility>

#include "core/base/iso_time.h"
#include "core/calibration/guide/board_shot.h"
#include "core/io/calibrations/board_set_file.h"
#include "core/io/calibrations/calibration_file.h"
#include "core/io/files/file_bytes.h"

namespace flytri::shots {
namespace {

using calibration::BoardPose;
using calibration::BoardSet;
using calibration::CalibrationScene;
using calibration::NamedImage;
using calibration::ShotKind;

bool is_same(const CalibrationScene& a, const CalibrationScene& b) {
  return a.volume.size_mm == b.volume.size_mm && a.line_counts == b.line_counts &&
         a.dots.pitch_mm == b.dots.pitch_mm && a.dots.diameter_mm == b.dots.diameter_mm &&
         a.dots.marker_diameter_mm == b.dots.marker_diameter_mm;
}

Result<BoardSet> continued(const std::filesystem::path& folder, const CalibrationScene& scene,
                           bool has_texture) {
  auto set = io::read_board_set(folder);
  if (!set) return set;
  if (is_same(*set, scene) && set->has_texture() == has_texture) return set;
  return fail(ErrorCode::kInconsistent,
              "{}: holds a calibration of another sensor or board; choose another folder",
              folder.string());
}

}  // namespace

Result<BoardSession> BoardSession::open(const std::filesystem::path& folder,
                                        const CalibrationScene& scene,
                                        std::shared_ptr<ShotSource> source) {
  BoardSet set{scene, {}};
  if (std::filesystem::exists(folder / io::kBoardSetFile)) {
    auto found = continued(folder, scene, source->has_texture());
    if (!found) return tl::unexpected(found.error());
    set = *std::move(found);
  } else if (auto made = io::create_folder(folder); !made) {
    return tl::unexpected(made.error());
  }
  return BoardSession(folder, std::move(set), std::move(source));
}

BoardSession::BoardSession(std::filesystem::path folder, BoardSet set,
                           std::shared_ptr<ShotSource> source)
    : folder_(std::move(folder)),
      set_(std::move(set)),
      source_(std::move(source)),
      places_(calibration::board_places()) {}

Result<BoardPose> BoardSession::shoot(std::size_t index, const Progress& progress) {
  const calibration::BoardPlace& place = places_[index];
  const double depth_mm = set_.volume.size_mm.z();
  source_->hold_board(pose_of(place, depth_mm));
  struct Shot {
    NamedImage BoardPose::*image;
    ShotKind kind;
  };
  BoardPose pose;
  name_images(pose, index);
  for (const Shot& shot :
       {Shot{&BoardPose::dots, ShotKind::kDots}, Shot{&BoardPose::vertical, ShotKind::kVertical},
        Shot{&BoardPose::horizontal, ShotKind::kHorizontal},
        Shot{&BoardPose::dots_texture, ShotKind::kDotsTexture},
        Shot{&BoardPose::dots_after, ShotKind::kDots}}) {
    if (shot.kind == ShotKind::kDotsTexture && !source_->has_texture()) continue;
    auto image = source_->take(shot.kind, place.depth_share * depth_mm, progress);
    if (!image) return tl::unexpected(image.error());
    (pose.*shot.image).image = *std::move(image);
  }
  if (auto good = check_board_pose(pose, set_, {}); !good) return tl::unexpected(good.error());
  return pose;
}

Result<void> BoardSession::take(std::size_t index, const Progress& progress) {
  auto pose = shoot(index, progress);
  if (!pose) return tl::unexpected(pose.error());
  if (auto written = io::write_board_pose(folder_, *pose); !written) return written;
  if (index == set_.poses.size()) set_.poses.emplace_back();
  set_.poses[index] = *std::move(pose);
  return io::write_board_set_text(folder_, set_);
}

Result<calibration::BoardCalibration> BoardSession::finish(const Workers& workers,
                                                           const Progress& progress,
                                                           const std::string& note) const {
  auto fitted = calibration::calibrate_board(set_, {}, workers, progress);
  if (!fitted) return fitted;
  fitted->calibration.history.made_at = iso_time(std::time(nullptr));
  fitted->calibration.history.note = note;
  const auto written = io::write_calibration(folder_ / "calibration.json", fitted->calibration);
  if (!written) return tl::unexpected(written.error());
  return fitted;
}

}  // namespace flytri::shots
