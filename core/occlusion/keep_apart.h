/// @file  Teeth are hard: moves the lower jaw out of the upper one, as far as its uncertainty
/// allows.
#pragma once

#include "core/base/workers.h"
#include "core/occlusion/jaw_surface.h"
#include "core/occlusion/occlude.h"

namespace flytri::occlusion {

/// The likeliest relation of the jaws, given that found from the bite scans, its covariance, and
/// that no tooth is inside another one by more than the noise of the surfaces. Where the jaws
/// penetrate by more than the uncertainty explains, something else is wrong, and nothing is
/// changed.
/// @return  how far that moved a touching tooth at most, mm
double keep_apart(const JawSurface& upper, const TriangleMesh& lower, const Workers& workers,
                  Occlusion& found);

}  // namespace flytri::occlusion
