/// @file  The whole command line: the program's own options and all subcommands.
#pragma once

#include "app/cli/command.h"

namespace flytri::cli {

/// Makes `app` flytri's command line. Parsing leaves the job of the subcommand in `invocation`,
/// which must outlive `app`.
void set_up_command_line(CLI::App& app, Invocation& invocation);

}  // namespace flytri::cli
