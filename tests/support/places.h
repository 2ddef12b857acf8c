/// @file  Folders of test files.
#pragma once

#include <filesystem>

namespace flytri::testing {

/// The root of the source tree.
[[nodiscard]] std::filesystem::path source_folder();

/// Real meshes, images and recordings beside the source tree. Not everybody has them: tests that
/// need them are skipped without them.
[[nodiscard]] std::filesystem::path shared_data();

}  // namespace flytri::testing
