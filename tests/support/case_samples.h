/// @file  Views, frames and edits to be kept in a case, with numbers of every kind, and whether two
/// of them are the same, bit for bit.
#pragma once

#include "core/editing/edits.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"

namespace flytri::testing {

/// A view of `line_count` profiles as a sensor measures them: steps of 25 um along the line, noise
/// of 30 um in depth.
[[nodiscard]] View sample_view(int frame, int line_count = 10, int points_per_line = 450);

/// A color image with noise and a gradient.
[[nodiscard]] Frame sample_texture(int frame, ImageSize size = {64, 48});

/// A pose whose numbers have no short form.
[[nodiscard]] Isometry sample_pose(int number);

/// A stroke of three dabs.
[[nodiscard]] editing::Edit sample_edit(int number);

// Bit for bit: a NaN equals itself, and -0 is not 0.
[[nodiscard]] bool same_bits(const View& a, const View& b);
[[nodiscard]] bool same_bits(const Isometry& a, const Isometry& b);
[[nodiscard]] bool same_bits(const editing::Edit& a, const editing::Edit& b);
[[nodiscard]] bool same_bits(const Frame& a, const Frame& b);

}  // namespace flytri::testing
