#include "app/cli/command_line.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/cli/commands.h"

namespace flytri::cli {
namespace {

/// CLI11 names what is wrong with arguments, but of a misspelled command only that one is missing.
std::string usage_message(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* named = app;
  while (!named->get_subcommands().empty()) named = named->get_subcommands().front();
  const std::vector<std::string> unknown = named->remaining();
  const bool wants_command = named->get_require_subcommand_min() > 0;
  if (!wants_command || unknown.empty() || unknown.front().starts_with('-')) {
    return CLI::FailureMessage::simple(app, error);
  }
  return fmt::format("There is no command {}\nRun with --help for those there are.\n",
                     unknown.front());
}

}  // namespace

void set_up_command_line(CLI::App& app, Invocation& invocation) {
  app.name("flytri");
  app.description("flytri: from line frames of a hand-guided scanner to a textured model");
  app.require_subcommand(1);
  app.failure_message(usage_message);
  app.set_version_flag("--version", FLYTRI_VERSION);
  add_simulate_command(app, invocation);
  add_calibrate_command(app, invocation);
  add_reconstruct_command(app, invocation);
  add_export_command(app, invocation);
  add_evaluate_command(app, invocation);
  add_study_command(app, invocation);
  add_demo_command(app, invocation);
  add_app_command(app, invocation);
  add_devices_command(app, invocation);
  add_record_command(app, invocation);
  add_bench_command(app, invocation);
}

}  // namespace flytri::cli
