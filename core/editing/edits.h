/// @file  Brush strokes that trim or lock the surface, with undo and redo.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/point_grid.h"
#include "core/geometry/rigid.h"

namespace flytri::editing {

/// One touch of the brush: a ball on the surface. It reaches only samples that face the user: their
/// normals are within 90 degrees of the dab's normal.
struct BrushDab {
  Vec3f center_mm = Vec3f::Zero();  ///< world frame
  Vec3f normal = Vec3f::UnitZ();    ///< unit, outwards
  float radius_mm = 0.0F;           ///< > 0
};

enum class EditKind {
  kTrim,   ///< removes what was seen before the edit; surface seen later is added again
  kLock,   ///< protects what was seen before the edit from trimming; surface seen later is not
           ///< added
  kUnlock  ///< ends earlier locks where it reaches
};

/// One stroke.
struct Edit {
  EditKind kind = EditKind::kTrim;
  double made_at_s = 0.0;  ///< scan time; frames up to this time came before the edit
  std::vector<BrushDab> dabs;
};

/// Edits by rising made_at_s. Immutable: each state of the stack has its own list.
using EditSequence = std::vector<std::shared_ptr<const Edit>>;
using EditList = std::shared_ptr<const EditSequence>;

/// The edits that only one of the two lists has.
[[nodiscard]] EditList difference(const EditList& one, const EditList& other);

/// The undo and redo history of edits.
class EditStack {
 public:
  EditStack();
  /// Restores a stack. `all` holds the edits; the first `active_count` of them are in effect, the
  /// others can be redone.
  EditStack(EditSequence all, std::size_t active_count);

  /// Adds an edit. Undone edits are discarded.
  void push(Edit edit);
  /// Does nothing if there is nothing to undo or redo.
  void undo();
  void redo();
  [[nodiscard]] bool can_undo() const { return at_ > 0; }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < states_.size(); }
  [[nodiscard]] const EditList& state() const { return states_[at_]; }
  /// The edits in effect, followed by those that can be redone.
  [[nodiscard]] const EditList& all() const { return states_.back(); }

 private:
  std::vector<EditList> states_;
  std::size_t at_ = 0;
};

/// The rule of all edits: decides quickly whether a sample still counts. A sample that is not kept
/// serves nothing: no pose, no color, no model.
class EditFilter {
 public:
  explicit EditFilter(const EditList& edits);
  [[nodiscard]] bool empty() const { return edits_->empty(); }
  /// @param seen_at_s  time of the frame that measured the sample
  [[nodiscard]] bool keeps(const Vec3f& position_mm, const Vec3f& normal, double seen_at_s) const;
  /// False if all samples in this ball that were seen at this time are kept, whatever their
  /// normals.
  [[nodiscard]] bool may_remove(const Vec3f& middle_mm, float radius_mm, double seen_at_s) const;
  /// Times of the edits, rising, each once. What was seen between two of them was seen as one.
  [[nodiscard]] std::vector<double> times() const;
  /// Whether a dab of an edit holds this place, whatever its normal.
  [[nodiscard]] bool touches(const Vec3f& position_mm) const;
  /// Times of the edits that touch this place, by rising time. All samples of the place that were
  /// seen after one of them and up to the next are kept or removed together.
  [[nodiscard]] std::vector<double> times_at(const Vec3f& position_mm) const;

 private:
  /// A stroke, prepared for many questions.
  class Stroke {
   public:
    explicit Stroke(std::shared_ptr<const Edit> edit);
    [[nodiscard]] const Edit& edit() const { return *edit_; }
    [[nodiscard]] const Eigen::AlignedBox3f& box() const { return box_; }
    [[nodiscard]] bool touches(const Vec3f& position_mm) const;
    [[nodiscard]] bool reaches(const Vec3f& position_mm, const Vec3f& normal) const;

   private:
    template <typename Test>
    [[nodiscard]] bool any_dab(const Vec3f& position_mm, const Test& test) const;

    std::shared_ptr<const Edit> edit_;
    Eigen::AlignedBox3f box_;
    float largest_radius_mm_ = 0.0F;
    std::optional<PointGrid> centers_;  ///< of its dabs; none: there are only a few
  };
  EditList edits_;
  std::vector<Stroke> strokes_;
};

}  // namespace flytri::editing
