/// @file  flytri-lab: studies and benchmarks that measure flytri itself.
#include "app/cli/run_program.h"
#include "app/lab/studies.h"

namespace flytri::lab {
namespace {

void set_up_command_line(CLI::App& lab, cli::Invocation& invocation) {
  lab.name("flytri-lab");
  lab.description("flytri-lab: measures flytri itself, on simulated scans with known truth");
  lab.footer("Example: flytri-lab table2 -o table2.json");
  add_table2_study(lab, invocation);
  add_refinement_study(lab, invocation);
  add_tracking_study(lab, invocation);
  add_continuation_study(lab, invocation);
  add_returns_study(lab, invocation);
  add_occlusion_study(lab, invocation);
  add_lengths_study(lab, invocation);
  add_standard_tests_study(lab, invocation);
  add_structure_study(lab, invocation);
  add_merge_command(lab, invocation);
  add_plot_command(lab, invocation);
  add_growth_study(lab, invocation);
  add_synchronization_study(lab, invocation);
  add_live_command(lab, invocation);
  add_tissue_study(lab, invocation);
  add_lines_study(lab, invocation);
  add_enamel_study(lab, invocation);
}

}  // namespace
}  // namespace flytri::lab

int main(int argc, char** argv) {
  return flytri::cli::run_program(argc, argv, flytri::lab::set_up_command_line);
}
