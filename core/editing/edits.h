/// @file  What the user cut away from the surface or locked: strokes of a brush, and their undo.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/rigid.h"

namespace flytri::editing {

/// One touch of the brush: a ball on the surface. It reaches what faces the user alone: samples
/// whose normal is within 90 degrees of its own.
struct BrushDab {
  Vec3f center_mm = Vec3f::Zero();  ///< world frame
  Vec3f normal = Vec3f::UnitZ();    ///< unit, outwards
  float radius_mm = 0.0F;           ///< > 0
};

enum class EditKind {
  kTrim,   ///< takes away what was seen before the edit; what is seen later grows anew
  kLock,   ///< what was seen before the edit is not trimmed; what is seen later is not added
  kUnlock  ///< ends the locks made before, where it reaches
};

/// One stroke.
struct Edit {
  EditKind kind = EditKind::kTrim;
  double made_at_s = 0.0;  ///< time of the scan: frames up to it came before the edit
  std::vector<BrushDab> dabs;
};

/// Edits by rising made_at_s. Immutable: each state of the stack is a list of its own.
using EditSequence = std::vector<std::shared_ptr<const Edit>>;
using EditList = std::shared_ptr<const EditSequence>;

/// All states that the user can go back and forth between.
class EditStack {
 public:
  EditStack();
  /// The stack as it was: all edits that were not forgotten, of which the first `held` hold.
  EditStack(EditSequence all, std::size_t held);

  /// The new state; what was undone is forgotten.
  void push(Edit edit);
  /// Nothing happens where there is nothing to undo or redo.
  void undo();
  void redo();
  [[nodiscard]] bool can_undo() const { return at_ > 0; }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < states_.size(); }
  [[nodiscard]] const EditList& state() const { return states_[at_]; }
  /// What holds, and behind it what can be redone.
  [[nodiscard]] const EditList& all() const { return states_.back(); }

 private:
  std::vector<EditList> states_;
  std::size_t at_ = 0;
};

/// Tells fast whether a sample survives a state of edits.
class EditFilter {
 public:
  explicit EditFilter(const EditList& edits);
  [[nodiscard]] bool empty() const { return edits_->empty(); }
  /// @param seen_at_s  time of the frame that measured the sample
  [[nodiscard]] bool keeps(const Vec3f& position_mm, const Vec3f& normal, double seen_at_s) const;

 private:
  /// A stroke with the box around all it reaches.
  struct Stroke {
    std::shared_ptr<const Edit> edit;
    Eigen::AlignedBox3f box;
  };
  EditList edits_;
  std::vector<Stroke> strokes_;
};

}  // namespace flytri::editing
