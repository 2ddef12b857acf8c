/// @file  Draws stored surfels as elliptical splats.
#pragma once

#include <functional>
#include <vector>

#include "ui/gpu/shader_program.h"
#include "ui/scene/eye.h"
#include "ui/scene/scene_options.h"
#include "ui/scene/splat_store.h"

namespace flytri::ui {

class SplatPainter {
 public:
  /// @errors  those of ShaderProgram::load.
  [[nodiscard]] static Result<SplatPainter> create();

  /// Draws the visible blocks into the bound framebuffer.
  /// @param detail_share  0..1, of the surfels of each block; larger radii fill the gaps
  /// @return how many surfels were drawn
  std::size_t paint(const SplatStore& store, const std::vector<const StoredBlock*>& blocks,
                    const Eye& eye, const SceneOptions& options, double detail_share);
  /// Draws single surfels, by number in the store.
  /// @param detail_share  of the picture to which they are added
  void paint_some(const SplatStore& store, const std::vector<std::uint32_t>& surfels,
                  const Eye& eye, const SceneOptions& options, double detail_share);

 private:
  explicit SplatPainter(ShaderProgram program);
  void begin(const SplatStore& store, const Eye& eye, const SceneOptions& options,
             double detail_share);
  ShaderProgram program_;
  Buffer indices_;
  std::vector<GLint> firsts_;
  std::vector<GLsizei> counts_;
};

/// How many surfels of a block are drawn: at least one.
[[nodiscard]] std::size_t prefix_length(std::size_t count, double detail_share);

/// Factor for the radii if K of N surfels are drawn: sqrt(N / K) covers the same area.
[[nodiscard]] double radius_scale(double detail_share);

}  // namespace flytri::ui
