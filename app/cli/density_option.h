/// @file  The option of all commands that write models: how many triangles.
#pragma once

#include <map>
#include <string>

#include "app/cli/command.h"
#include "core/reconstruct/mesh_density.h"

namespace flytri::cli {

/// Adds --mesh-density. @param density  holds the default
inline void add_density_option(CLI::App& command, reconstruct::MeshDensity& density) {
  std::map<std::string, reconstruct::MeshDensity> names;
  for (const reconstruct::MeshDensity each : reconstruct::kMeshDensities)
    names[std::string(to_string(each))] = each;
  command
      .add_option_function<std::string>(
          "--mesh-density",
          [names, &density](const std::string& name) { density = names.at(name); },
          "full: as meshed; cad: few triangles, at most 0.002 mm RMS and 0.010 mm from the full "
          "surface (or 1 % and 5 % of the spacing of its vertices, if that is more); light: five "
          "times as much. Default: " +
              std::string(to_string(density)))
      ->check(CLI::IsMember({"full", "cad", "light"}));
}

}  // namespace flytri::cli
