/// @file  What a command is: it declares its options, and a job that runs after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace flytri::cli {

/// The work of a command. It reports its progress, and stops early when that is cancelled.
using Job = std::function<Result<void>(const Progress&)>;

/// Receives the job of the chosen command.
struct Invocation {
  Job job;
};

/// The largest value of --threads.
inline constexpr int kMaxThreads = 256;

/// Adds --threads, which all commands that compute have.
inline CLI::Option* add_threads_option(CLI::App& command, int& thread_count) {
  return command.add_option("--threads", thread_count, "Threads to use; 0: one per core")
      ->check(CLI::Range(0, kMaxThreads))
      ->capture_default_str();
}

}  // namespace flytri::cli
