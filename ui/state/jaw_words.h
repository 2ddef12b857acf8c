/// @file  What a dentist calls the places and sides of the jaw that is scanned.
#pragma once

#include <string>

#include "core/geometry/jaw_axes.h"
#include "core/io/cases/case_file.h"
#include "core/meshing/surface_mesh.h"
#include "ui/text/texts.h"

namespace flytri::ui {

/// The bite is scanned from the side, and shown as a lower jaw.
[[nodiscard]] JawKind jaw_of(io::ScanStage stage);

/// "Upper jaw", "Bite, other side".
[[nodiscard]] Text stage_name(io::ScanStage stage);

/// "Lingual", or "Palatal" of an upper jaw.
[[nodiscard]] Text lingual_name(JawKind jaw);

/// "4.4 mm, right molars, buccal". Without an arch, left and right are not known: "4.4 mm, buccal".
/// @param jaw_axes  null: only the width is known
[[nodiscard]] std::string hole_text(const meshing::BoundaryLoop& hole, const JawAxes* jaw_axes,
                                    JawKind jaw, const Texts& texts);

}  // namespace flytri::ui
