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

  /// Blocks, as far as they may be in the picture, into the bound framebuffer.
  /// @param detail_share  0..1, of each block's surfels; the radii grow to make up for the others
  /// @return how many surfels were drawn
  std::size_t paint(const SplatStore& store, const std::vector<const StoredBlock*>& blocks,
                    const Eye& eye, const SceneOptions& options, double detail_share);
  /// Single surfels, by their numbers in the store's buffer.
  /// @param detail_share  of the picture that they are added to
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

/// How many surfels of a block stand for it: at least one.
[[nodiscard]] std::size_t prefix_length(std::size_t count, double detail_share);

/// How much wider the disks of a prefix are: K of N cover the same area at sqrt(N / K).
[[nodiscard]] double radius_scale(double detail_share);

}  // namespace flytri::ui
