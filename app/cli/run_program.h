/// @file  Runs a program: parses its command line, runs the job, reports errors.
#pragma once

#include "app/cli/command.h"

namespace flytri::cli {

/// Adds the name and the subcommands of a program.
using SetUpCommandLine = void (*)(CLI::App& program, Invocation& invocation);

/// @param default_command  runs if the command line is empty; null: a command is required
/// @return the exit status: 0 done, 1 failed, 2 wrong usage
[[nodiscard]] int run_program(int argc, char** argv, SetUpCommandLine set_up,
                              const char* default_command = nullptr);

}  // namespace flytri::cli
