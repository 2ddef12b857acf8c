/// @file  flytri: the scanning window and the command line beside it.
#include "app/cli/command_line.h"
#include "app/cli/run_program.h"

int main(int argc, char** argv) {
  return flytri::cli::run_program(argc, argv, flytri::cli::set_up_command_line, "app");
}
