#include "ui/window/draw_damage.h"

#include <bit>
#include <cmath>
#include <optional>

#include "ui/imgui/releases.h"

namespace flytri::ui {
namespace {

constexpr int kTile_px = 32;
/// Each box needs a pass over all triangles, so there are few.
constexpr std::size_t kMostBoxes = 4;

/// Tiles from..to, `to` excluded.
struct TileBox {
  int left = 0, top = 0, right = 0, bottom = 0;

  [[nodiscard]] int area() const { return (right - left) * (bottom - top); }
  [[nodiscard]] TileBox merged(const TileBox& other) const {
    return {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
            std::max(bottom, other.bottom)};
  }
};

std::uint64_t mixed(std::uint64_t print, std::uint64_t value) {
  // The multiplier of Fowler, Noll and Vo; the rotation brings high bits down.
  return std::rotl((print ^ value) * 0x100000001b3ULL, 23);
}

std::uint64_t pair_of(float a, float b) {
  return (std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32U) | std::bit_cast<std::uint32_t>(b);
}

std::uint64_t print_of(std::uint64_t print, const ImDrawVert& vertex) {
  print = mixed(print, pair_of(vertex.pos.x, vertex.pos.y));
  return mixed(mixed(print, pair_of(vertex.uv.x, vertex.uv.y)), vertex.col);
}

/// The tiles that a rectangle covers.
TileBox tiles_of(const Rect& rect, int columns, int rows) {
  const auto tile = [](float px, int count) { return std::clamp(static_cast<int>(px), 0, count); };
  return {tile(std::floor(rect.x / kTile_px), columns), tile(std::floor(rect.y / kTile_px), rows),
          tile(std::ceil(rect.right() / kTile_px), columns),
          tile(std::ceil(rect.bottom() / kTile_px), rows)};
}

/// A fingerprint for each tile of the window.
class TilePrints {
 public:
  TilePrints(int columns, int rows)
      : columns_(columns), rows_(rows), prints_(static_cast<std::size_t>(columns) * rows) {}

  void add(const ImDrawList& list) {
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback == nullptr) add(list, command);
    }
  }
  [[nodiscard]] std::vector<std::uint64_t> take() && { return std::move(prints_); }

 private:
  void add(const ImDrawList& list, const ImDrawCmd& command) {
    const std::uint64_t style =
        mixed(mixed(texture_number(command), pair_of(command.ClipRect.x, command.ClipRect.y)),
              pair_of(command.ClipRect.z, command.ClipRect.w));
    const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      add(vertices[index[i]], vertices[index[i + 1]], vertices[index[i + 2]], command.ClipRect,
          style);
    }
  }

  void add(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, const ImVec4& clip,
           std::uint64_t style) {
    const float left = std::max(std::min({a.pos.x, b.pos.x, c.pos.x}), clip.x);
    const float right = std::min(std::max({a.pos.x, b.pos.x, c.pos.x}), clip.z);
    const float top = std::max(std::min({a.pos.y, b.pos.y, c.pos.y}), clip.y);
    const float bottom = std::min(std::max({a.pos.y, b.pos.y, c.pos.y}), clip.w);
    if (!(left <= right && top <= bottom)) return;
    const std::uint64_t print = print_of(print_of(print_of(style, a), b), c);
    const TileBox tiles = tiles_of({left, top, right - left, bottom - top}, columns_, rows_);
    for (int row = tiles.top; row < tiles.bottom; ++row) {
      for (int column = tiles.left; column < tiles.right; ++column) {
        auto& sum = prints_[static_cast<std::size_t>(row) * columns_ + column];
        sum = mixed(sum, print);
      }
    }
  }

  int columns_, rows_;
  std::vector<std::uint64_t> prints_;
};

/// Boxes of consecutive different tiles in a row; equal ones in the row above are extended.
void add_row(const std::vector<bool>& is_different, int row, std::vector<TileBox>& boxes) {
  const int columns = static_cast<int>(is_different.size());
  for (int left = 0; left < columns; ++left) {
    if (!is_different[static_cast<std::size_t>(left)]) continue;
    int right = left + 1;
    while (right < columns && is_different[static_cast<std::size_t>(right)]) ++right;
    const auto above = std::find_if(boxes.begin(), boxes.end(), [&](const TileBox& box) {
      return box.bottom == row && box.left == left && box.right == right;
    });
    if (above != boxes.end()) {
      above->bottom = row + 1;
    } else {
      boxes.push_back({left, row, right, row + 1});
    }
    left = right;
  }
}

/// Merges the two boxes whose union grows least.
void merge_two(std::vector<TileBox>& boxes) {
  std::size_t first = 0, second = 1;
  std::optional<int> least;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const int growth = boxes[i].merged(boxes[j]).area() - boxes[i].area() - boxes[j].area();
      if (least && growth >= *least) continue;
      least = growth;
      first = i;
      second = j;
    }
  }
  boxes[first] = boxes[first].merged(boxes[second]);
  boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(second));
}

}  // namespace

std::vector<Rect> DrawDamage::update(const ImDrawData& data, const std::vector<Rect>& repainted) {
  const int columns = (static_cast<int>(data.DisplaySize.x) + kTile_px - 1) / kTile_px;
  const int rows = (static_cast<int>(data.DisplaySize.y) + kTile_px - 1) / kTile_px;
  TilePrints prints(columns, rows);
  for (int i = 0; i < data.CmdListsCount; ++i) prints.add(*data.CmdLists[i]);
  const std::vector<std::uint64_t> before = std::exchange(prints_, std::move(prints).take());
  const bool is_known = columns_ == columns && rows_ == rows && before.size() == prints_.size();
  columns_ = columns;
  rows_ = rows;
  std::vector<bool> is_different(prints_.size(), !is_known);
  for (std::size_t i = 0; is_known && i < prints_.size(); ++i) {
    is_different[i] = before[i] != prints_[i];
  }
  for (const Rect& rect : repainted) {
    const TileBox box = tiles_of(rect, columns, rows);
    for (int row = box.top; row < box.bottom; ++row) {
      for (int column = box.left; column < box.right; ++column) {
        is_different[static_cast<std::size_t>(row) * columns + column] = true;
      }
    }
  }
  std::vector<TileBox> boxes;
  for (int row = 0; row < rows; ++row) {
    const auto begin = is_different.begin() + static_cast<std::ptrdiff_t>(row) * columns;
    add_row(std::vector<bool>(begin, begin + columns), row, boxes);
  }
  while (boxes.size() > kMostBoxes) merge_two(boxes);
  std::vector<Rect> rects;
  for (const TileBox& box : boxes) {
    const float x = static_cast<float>(box.left * kTile_px);
    const float y = static_cast<float>(box.top * kTile_px);
    rects.push_back({x, y,
                     std::min(static_cast<float>(box.right * kTile_px), data.DisplaySize.x) - x,
                     std::min(static_cast<float>(box.bottom * kTile_px), data.DisplaySize.y) - y});
  }
  return rects;
}

}  // namespace flytri::ui
