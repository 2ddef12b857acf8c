#include "app/cli/command_line.h"

#include "app/cli/commands.h"

namespace flytri::cli {

void set_up_command_line(CLI::App& app, Invocation& invocation) {
  app.name("flytri");
  app.description("flytri: makes textured models with a hand-guided dental scanner");
  add_simulate_command(app, invocation);
  add_calibrate_command(app, invocation);
  add_reconstruct_command(app, invocation);
  add_export_command(app, invocation);
  add_occlude_command(app, invocation);
  add_review_command(app, invocation);
  add_report_command(app, invocation);
  add_rescue_command(app, invocation);
  add_journal_command(app, invocation);
  add_evaluate_command(app, invocation);
  add_demo_command(app, invocation);
  add_app_command(app, invocation);
  add_devices_command(app, invocation);
  add_setup_command(app, invocation);
  add_record_command(app, invocation);
  add_design_command(app, invocation);
  add_make_command(app, invocation);
}

}  // namespace flytri::cli
