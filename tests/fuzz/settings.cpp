/// @file  Any bytes as settings.json: what is read is in range, and written and read again the
/// same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/session/settings_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flytri;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const ui::Settings settings = session::parse_settings(bytes);
  const bool is_in_range = settings.user_scale >= 0.75 && settings.user_scale <= 2.0 &&
                           settings.window_width >= 640 && settings.window_height >= 400;
  if (!is_in_range || session::parse_settings(session::settings_to_json(settings)) != settings)
    std::abort();
  return 0;
}
