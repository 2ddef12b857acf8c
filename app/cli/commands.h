/// @file  All commands: one function and one file each.
#pragma once

#include "app/cli/command.h"

namespace flytri::cli {

void add_simulate_command(CLI::App& app, Invocation& invocation);
void add_calibrate_command(CLI::App& app, Invocation& invocation);
void add_reconstruct_command(CLI::App& app, Invocation& invocation);
void add_export_command(CLI::App& app, Invocation& invocation);
void add_occlude_command(CLI::App& app, Invocation& invocation);
void add_review_command(CLI::App& app, Invocation& invocation);
void add_report_command(CLI::App& app, Invocation& invocation);
void add_rescue_command(CLI::App& app, Invocation& invocation);
void add_journal_command(CLI::App& app, Invocation& invocation);
void add_evaluate_command(CLI::App& app, Invocation& invocation);
void add_demo_command(CLI::App& app, Invocation& invocation);
void add_app_command(CLI::App& app, Invocation& invocation);
void add_devices_command(CLI::App& app, Invocation& invocation);
void add_setup_command(CLI::App& app, Invocation& invocation);
void add_record_command(CLI::App& app, Invocation& invocation);
void add_design_command(CLI::App& app, Invocation& invocation);
void add_make_command(CLI::App& app, Invocation& invocation);

}  // namespace flytri::cli
