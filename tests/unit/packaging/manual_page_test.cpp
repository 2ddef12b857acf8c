#include "packaging/manual/manual_page.h"

#include <gmock/gmock.h>

#include <string>

#include "app/cli/command_line.h"

namespace flytri::manual {
namespace {

using testing::HasSubstr;

/// What a reader searches for, as the page spells it.
void expect_commands(const std::string& page, const CLI::App& command, const std::string& name) {
  for (const CLI::App* child : command.get_subcommands({})) {
    const std::string child_name = name + " " + child->get_name();
    EXPECT_THAT(page, HasSubstr(".SS " + escaped(child_name) + "\n"));
    for (const CLI::Option* option : child->get_options())
      EXPECT_THAT(page, HasSubstr(escaped(option->get_description()))) << child_name;
    expect_commands(page, *child, child_name);
  }
}

TEST(ManualPage, HoldsEveryCommandAndOptionOfTheProgram) {
  CLI::App program;
  cli::Invocation invocation;
  cli::set_up_command_line(program, invocation);
  const std::string page = manual_page(
      program, {.version = "1.2", .date = "2026-11-21", .purpose = "", .more_sections = ""});
  EXPECT_THAT(page, HasSubstr(".TH flytri 1 2026-11-21 \"flytri 1.2\""));
  expect_commands(page, program, "flytri");
}

TEST(ManualPage, TellsNamesKindsAndExample) {
  CLI::App program("Does it", "prog");
  CLI::App* command = program.add_subcommand("go", "Go somewhere");
  std::string where;
  int steps = 3;
  command->add_option("PLACE", where, "Where to")->required();
  command->add_option("-s,--steps", steps, "How far")->capture_default_str();
  command->footer("Examples: prog go home\n          prog go -s 2 home\n");
  const std::string page = manual_page(program, {});
  EXPECT_THAT(page, HasSubstr("\n\\fBprog go\\fR [\\fIoptions\\fR] \\fIPLACE\\fR\n"));
  EXPECT_THAT(page, HasSubstr(".TP\n\\fB\\-s\\fR, \\fB\\-\\-steps\\fR \\fIINT=3\\fR\nHow far\n"));
  EXPECT_THAT(page,
              HasSubstr("Examples:\n.PP\n.RS 4\n.EX\nprog go home\nprog go \\-s 2 home\n.EE\n"));
}

TEST(ManualPage, TakesTextLiterally) {
  EXPECT_EQ(escaped(".rig.json\n'a' -b\\n ~^`"),
            "\\&.rig.json\n\\&\\(aqa\\(aq \\-b\\en \\(ti\\(ha\\(ga");
}

}  // namespace
}  // namespace flytri::manual
