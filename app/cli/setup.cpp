/// @file  flytri setup: leads from devices that are plugged in to a rig.json.
#include "hw/setup/run_setup.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/output_files.h"
#include "app/cli/prompt.h"
#include "hw/rig/rig_file.h"

namespace flytri::cli {
namespace {

struct SetupArguments {
  std::filesystem::path output = "rig.json";
  std::string name = "rig";
  double rate_hz = 30.0;
  bool force = false;
};

/// Prints answers by number; Enter takes the one suggested.
class SetupDialog final : public setup::SetupTalk {
 public:
  explicit SetupDialog(const Progress& progress) : prompt_(progress) {}

  void tell(const std::string& text) override {
    print_out("{}\n", text);
    std::fflush(stdout);
  }

  std::optional<std::size_t> choose(const std::string& question,
                                    const std::vector<std::string>& answers,
                                    std::size_t suggested) override {
    print_out("\n{}\n", question);
    for (std::size_t i = 0; i < answers.size(); ++i) print_out("  {}  {}\n", i + 1, answers[i]);
    const std::string hint =
        fmt::format("Number, Enter for {}, or q to stop without writing: ", suggested + 1);
    while (const auto line = prompt_.ask(hint)) {
      print_out("\n");
      if (line->empty()) return suggested;
      if (*line == "q") return std::nullopt;
      std::size_t number = 0;
      const char* end = line->data() + line->size();
      const auto read = std::from_chars(line->data(), end, number);
      if (read.ec == std::errc() && read.ptr == end && number >= 1 && number <= answers.size())
        return number - 1;
    }
    print_out("\n");
    return std::nullopt;
  }

 private:
  Prompt prompt_;
};

Result<void> run(const SetupArguments& arguments, const Progress& progress) {
  auto checked = check_output_files({}, {{arguments.output, rig::kRigFormat}}, arguments.force);
  if (!checked) return checked;
  SetupDialog dialog(progress);
  const setup::SetupMachine machine = setup::this_machine();
  const auto rig = setup::run_setup(arguments.name, {machine, dialog, progress, arguments.rate_hz});
  if (!rig) return tl::unexpected(rig.error());
  if (auto written = rig::write_rig(arguments.output, *rig); !written) return written;
  print_out("wrote {}\n", arguments.output.string());
  print_out("Next: flytri calibrate --live -o calibration --rig {}\n", arguments.output.string());
  return {};
}

}  // namespace

void add_setup_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<SetupArguments>();
  CLI::App* command = app.add_subcommand(
      "setup", "Find the cameras and lights of a rig, set and check them, and write rig.json");
  command->add_option("-o,--output", arguments->output, "File to write")->capture_default_str();
  command->add_option("--name", arguments->name, "Name of the rig")->capture_default_str();
  command->add_option("--rate", arguments->rate_hz, "Frame rate to aim for, in Hz")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  add_force_option(*command, arguments->force);
  command->footer("Example: flytri setup -o rig.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress& progress) { return run(*arguments, progress); };
  });
}

}  // namespace flytri::cli
