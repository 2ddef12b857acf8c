#include "core/reconstruct/recover_views.h"

#include <algorithm>
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
/// Share of that for the views one by one; the rest is for those that were lost.
constexpr double kAddingShare = 0.7;

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
    std::vector<AlignedView> views, const trajectory::RowShare& row_share,
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

std::size_t count_registered(const std::vector<tracking::RegisteredView>& views) {
  return static_cast<std::size_t>(std::count_if(views.begin(), views.end(), [](const auto& view) {
    return view.fate == tracking::ViewFate::kRegistered;
  }));
}

/// Frame of `to` from that of `from`, by a view in the middle that both know.
std::optional<Isometry> frame_change(const std::vector<tracking::RegisteredView>& from,
                                     const std::vector<tracking::RegisteredView>& to) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i].fate == tracking::ViewFate::kRegistered &&
        to[i].fate == tracking::ViewFate::kRegistered)
      known.push_back(i);
  }
  if (known.empty()) return std::nullopt;
  const std::size_t i = known[known.size() / 2];
  return to[i].T_world_sensor * from[i].T_world_sensor.inverse();
}

/// Registers all views from the first on, with a known shutter. Returns nothing, and leaves the
/// registrar as it is, if this finds no more views.
std::optional<std::vector<tracking::RegisteredView>> register_again(
    tracking::Registrar& registrar, const std::vector<tracking::RegisteredView>& settled,
    const trajectory::Shutter& shutter, tracking::Registrar::World world,
    const Progress& progress) {
  tracking::RegistrarOptions options = registrar.options();
  options.track.shutter = shutter;
  // The options were validated before, so an error cannot occur.
  tracking::Registrar again = *tracking::Registrar::create(options);
  for (const tracking::RegisteredView& view : settled) {
    if (progress.cancelled()) return std::nullopt;
    again.add(view.view);
    progress.advance(kAddingShare / static_cast<double>(settled.size()));
  }
  auto found =
      again.finish(tracking::Registrar::World::kFirstView, progress.part(1.0 - kAddingShare));
  if (count_registered(found) <= count_registered(settled)) return std::nullopt;
  if (world == tracking::Registrar::World::kUnchanged) {
    const auto T_before_now = frame_change(found, settled);
    if (!T_before_now) return std::nullopt;
    again.change_frame(*T_before_now);
    for (tracking::RegisteredView& view : found)
      view.T_world_sensor = *T_before_now * view.T_world_sensor;
  }
  registrar = std::move(again);
  return found;
}

}  // namespace

Result<std::vector<tracking::RegisteredView>> recover_views(
    tracking::Registrar& registrar, std::vector<tracking::RegisteredView> settled,
    const calibration::Calibration& calibration, const RecoverOptions& options,
    const Workers& workers, const Progress& progress) {
  // Retired views have no points any more, so they cannot be registered again.
  const bool is_whole =
      std::none_of(settled.begin(), settled.end(), [](const tracking::RegisteredView& view) {
        return view.fate == tracking::ViewFate::kRegistered && view.view->profiles.empty();
      });
  const auto unconnected = std::count_if(settled.begin(), settled.end(), is_unconnected);
  if (!is_whole || registrar.options().track.shutter.is_rolling() ||
      static_cast<double>(unconnected) < kLeastUnconnected * static_cast<double>(settled.size())) {
    progress.advance();
    return settled;
  }
  const trajectory::RowShare row_share = row_share_of(calibration);
  const auto readout = find_readout(some_connected(settled), row_share, options.refinement, workers,
                                    progress.part(kFindingShare));
  if (!readout) return tl::unexpected(readout.error());
  if (!*readout) return settled;
  auto again = register_again(registrar, settled, {(*readout)->readout_s, row_share}, options.world,
                              progress.part(1.0 - kFindingShare));
  if (progress.cancelled()) return stopped();
  if (!again) return settled;
  return *std::move(again);
}

}  // namespace flytri::reconstruct
