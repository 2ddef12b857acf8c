#include "tests/support/places.h"

namespace flytri::testing {

std::filesystem::path source_folder() { return FLYTRI_SOURCE_DIR; }

std::filesystem::path shared_data() { return source_folder() / ".." / "shared" / "data"; }

}  // namespace flytri::testing
