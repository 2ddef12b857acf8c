#include "core/editing/edits.h"

#include <algorithm>
#include <utility>

namespace flytri::editing {
namespace {

bool holds(const BrushDab& dab, const Vec3f& position_mm) {
  return (position_mm - dab.center_mm).squaredNorm() <= dab.radius_mm * dab.radius_mm;
}

bool reaches(const BrushDab& dab, const Vec3f& position_mm, const Vec3f& normal) {
  return holds(dab, position_mm) && normal.dot(dab.normal) > 0.0F;
}

/// A crafted case may hold any numbers: the search needs such as a user can have painted.
bool can_be_painted(const BrushDab& dab) {
  constexpr float kLargest_mm = 1e3F, kFarthest_mm = 1e5F;
  return dab.radius_mm > 0.0F && dab.radius_mm <= kLargest_mm &&
         (dab.center_mm.array().abs() <= kFarthest_mm).all();
}

}  // namespace

EditList difference(const EditList& one, const EditList& other) {
  auto all = std::make_shared<EditSequence>();
  const auto add_missing = [&](const EditSequence& edits, const EditSequence& in) {
    for (const auto& edit : edits) {
      if (std::find(in.begin(), in.end(), edit) == in.end()) all->push_back(edit);
    }
  };
  add_missing(*one, *other);
  add_missing(*other, *one);
  return all;
}

EditStack::EditStack() : states_{std::make_shared<const EditSequence>()} {}

EditStack::EditStack(EditSequence all, std::size_t active_count) : EditStack() {
  for (std::size_t i = 1; i <= all.size(); ++i) {
    states_.push_back(std::make_shared<const EditSequence>(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i)));
  }
  at_ = std::min(active_count, all.size());
}

void EditStack::push(Edit edit) {
  states_.resize(at_ + 1);
  auto next = std::make_shared<EditSequence>(*state());
  next->push_back(std::make_shared<const Edit>(std::move(edit)));
  states_.push_back(std::move(next));
  ++at_;
}

void EditStack::undo() {
  if (can_undo()) --at_;
}

void EditStack::redo() {
  if (can_redo()) ++at_;
}

EditFilter::Stroke::Stroke(std::shared_ptr<const Edit> edit) : edit_(std::move(edit)) {
  std::vector<Vec3f> centers_mm;
  for (const BrushDab& dab : edit_->dabs) {
    box_.extend((dab.center_mm.array() - dab.radius_mm).matrix());
    box_.extend((dab.center_mm.array() + dab.radius_mm).matrix());
    largest_radius_mm_ = std::max(largest_radius_mm_, dab.radius_mm);
    centers_mm.push_back(dab.center_mm);
  }
  constexpr std::size_t kFew = 8;
  if (centers_mm.size() > kFew &&
      std::all_of(edit_->dabs.begin(), edit_->dabs.end(), can_be_painted)) {
    centers_.emplace(centers_mm, largest_radius_mm_);
  }
}

/// Whether a dab that may hold this place passes the test. In the middle of a painted area the
/// nearest one does.
template <typename Test>
bool EditFilter::Stroke::any_dab(const Vec3f& position_mm, const Test& test) const {
  if (!box_.contains(position_mm)) return false;
  const std::vector<BrushDab>& dabs = edit_->dabs;
  if (!centers_) return std::any_of(dabs.begin(), dabs.end(), test);
  const auto nearest = centers_->nearest(position_mm, largest_radius_mm_);
  if (!nearest) return false;
  if (test(dabs[nearest->index])) return true;
  thread_local std::vector<Neighbor> found;
  centers_->within(position_mm, largest_radius_mm_, found);
  return std::any_of(found.begin(), found.end(),
                     [&](const Neighbor& near) { return test(dabs[near.index]); });
}

bool EditFilter::Stroke::touches(const Vec3f& position_mm) const {
  return any_dab(position_mm, [&](const BrushDab& dab) { return holds(dab, position_mm); });
}

bool EditFilter::Stroke::reaches(const Vec3f& position_mm, const Vec3f& normal) const {
  return any_dab(position_mm,
                 [&](const BrushDab& dab) { return editing::reaches(dab, position_mm, normal); });
}

EditFilter::EditFilter(const EditList& edits) : edits_(edits) {
  for (const auto& edit : *edits) strokes_.emplace_back(edit);
}

bool EditFilter::may_remove(const Vec3f& middle_mm, float radius_mm, double seen_at_s) const {
  return std::any_of(strokes_.begin(), strokes_.end(), [&](const Stroke& stroke) {
    const Edit& edit = stroke.edit();
    const bool seen_before = seen_at_s <= edit.made_at_s;
    const bool removes = edit.kind == EditKind::kTrim   ? seen_before
                         : edit.kind == EditKind::kLock ? !seen_before
                                                        : false;
    return removes && stroke.box().squaredExteriorDistance(middle_mm) <= radius_mm * radius_mm;
  });
}

std::vector<double> EditFilter::times() const {
  std::vector<double> times_s;
  for (const auto& edit : *edits_) times_s.push_back(edit->made_at_s);
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

bool EditFilter::touches(const Vec3f& position_mm) const {
  return std::any_of(strokes_.begin(), strokes_.end(),
                     [&](const Stroke& stroke) { return stroke.touches(position_mm); });
}

std::vector<double> EditFilter::times_at(const Vec3f& position_mm) const {
  std::vector<double> times_s;
  for (const Stroke& stroke : strokes_) {
    if (stroke.touches(position_mm)) times_s.push_back(stroke.edit().made_at_s);
  }
  std::sort(times_s.begin(), times_s.end());
  return times_s;
}

bool EditFilter::keeps(const Vec3f& position_mm, const Vec3f& normal, double seen_at_s) const {
  bool kept_by_lock = false, kept_out_by_lock = false;
  for (const Stroke& stroke : strokes_) {
    if (!stroke.reaches(position_mm, normal)) continue;
    const bool seen_before = seen_at_s <= stroke.edit().made_at_s;
    switch (stroke.edit().kind) {
      case EditKind::kTrim:
        if (seen_before && !kept_by_lock) return false;
        break;
      case EditKind::kLock:
        (seen_before ? kept_by_lock : kept_out_by_lock) = true;
        break;
      case EditKind::kUnlock:
        // Points added under the lock were rejected, and stay rejected.
        if (kept_out_by_lock && seen_before) return false;
        kept_by_lock = kept_out_by_lock = false;
        break;
    }
  }
  return !kept_out_by_lock;
}

}  // namespace flytri::editing
