/// @file  flytri study: experiments on simulated views, with truth.
#include "app/cli/commands.h"
#include "app/cli/studies.h"

namespace flytri::cli {

void add_study_command(CLI::App& app, Invocation& invocation) {
  CLI::App* study = app.add_subcommand("study", "Repeat an experiment on simulated views");
  study->require_subcommand(1);
  add_table2_study(*study, invocation);
  add_refinement_study(*study, invocation);
  add_tracking_study(*study, invocation);
  add_continuation_study(*study, invocation);
  add_growth_study(*study, invocation);
  add_synchronization_study(*study, invocation);
  study->footer("Example: flytri study table2 -o table2.json");
}

}  // namespace flytri::cli
