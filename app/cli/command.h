/// @file  What a subcommand is: it declares its options, and leaves a job to be run after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace flytri::cli {

/// A subcommand's work. It reports to the progress object and stops early when that is cancelled.
using Job = std::function<Result<void>(const Progress&)>;

/// Receives the job of the subcommand that the command line names.
struct Invocation {
  Job job;
};

/// The size limit of --threads; 0 means as many as there are cores.
inline constexpr int kMaxThreads = 256;

/// Adds the option that every computing subcommand has.
inline CLI::Option* add_threads_option(CLI::App& command, int& thread_count) {
  return command.add_option("--threads", thread_count, "Threads to use; 0: one per core")
      ->check(CLI::Range(0, kMaxThreads))
      ->capture_default_str();
}

}  // namespace flytri::cli
