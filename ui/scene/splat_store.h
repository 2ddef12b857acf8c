/// @file  The surfels of a model in graphics memory; only changed blocks are sent there.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/geometry/surfel.h"
#include "ui/gpu/buffer.h"
#include "ui/scene/range_allocator.h"
#include "ui/scene/vertex_format.h"

namespace flytri::ui {

/// Position of a block's surfels in the buffer, and in the world.
struct StoredBlock {
  std::shared_ptr<const SurfelBlock> block;
  PlaceRange range;  ///< may be longer than the block: room to grow
  Eigen::AlignedBox3f box_mm;
};

/// A block with changed surfels.
struct FreshBlock {
  std::uint64_t place = 0;
  std::vector<std::uint32_t> surfels;  ///< which ones, by rising number in the block
  std::size_t replaced_count = 0;      ///< how many of them replaced others
};

/// The changes that update() found.
struct StoreChanges {
  std::vector<FreshBlock> fresh;
  bool has_lost = false;          ///< some surfels were removed; the old picture still shows them
  bool is_another_model = false;  ///< most of the surfels are new
  std::size_t uploaded_bytes = 0;
};

class SplatStore {
 public:
  SplatStore();
  /// Replaces the model.
  [[nodiscard]] StoreChanges update(const SurfelModel& model, const Tints& tints);

  /// By place.
  [[nodiscard]] const std::map<std::uint64_t, StoredBlock>& blocks() const { return blocks_; }
  [[nodiscard]] std::size_t surfel_count() const { return surfel_count_; }
  [[nodiscard]] const Eigen::AlignedBox3d& box_mm() const { return box_mm_; }
  /// Mean over the blocks; 0 without blocks.
  [[nodiscard]] float radius_mm() const { return radius_mm_; }
  /// Ready to be drawn as points, the surfels of a block from its range's first on.
  void bind() const { vertices_.bind(); }
  /// Ready to be drawn by numbers of surfels.
  void bind_indices(const Buffer& numbers) const { vertices_.attach_indices(numbers); }

 private:
  void store(const std::shared_ptr<const SurfelBlock>& block, StoreChanges& changes);
  void drop_missing(const SurfelModel& model, StoreChanges& changes);
  void retint(const Tints& tints, StoreChanges& changes);
  [[nodiscard]] PlaceRange place_for(std::size_t count);
  void sum_up();
  void upload(const StoredBlock& stored, StoreChanges& changes);
  void upload_some(const StoredBlock& stored, const std::vector<std::uint32_t>& surfels,
                   StoreChanges& changes);

  Buffer buffer_;
  VertexArray vertices_;
  RangeAllocator allocator_;
  std::map<std::uint64_t, StoredBlock> blocks_;
  Tints tints_;
  std::size_t surfel_count_ = 0;
  float radius_mm_ = 0.0F;
  Eigen::AlignedBox3d box_mm_;
};

}  // namespace flytri::ui
