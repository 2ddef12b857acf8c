#include "core/reconstruct/recover_views.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/reconstruct/row_share.h"

namespace flytri::reconstruct {
namespace {

/// If a smaller share of the views is unconnected, it is not worth the time.
constexpr double kLeastUnconnected = 0.03;
/// Enough to know the readout.
constexpr std::size_t kMostViews = 200;
/// Too few to know it.
constexpr std::size_t kFewestViews = 20;
/// Share of the time for the readout; the rest is for registering again.
constexpr double kFindingShare = 0.5;

bool is_unconnected(const tracking::RegisteredView& view) {
  return view.fate == tracking::ViewFate::kRejected &&
         view.reason != tracking::RejectReason::kTooFewPoints &&
         view.reason != tracking::RejectReason::kTimeNotRising;
}

/// Successive registered views, from the middle of them: the motion of the sensor shows only in
/// neighbors.
std::vector<AlignedView> some_connected(const std::vector<tracking::RegisteredView>& settled) {
  std::vector<AlignedView> views;
  for (const tracking::RegisteredView& view : settled) {
    if (view.fate == tracking::ViewFate::kRegistered && !view.view->profiles.empty())
      views.push_back({view.view, view.T_world_sensor});
  }
  if (views.size() <= kMostViews) return views;
  const auto begin = views.begin() + static_cast<std::ptrdiff_t>((views.size() - kMostViews) / 2);
  return {begin, begin + static_cast<std::ptrdiff_t>(kMostViews)};
}

/// None: too few views, or not surely a rolling shutter.
Result<std::optional<refinement::Readout>> find_readout(
    std::vector<AlignedView> views, const refinement::RowShare& row_share,
    const refinement::JointRefineOptions& options, const Workers& workers,
    const Progress& progress) {
  if (views.size() < kFewestViews) return std::nullopt;
  const Progress third = progress.part(1.0 / 3.0);
  auto refined = refinement::refine_jointly(views, options, workers, third);
  if (!refined) return tl::unexpected(refined.error());
  auto readout = refinement::estimate_readout(views, row_share, options, workers, third);
  if (!readout) return tl::unexpected(readout.error());
  if (!readout->is_long()) return std::nullopt;
  refined = refinement::refine_with_readout(views, *readout, row_share, options, workers, third);
  if (!refined) return tl::unexpected(refined.error());
  return *readout;
}

}  // namespace

Result<std::vector<tracking::RegisteredView>> recover_views(
    tracking::Registrar& registrar, std::vector<tracking::RegisteredView> settled,
    const calibration::Calibration& calibration, const RecoverOptions& options,
    const Workers& workers, const Progress& progress) {
  const auto unconnected = std::count_if(settled.begin(), settled.end(), is_unconnected);
  if (static_cast<double>(unconnected) < kLeastUnconnected * static_cast<double>(settled.size())) {
    progress.advance();
    return settled;
  }
  const refinement::RowShare row_share = row_share_of(calibration);
  const auto readout = find_readout(some_connected(settled), row_share, options.refinement, workers,
                                    progress.part(kFindingShare));
  if (!readout) return tl::unexpected(readout.error());
  if (!*readout) return settled;
  std::map<FrameIndex, std::shared_ptr<const View>> measured;
  for (const tracking::RegisteredView& view : settled) measured[view.view->frame] = view.view;
  registrar.change_points([&](std::vector<AlignedView> part) {
    return refinement::without_rolling_shutter(std::move(part), (*readout)->readout_s, row_share);
  });
  settled = registrar.finish(options.world, progress.part(1.0 - kFindingShare));
  registrar.change_points([&](std::vector<AlignedView> part) {
    for (AlignedView& view : part) view.view = measured.at(view.view->frame);
    return part;
  });
  if (progress.cancelled()) return stopped();
  for (tracking::RegisteredView& view : settled) view.view = measured.at(view.view->frame);
  return settled;
}

}  // namespace flytri::reconstruct
