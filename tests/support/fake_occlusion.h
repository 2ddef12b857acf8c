/// @file  Two fake jaws that meet, for the states of the finished bite.
#pragma once

#include <memory>

#include "ui/state/app_view.h"

namespace flytri::testing {

/// A jaw and its mirror image, which penetrate each other a little.
/// @param lower  in its own frame
[[nodiscard]] std::shared_ptr<const ui::JawPair> fake_pair(const TriangleMesh& lower);

}  // namespace flytri::testing
