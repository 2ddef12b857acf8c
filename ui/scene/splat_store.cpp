#include "ui/scene/splat_store.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace flytri::ui {
namespace {

/// A surfel in graphics memory: 24 bytes.
struct SplatVertex {
  Vec3f position_mm;
  std::uint32_t normal;
  Eigen::half radius_mm, sigma_mm;
  std::uint32_t color_flags;
};

/// Spare room, as blocks grow a little with each replacement.
constexpr std::size_t kSmallestRange = 64;
constexpr std::size_t kFirstCapacity = 1U << 16U;

std::array<Attribute, 4> splat_attributes() {
  return {{{0, 3, GL_FLOAT, false, offsetof(SplatVertex, position_mm)},
           {1, 4, GL_INT_2_10_10_10_REV, true, offsetof(SplatVertex, normal)},
           {2, 2, GL_HALF_FLOAT, false, offsetof(SplatVertex, radius_mm)},
           {3, 4, GL_UNSIGNED_BYTE, true, offsetof(SplatVertex, color_flags)}}};
}

/// @param tints  near it
SplatVertex vertex_of(const Surfel& surfel, const Tints& tints) {
  unsigned flags = tint_flag(tints, surfel.position_mm, surfel.normal);
  if (surfel.textured) flags |= kTexturedFlag;
  if (surfel.coverage == Coverage::kGood) flags |= kGoodFlag;
  return {surfel.position_mm, packed_normal(surfel.normal), Eigen::half(surfel.radius_mm),
          Eigen::half(surfel.sigma_mm),
          packed_color(surfel.color, static_cast<std::uint8_t>(flags))};
}

Eigen::AlignedBox3f box_of(const SurfelBlock& block) {
  Eigen::AlignedBox3f box;
  for (const Surfel& s : block.surfels) {
    box.extend((s.position_mm.array() - s.radius_mm).matrix());
    box.extend((s.position_mm.array() + s.radius_mm).matrix());
  }
  return box;
}

/// The surfels of a block that differ from its former version, if there was one.
FreshBlock difference(const SurfelBlock* before, const SurfelBlock& now) {
  FreshBlock fresh{now.place, {}, 0};
  const std::size_t known = before != nullptr ? before->surfels.size() : 0;
  for (std::size_t i = 0; i < now.surfels.size(); ++i) {
    if (i < known && before->surfels[i] == now.surfels[i]) continue;
    fresh.surfels.push_back(static_cast<std::uint32_t>(i));
    if (i < known) ++fresh.replaced_count;
  }
  return fresh;
}

}  // namespace

SplatStore::SplatStore()
    : buffer_(Buffer::make(GL_ARRAY_BUFFER, kFirstCapacity * sizeof(SplatVertex))),
      vertices_(VertexArray::make()) {
  allocator_.grow_to(kFirstCapacity);
  vertices_.attach(buffer_, sizeof(SplatVertex), splat_attributes());
}

StoreChanges SplatStore::update(const SurfelModel& model, const Tints& tints) {
  StoreChanges changes;
  drop_missing(model, changes);
  if (!are_same(tints, tints_)) retint(tints, changes);
  for (const auto& block : model) {
    const auto known = blocks_.find(block->place);
    if (known == blocks_.end() || known->second.block != block) store(block, changes);
  }
  const std::size_t before = surfel_count_;
  if (!changes.fresh.empty() || changes.has_lost) sum_up();
  changes.is_another_model = surfel_count_ > 2 * before || (surfel_count_ == 0 && before > 0);
  return changes;
}

void SplatStore::sum_up() {
  surfel_count_ = 0;
  box_mm_.setEmpty();
  radius_mm_ = 0.0F;
  for (const auto& [place, stored] : blocks_) {
    if (stored.block->surfels.empty()) continue;
    surfel_count_ += stored.block->surfels.size();
    box_mm_.extend(stored.box_mm.cast<double>());
    // All surfels of a block are about as large as its first.
    radius_mm_ += stored.block->surfels.front().radius_mm / static_cast<float>(blocks_.size());
  }
}

void SplatStore::drop_missing(const SurfelModel& model, StoreChanges& changes) {
  auto kept = model.begin();
  for (auto known = blocks_.begin(); known != blocks_.end();) {
    while (kept != model.end() && (*kept)->place < known->first) ++kept;
    if (kept != model.end() && (*kept)->place == known->first) {
      ++known;
      continue;
    }
    changes.has_lost |= !known->second.block->surfels.empty();
    allocator_.give_back(known->second.range);
    known = blocks_.erase(known);
  }
}

void SplatStore::retint(const Tints& tints, StoreChanges& changes) {
  const Tints before = std::exchange(tints_, tints);
  for (const auto& [place, stored] : blocks_) {
    if (are_same(within(before, stored.box_mm), within(tints_, stored.box_mm))) continue;
    upload(stored, changes);
    changes.fresh.push_back(difference(nullptr, *stored.block));
  }
}

void SplatStore::store(const std::shared_ptr<const SurfelBlock>& block, StoreChanges& changes) {
  StoredBlock& stored = blocks_[block->place];
  const std::size_t before = stored.block ? stored.block->surfels.size() : 0;
  changes.has_lost |= block->surfels.size() < before;
  FreshBlock fresh = difference(stored.block.get(), *block);
  stored.block = block;
  stored.box_mm = box_of(*block);
  const bool fits = block->surfels.size() <= stored.range.count;
  if (!fits) {
    allocator_.give_back(stored.range);
    stored.range = {};
    stored.range = place_for(std::max(kSmallestRange, block->surfels.size() * 5 / 4));
  }
  // Each piece that is sent costs as much as some ten surfels.
  constexpr std::size_t kPiece = 10;
  if (fits && kPiece * fresh.surfels.size() < block->surfels.size()) {
    upload_some(stored, fresh.surfels, changes);
  } else {
    upload(stored, changes);
  }
  changes.fresh.push_back(std::move(fresh));
}

PlaceRange SplatStore::place_for(std::size_t count) {
  if (const auto range = allocator_.take(count)) return *range;
  const std::size_t capacity = std::max(allocator_.capacity() * 2, allocator_.capacity() + count);
  buffer_ = buffer_.resized(capacity * sizeof(SplatVertex));
  vertices_.attach(buffer_, sizeof(SplatVertex), splat_attributes());
  allocator_.grow_to(capacity);
  return allocator_.take(count).value_or(PlaceRange{});
}

void SplatStore::upload(const StoredBlock& stored, StoreChanges& changes) {
  const Tints tints = within(tints_, stored.box_mm);
  std::vector<SplatVertex> vertices;
  vertices.reserve(stored.block->surfels.size());
  for (const Surfel& s : stored.block->surfels) {
    vertices.push_back(vertex_of(s, tints));
  }
  buffer_.write(stored.range.first * sizeof(SplatVertex), std::as_bytes(std::span(vertices)));
  changes.uploaded_bytes += vertices.size() * sizeof(SplatVertex);
}

void SplatStore::upload_some(const StoredBlock& stored, const std::vector<std::uint32_t>& surfels,
                             StoreChanges& changes) {
  const Tints tints = within(tints_, stored.box_mm);
  for (const std::uint32_t i : surfels) {
    const SplatVertex vertex = vertex_of(stored.block->surfels[i], tints);
    buffer_.write((stored.range.first + i) * sizeof(SplatVertex),
                  std::as_bytes(std::span(&vertex, 1)));
  }
  changes.uploaded_bytes += surfels.size() * sizeof(SplatVertex);
}

}  // namespace flytri::ui
