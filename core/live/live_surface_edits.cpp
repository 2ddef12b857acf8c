/// @file  The part of LiveSurface that applies edits.
#include <algorithm>
#include <utility>

#include "core/live/live_surface.h"

namespace flytri::live {
namespace {

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

void LiveSurface::set_edits(const editing::EditStack& edits) {
  const editing::EditFilter other(editing::difference(edits_.all(), edits.all()));
  const editing::EditFilter changed(editing::difference(edits_.state(), edits.state()));
  edits_ = edits;
  filter_ = editing::EditFilter(edits_.state());
  known_edits_ = editing::EditFilter(edits_.all());
  if (!other.empty()) {
    for (std::uint32_t i = 0; i < cells_.size(); ++i) keep_layers_of_cell(i, other);
    for (std::uint32_t i = 0; i < normal_cells_.size(); ++i) keep_layers_of_cube(i, other);
  }
  if (!changed.empty()) {
    apply_edits([&](const Vec3f& center_mm) { return changed.touches(center_mm); });
  }
}

void LiveSurface::settle_edits() {
  apply_edits([](const Vec3f&) { return true; });
}

template <typename Place, typename Content>
void LiveSurface::keep_layers(std::uint32_t index, Place& place, const Content& so_far,
                              const std::vector<double>& times_s,
                              std::vector<Edited<Content>>& all) {
  if (times_s.empty()) return;
  if (place.edited == kNotEdited) {
    place.edited = static_cast<std::uint32_t>(all.size());
    all.push_back({index, TimeLayers<Content>(so_far), {}});
  }
  for (const double time_s : times_s) all[place.edited].layers.split(time_s);
}

void LiveSurface::keep_layers_of_cell(std::uint32_t index, const editing::EditFilter& edits) {
  Cell& cell = cells_[index];
  keep_layers(index, cell, cell.kept, edits.times_at(cell.center_mm), edited_cells_);
}

void LiveSurface::keep_layers_of_cube(std::uint32_t index, const editing::EditFilter& edits) {
  NormalCell& cube = normal_cells_[index];
  keep_layers(index, cube, cube.views, edits.times_at(cube.center_mm), edited_cubes_);
}

/// @param towards  to the sensor: the normal is not known yet
void LiveSurface::begin_edited_cell(std::uint32_t index, const Vec3f& towards) {
  if (known_edits_.empty()) return;
  keep_layers_of_cell(index, known_edits_);
  const std::uint32_t edited = cells_[index].edited;
  if (edited != kNotEdited) apply_to_cell(edited_cells_[edited], towards);
}

/// @param towards  as begin_edited_cell
void LiveSurface::begin_edited_cube(std::uint32_t index, const Vec3f& towards) {
  if (known_edits_.empty()) return;
  keep_layers_of_cube(index, known_edits_);
  const std::uint32_t edited = normal_cells_[index].edited;
  if (edited != kNotEdited) apply_to_cube(edited_cubes_[edited], towards);
}

/// Calls `change` for each layer that the edit removes or brings back.
template <typename Content, typename Change>
void LiveSurface::apply_to_layers(TimeLayers<Content>& layers, const Vec3f& center_mm,
                                  const Vec3f& normal, const Change& change) const {
  for (TimeLayer<Content>& layer : layers) {
    const bool is_kept = filter_.keeps(center_mm, normal, layer.until_s);
    if (is_kept == layer.is_kept) continue;
    layer.is_kept = is_kept;
    change(layer);
  }
}

void LiveSurface::apply_to_cell(Edited<CellSums>& edited, const Vec3f& normal) {
  Cell& cell = cells_[edited.index];
  NormalCell& cube = normal_cells_[cell.normal_cell];
  apply_to_layers(edited.layers, cell.center_mm, normal, [&](const TimeLayer<CellSums>& layer) {
    const CellSums& content = layer.content;
    if (layer.is_kept) {
      cell.kept += content;
      cube.kept += content.directions;
      cube.point_count += content.point_count;
    } else {
      cell.kept -= content;
      cube.kept -= content.directions;
      cube.point_count -= content.point_count;
    }
  });
  if (cell.kept.point_count == 0 && cell.color.observed()) {
    // Surface that is seen here later has a color of its own.
    edited.hidden_color = std::exchange(cell.color, {});
  } else if (cell.kept.point_count > 0 && !cell.color.observed()) {
    cell.color = edited.hidden_color;
  }
}

void LiveSurface::apply_to_cube(Edited<ViewCounts>& edited, const Vec3f& normal) {
  NormalCell& cube = normal_cells_[edited.index];
  apply_to_layers(edited.layers, cube.center_mm, normal, [&](const TimeLayer<ViewCounts>& layer) {
    for (std::size_t pattern = 0; pattern < cube.views.size(); ++pattern) {
      cube.views[pattern] += layer.is_kept ? layer.content[pattern] : -layer.content[pattern];
    }
  });
}

/// The normal by all points, also by those that the edits remove: it does not depend on the edits.
Vec3f LiveSurface::normal_of_all(const NormalCell& cube) const {
  DirectionSums all = cube.kept;
  for (const std::uint32_t index : cube.cells) {
    if (cells_[index].edited == kNotEdited) continue;
    for (const TimeLayer<CellSums>& layer : edited_cells_[cells_[index].edited].layers) {
      if (!layer.is_kept) all += layer.content.directions;
    }
  }
  return normal_of(all);
}

/// Applies the edits in effect to all edited cells and cubes whose centers are concerned.
void LiveSurface::apply_edits(const std::function<bool(const Vec3f& center_mm)>& is_concerned) {
  std::unordered_map<std::uint32_t, Vec3f> normals;  // by cube
  const auto normal_of_cube = [&](std::uint32_t cube) -> const Vec3f& {
    const auto [entry, is_new] = normals.try_emplace(cube);
    if (is_new) entry->second = normal_of_all(normal_cells_[cube]);
    return entry->second;
  };
  for (Edited<CellSums>& edited : edited_cells_) {
    const Cell& cell = cells_[edited.index];
    if (is_concerned(cell.center_mm)) apply_to_cell(edited, normal_of_cube(cell.normal_cell));
  }
  for (Edited<ViewCounts>& edited : edited_cubes_) {
    if (!is_concerned(normal_cells_[edited.index].center_mm)) continue;
    apply_to_cube(edited, normal_of_cube(edited.index));
  }
  std::vector<std::uint32_t> cubes;
  cubes.reserve(normals.size());
  for (const auto& [cube, normal] : normals) cubes.push_back(cube);
  sort_unique(cubes);
  refresh_around(cubes);
}

/// Brings the surfels of these cubes and of those around up to date.
void LiveSurface::refresh_around(const std::vector<std::uint32_t>& cubes) {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t index : cubes) {
    NormalCell& cube = normal_cells_[index];
    // Without points it has no say in the normals around.
    cube.normal = cube.point_count > 0 ? normal_of(cube.kept) : Vec3f(Vec3f::Zero());
    cube.refreshed_at = cube.views[0] + cube.views[1];
    count_around(cube);
    for_each_around(cube.center_mm, [&](const NormalCell& near) {
      around.push_back(static_cast<std::uint32_t>(&near - normal_cells_.data()));
    });
  }
  sort_unique(around);
  for (const std::uint32_t index : around) {
    for (const std::uint32_t cell : normal_cells_[index].cells) {
      cells_[cell].touched = false;
      cells_[cell].normal_of_views = kNormalIsOld;
      show(cell, surfel_of(cell));
    }
  }
  touched_cells_.clear();
}

}  // namespace flytri::live
