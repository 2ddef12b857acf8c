#include "app/session/settings_file.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/session/user_folders.h"
#include "core/io/files/file_bytes.h"
#include "core/io/files/leftovers.h"
#include "core/io/models/model_formats.h"

namespace flytri::session {

namespace {

/// Formats that this version does not know are left out.
void read_formats(const nlohmann::json& json, std::set<std::string>& formats) {
  const auto names = json.find("export_formats");
  if (names == json.end() || !names->is_array()) return;
  formats.clear();
  for (const io::ModelFormat& format : io::model_formats()) {
    if (std::find(names->begin(), names->end(), format.extension) != names->end()) {
      formats.emplace(format.extension);
    }
  }
}

/// The usual one if this version does not know it.
reconstruct::MeshDensity density_at(const nlohmann::json& json, reconstruct::MeshDensity usual) {
  const auto name = json.find("mesh_density");
  for (const reconstruct::MeshDensity density : reconstruct::kMeshDensities) {
    if (name != json.end() && *name == to_string(density)) return density;
  }
  return usual;
}

/// Empty if there are no texts in the language.
std::string language_at(const nlohmann::json& json) {
  const auto code = json.find("language");
  const bool is_known =
      code != json.end() && std::any_of(ui::kLanguages.begin(), ui::kLanguages.end(),
                                        [&](const auto& known) { return *code == known.code; });
  return is_known ? code->get<std::string>() : std::string();
}

int size_at(const nlohmann::json& json, const char* key, int usual, int least) {
  constexpr int kMost = 16384;
  const auto size = json.find(key);
  if (size == json.end() || !size->is_number_integer()) return usual;
  return static_cast<int>(std::clamp<std::int64_t>(size->get<std::int64_t>(), least, kMost));
}

}  // namespace

std::filesystem::path settings_path() { return config_folder() / "settings.json"; }

ui::Settings read_settings(const std::filesystem::path& file) {
  return parse_settings(io::read_file(file).value_or(""));
}

ui::Settings parse_settings(std::string_view text) {
  ui::Settings settings;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return settings;
  settings.language = language_at(json);
  if (const auto scale = json.find("user_scale"); scale != json.end() && scale->is_number()) {
    settings.user_scale = std::clamp(scale->get<double>(), 0.75, 2.0);
  }
  if (const auto muted = json.find("is_muted"); muted != json.end() && muted->is_boolean()) {
    settings.is_muted = muted->get<bool>();
  }
  if (const auto dark = json.find("is_dark_without_focus");
      dark != json.end() && dark->is_boolean()) {
    settings.is_dark_without_focus = dark->get<bool>();
  }
  if (const auto full = json.find("is_full_screen"); full != json.end() && full->is_boolean()) {
    settings.is_full_screen = full->get<bool>();
  }
  if (const auto folder = json.find("recording_folder");
      folder != json.end() && folder->is_string()) {
    settings.recording_folder = folder->get<std::string>();
  }
  if (const auto file = json.find("rig_file"); file != json.end() && file->is_string()) {
    settings.rig_file = file->get<std::string>();
  }
  settings.window_width = size_at(json, "window_width", settings.window_width, 640);
  settings.window_height = size_at(json, "window_height", settings.window_height, 400);
  if (const auto width = json.find("close_holes_mm"); width != json.end() && width->is_number()) {
    settings.close_holes_mm = std::clamp(width->get<double>(), 0.0, 10.0);
  }
  if (const auto report = json.find("export_report");
      report != json.end() && report->is_boolean()) {
    settings.export_report = report->get<bool>();
  }
  settings.mesh_density = density_at(json, settings.mesh_density);
  read_formats(json, settings.export_formats);
  return settings;
}

std::string settings_to_json(const ui::Settings& settings) {
  const nlohmann::json json = {{"language", settings.language},
                               {"user_scale", settings.user_scale},
                               {"is_muted", settings.is_muted},
                               {"is_dark_without_focus", settings.is_dark_without_focus},
                               {"is_full_screen", settings.is_full_screen},
                               {"window_width", settings.window_width},
                               {"window_height", settings.window_height},
                               {"export_formats", settings.export_formats},
                               {"export_report", settings.export_report},
                               {"mesh_density", to_string(settings.mesh_density)},
                               {"close_holes_mm", settings.close_holes_mm},
                               {"recording_folder", settings.recording_folder},
                               {"rig_file", settings.rig_file}};
  return json.dump(2) + "\n";
}

Result<void> write_settings(const std::filesystem::path& file, const ui::Settings& settings) {
  if (auto made = io::create_folder(file.parent_path()); !made) return made;
  io::remove_leftovers(file.parent_path());
  return io::write_file(file, settings_to_json(settings));
}

}  // namespace flytri::session
