/// @file  flytri_manual VERSION DATE SECTIONS: prints the manual page of flytri, to be run when the
/// package is built. SECTIONS is a file of further sections.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "app/cli/command_line.h"
#include "packaging/manual/manual_page.h"

namespace {

int print_page(const char* version, const char* date, const char* sections) {
  std::ifstream file(sections, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "flytri_manual: %s cannot be read\n", sections);
    return 1;
  }
  CLI::App program;
  flytri::cli::Invocation invocation;
  flytri::cli::set_up_command_line(program, invocation);
  const flytri::manual::PageFacts facts = {
      .version = version,
      .date = date,
      .purpose = "hand-guided 3D scanner for dentistry",
      .more_sections = std::string(std::istreambuf_iterator<char>(file), {})};
  const std::string page = flytri::manual::manual_page(program, facts);
  if (std::fputs(page.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return 0;
  std::fputs("flytri_manual: the page cannot be written\n", stderr);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: flytri_manual VERSION DATE SECTIONS\n", stderr);
    return 2;
  }
  try {
    return print_page(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flytri_manual: %s\n", error.what());
    return 1;
  }
}
