/// @file  The program's entry: parses the command line, runs what it names, reports how it ended.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "app/cli/command_line.h"
#include "app/cli/progress_bar.h"

namespace flytri::cli {
namespace {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2 };

int run(const Job& job) {
  const Progress progress;
  const Result<void> result = [&] {
    const ProgressBar bar(progress);
    return job(progress);
  }();
  if (result) return kDone;
  fmt::print(stderr, "flytri: {}\n", result.error().message);
  return kFailed;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app;
  Invocation invocation;
  set_up_command_line(app, invocation);
  try {
    // Who starts the program without a word wants to scan.
    argc > 1 ? app.parse(argc, argv) : app.parse("app");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  return run(invocation.job);
}

/// False on a processor older than the instruction set that the program was built for.
bool processor_is_new_enough() {
#ifdef __AVX2__
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return true;
#endif
}

}  // namespace
}  // namespace flytri::cli

int main(int argc, char** argv) {
  if (!flytri::cli::processor_is_new_enough()) {
    std::fputs(
        "flytri: this processor lacks AVX2; build for it with cmake --preset release "
        "-DFLYTRI_MARCH=x86-64\n",
        stderr);
    return flytri::cli::kFailed;
  }
  try {
    return flytri::cli::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    // Not to be expected: memory exhausted, or a defect of the program.
    fmt::print(stderr, "flytri: internal error: {}\n", error.what());
    return flytri::cli::kFailed;
  }
}
