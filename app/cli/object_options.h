/// @file  The options of all commands that scan with the virtual sensor: what it scans.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/session/scanned_object.h"
#include "core/io/models/model_formats.h"

namespace flytri::cli {

/// @return  the options; only one of them can be given
inline std::vector<CLI::Option*> add_object_options(CLI::App& command,
                                                    session::ScannedObject& object) {
  static const std::map<std::string, JawKind> kJaws = {{"upper", JawKind::kUpper},
                                                       {"lower", JawKind::kLower}};
  CLI::Option* mesh = command.add_option(
      "--mesh", object.mesh,
      fmt::format("Model that the virtual sensor scans, in mm ({}). Default: a sample",
                  io::extension_list(io::FormatUse::kRead)));
  CLI::Option* jaw =
      command
          .add_option_function<std::string>(
              "--jaw", [&object](const std::string& name) { object.jaw = kJaws.at(name); },
              "Sample jaw that the virtual sensor scans. Default: upper")
          ->check(CLI::IsMember({"upper", "lower"}))
          ->excludes(mesh);
  return {mesh, jaw};
}

}  // namespace flytri::cli
