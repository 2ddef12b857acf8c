#include "app/cli/run_program.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/progress_bar.h"

namespace flytri::cli {
namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

/// CLI11 says only that a command is missing; this names the one that was misspelled.
std::string usage_message(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* named = app;
  while (!named->get_subcommands().empty()) named = named->get_subcommands().front();
  const std::vector<std::string> unknown = named->remaining();
  const bool wants_command = named->get_require_subcommand_min() > 0;
  if (!wants_command || unknown.empty() || unknown.front().starts_with('-')) {
    return CLI::FailureMessage::simple(app, error);
  }
  return fmt::format("There is no command {}\nRun with --help to list the commands.\n",
                     unknown.front());
}

/// The help of a command, with its usage as a paragraph of its own and each line indented.
std::string indented_help(const CLI::App& command, const std::string& parent_name) {
  std::istringstream lines(command.help(parent_name));
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Usage:")) result += "\n";
    result += line.empty() ? "\n" : "  " + line + "\n";
  }
  return result;
}

/// Prints the help of every command below `parent`, each under its full name. The form is one that
/// help2man understands: the manual pages are made from it.
void print_help_of_commands(CLI::App& parent, const std::string& parent_name) {
  for (CLI::App* command : parent.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = parent_name + " " + command->get_name();
    if (command->get_subcommands([](const CLI::App*) { return true; }).empty()) {
      // All have --help; it is enough to say so once.
      command->set_help_flag();
      write_raw(stdout, fmt::format("\n{}:\n{}", name, indented_help(*command, parent_name)));
    } else {
      print_help_of_commands(*command, name);
    }
  }
}

int run(const CLI::App& program, const Job& job) {
  const Progress progress;
  const Result<void> result = [&] {
    const ProgressBar bar(progress);
    return job(progress);
  }();
  if (result) return kDone;
  print_error("{}: {}\n", program.get_name(), result.error().message);
  return kFailed;
}

/// A result that nobody could read is a failure.
int finished(int code) {
  const Result<void> printed = finish_output();
  if (printed) return code;
  print_error("flytri: {}\n", printed.error().message);
  return code == kDone ? kFailed : code;
}

int parse_and_run(int argc, char** argv, SetUpCommandLine set_up, const char* default_command) {
  CLI::App program;
  Invocation invocation;
  program.require_subcommand(1);
  program.failure_message(usage_message);
  program.set_version_flag("--version", FLYTRI_VERSION);
  set_up(program, invocation);
  // Last, so that no command inherits the flag.
  program.set_help_all_flag("--help-all", "Print the help of every command and exit");
  try {
    if (argc > 1 || default_command == nullptr) {
      program.parse(argc, argv);
    } else {
      program.parse(default_command);
    }
  } catch (const CLI::CallForAllHelp&) {
    write_raw(stdout, program.help());
    print_help_of_commands(program, program.get_name());
    return kDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kUsage;
  }
  return run(program, invocation.job);
}

/// Whether the processor has the instructions that the program was built for.
bool processor_is_new_enough() {
#ifdef __AVX2__
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return true;
#endif
}

}  // namespace

int run_program(int argc, char** argv, SetUpCommandLine set_up, const char* default_command) {
  if (!processor_is_new_enough()) {
    std::fputs(
        "flytri: this processor lacks AVX2. Build for it with: cmake --preset release "
        "-DFLYTRI_MARCH=x86-64\n",
        stderr);
    return kFailed;
  }
  try {
    // A limit on the size of files then fails the write, as a full disk does.
    std::signal(SIGXFSZ, SIG_IGN);
    return finished(parse_and_run(argc, argv, set_up, default_command));
  } catch (const std::exception& error) {
    // Memory is exhausted, or the program has a defect.
    print_error("flytri: internal error: {}\n", error.what());
    return kFailed;
  }
}

}  // namespace flytri::cli
