#include "core/editing/serving_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/normals/normals.h"

namespace flytri::editing {
namespace {

/// Less is no profile, as in a measured view.
constexpr std::size_t kLeastPoints = 2;

/// Whether an edit may reach a sample of the view.
bool may_be_cut(const AlignedView& aligned, const EditFilter& edits) {
  Eigen::AlignedBox3d box;
  for (const Profile& profile : aligned.view->profiles) {
    for (const ProfilePoint& point : profile.points) box.extend(point.position_mm);
  }
  if (box.isEmpty()) return false;
  const Vec3f middle_mm = (aligned.T_world_sensor * box.center()).cast<float>();
  const auto radius_mm = static_cast<float>(0.5 * box.diagonal().norm());
  return edits.may_remove(middle_mm, radius_mm, aligned.view->time_s);
}

/// Adds the runs of points that are kept as profiles.
/// @return  number of points that are not kept
std::size_t add_kept(const Profile& profile, const std::vector<Vec3f>& normals,
                     const AlignedView& aligned, const EditFilter& edits,
                     std::vector<Profile>& kept) {
  const Vec3f towards = -aligned.T_world_sensor.linear().col(2).cast<float>();
  std::size_t removed = 0;
  Profile run{profile.line, profile.sheet_normal, {}};
  const auto end_run = [&] {
    if (run.points.size() >= kLeastPoints) kept.push_back(run);
    run.points.clear();
  };
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const ProfilePoint& point = profile.points[i];
    const Vec3f position_mm = (aligned.T_world_sensor * point.position_mm).cast<float>();
    // On a thin edge the profiles of the far side may have turned the normal round.
    const Vec3f normal = normals[i].dot(towards) < 0.0F ? Vec3f(-normals[i]) : normals[i];
    if (edits.keeps(position_mm, normal, aligned.view->time_s)) {
      run.points.push_back(point);
    } else {
      ++removed;
      end_run();
    }
  }
  end_run();
  return removed;
}

std::shared_ptr<const View> kept_part(const AlignedView& aligned,
                                      const normals::ViewNormals& normals,
                                      const EditFilter& edits) {
  const View& whole = *aligned.view;
  auto part = std::make_shared<View>(View{whole.pattern, whole.frame, whole.time_s, {}});
  std::size_t removed = 0;
  for (std::size_t k = 0; k < whole.profiles.size(); ++k) {
    removed += add_kept(whole.profiles[k], normals[k], aligned, edits, part->profiles);
  }
  return removed == 0 ? aligned.view : std::move(part);
}

/// Cuts views that were seen between the same two edits.
void cut_together(std::span<const std::size_t> numbers, std::vector<AlignedView>& views,
                  const EditFilter& edits, const Workers& workers) {
  std::vector<AlignedView> whole;
  whole.reserve(numbers.size());
  for (const std::size_t i : numbers) whole.push_back(views[i]);
  // The options are the defaults, and nobody cancels.
  const auto normals = normals::crossing_normals(whole, {}, workers);
  if (!normals) return;
  workers.for_each(numbers.size(), [&](std::size_t k) {
    views[numbers[k]].view = kept_part(whole[k], (*normals)[k], edits);
  });
}

}  // namespace

std::vector<AlignedView> serving_views(std::span<const AlignedView> views, const EditFilter& edits,
                                       const Workers& workers) {
  std::vector<AlignedView> serving(views.begin(), views.end());
  if (edits.empty()) return serving;
  std::vector<char> is_touched(views.size(), 0);
  workers.for_each(views.size(),
                   [&](std::size_t i) { is_touched[i] = may_be_cut(views[i], edits) ? 1 : 0; });
  std::vector<double> ends_s = edits.times();
  ends_s.push_back(std::numeric_limits<double>::infinity());
  std::vector<std::vector<std::size_t>> between(ends_s.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (is_touched[i] == 0) continue;
    const auto end = std::lower_bound(ends_s.begin(), ends_s.end(), views[i].view->time_s);
    between[static_cast<std::size_t>(end - ends_s.begin())].push_back(i);
  }
  for (const auto& numbers : between) {
    if (!numbers.empty()) cut_together(numbers, serving, edits, workers);
  }
  return serving;
}

}  // namespace flytri::editing
