/// @file  The command line of flytri: the options of the program and all commands.
#pragma once

#include "app/cli/command.h"

namespace flytri::cli {

/// Adds all commands of flytri to `app`. Parsing puts the job of the chosen command into
/// `invocation`, which must outlive `app`.
void set_up_command_line(CLI::App& app, Invocation& invocation);

}  // namespace flytri::cli
