/// @file  Where the tests find files: the checkout, and what may lie beside it.
#pragma once

#include <filesystem>

namespace flytri::testing {

/// The checkout's root.
[[nodiscard]] std::filesystem::path source_folder();

/// Real meshes, images and recordings beside the checkout, which a user does not have: a test that
/// needs them skips without.
[[nodiscard]] std::filesystem::path shared_data();

}  // namespace flytri::testing
