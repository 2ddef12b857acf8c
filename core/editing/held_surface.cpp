#include "core/editing/held_surface.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace flytri::editing {
namespace {

/// Number of edits that applied to a surface and still do.
std::size_t common_count(const EditSequence& edits, const HeldSurface& surface) {
  const std::vector<double>& former_s = surface.edited_at_s;
  std::size_t common = 0;
  while (common < std::min(former_s.size(), edits.size()) &&
         former_s[common] == edits[common]->made_at_s) {
    ++common;
  }
  return common;
}

/// The locks that hold a surface, and all unlocks.
EditList holding(const EditSequence& edits, const HeldSurface& surface, double seen_next_s) {
  const std::size_t common = common_count(edits, surface);
  // If an edit that shaped the surface was undone, later ones were made on another surface.
  const bool is_continued = common == surface.edited_at_s.size();
  auto kept = std::make_shared<EditSequence>();
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const auto& edit = edits[i];
    const bool is_of_surface = i < common || (is_continued && edit->made_at_s < seen_next_s);
    if (edit->kind == EditKind::kUnlock || (edit->kind == EditKind::kLock && is_of_surface)) {
      kept->push_back(edit);
    }
  }
  return kept;
}

/// What was done to a surface since: the later edits, and before them the locks that they found.
EditList since(const EditSequence& edits, const HeldSurface& surface) {
  const std::size_t common = common_count(edits, surface);
  auto later = std::make_shared<EditSequence>();
  for (std::size_t i = 0; i < edits.size(); ++i) {
    if (i >= common) {
      later->push_back(edits[i]);
    } else if (edits[i]->kind != EditKind::kTrim) {
      auto found = std::make_shared<Edit>(*edits[i]);
      found->made_at_s = surface.seen_until_s;
      later->push_back(std::move(found));
    }
  }
  return later;
}

bool has_lock(const EditList& edits) {
  return std::any_of(edits->begin(), edits->end(),
                     [](const auto& edit) { return edit->kind == EditKind::kLock; });
}

}  // namespace

HeldPlaces::HeldPlaces(const EditList& edits, const HeldSurface& surface, double seen_next_s)
    : HeldPlaces(holding(*edits, surface, seen_next_s), since(*edits, surface),
                 surface.seen_until_s) {}

HeldPlaces::HeldPlaces(const EditList& locks, const EditList& later, double seen_until_s)
    : locks_(locks), later_(later), seen_until_s_(seen_until_s), is_empty_(!has_lock(locks)) {}

bool HeldPlaces::holds(const Vec3f& position_mm, const Vec3f& normal) const {
  // A lock keeps out whatever comes after it.
  const bool is_locked =
      !locks_.keeps(position_mm, normal, std::numeric_limits<double>::infinity());
  return is_locked && later_.keeps(position_mm, normal, seen_until_s_);
}

}  // namespace flytri::editing
