#include "packaging/manual/manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace flytri::manual {
namespace {

std::string escape_of(char character) {
  switch (character) {
    case '\\':
      return "\\e";
    case '-':
      return "\\-";
    case '\'':
      return "\\(aq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return {character};
  }
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

/// All names of an option as a user types them, or that of a positional argument.
std::string names_of(const CLI::Option& option) {
  if (option.get_positional()) return italic(option.get_single_name());
  std::string names;
  for (const std::string& name : option.get_snames()) names += bold("-" + name) + ", ";
  for (const std::string& name : option.get_lnames()) names += bold("--" + name) + ", ";
  if (!names.empty()) names.resize(names.size() - 2);
  return names;
}

std::string entry_of(const CLI::Option& option) {
  // " TEXT:{a,b}=a REQUIRED", as in the help.
  std::string kind = CLI::Formatter().make_option_opts(&option);
  if (!kind.empty()) kind = " " + italic(kind.substr(1));
  return fmt::format(".TP\n{}{}\n{}\n", names_of(option), kind, escaped(option.get_description()));
}

std::vector<const CLI::Option*> own_options(const CLI::App& command) {
  return command.get_options([&command](const CLI::Option* option) {
    // Every command has --help; it is told once.
    return option != command.get_help_ptr() && !option->get_group().empty();
  });
}

std::string synopsis_of(const CLI::App& command, const std::string& name) {
  std::string line = bold(name);
  bool has_options = false;
  std::string rest;
  for (const CLI::Option* option : own_options(command)) {
    if (option->get_positional())
      rest += " " + italic(option->get_single_name());
    else
      has_options = true;
  }
  if (has_options) line += " [" + italic("options") + "]";
  return line + rest;
}

/// Footers are "Example: COMMAND" or "Examples: COMMAND", with further commands on lines of their
/// own.
std::string example_of(const CLI::App& command) {
  const std::string footer = command.get_footer();
  const std::size_t colon = footer.find(": ");
  if (colon == std::string::npos) return {};
  std::string commands;
  std::istringstream lines(footer.substr(colon + 1));
  for (std::string line; std::getline(lines, line);)
    commands += escaped(line.substr(std::min(line.find_first_not_of(' '), line.size()))) + "\n";
  return fmt::format(".PP\n{}:\n.PP\n.RS 4\n.EX\n{}.EE\n.RE\n", escaped(footer.substr(0, colon)),
                     commands);
}

std::string section_of(const CLI::App& command, const std::string& name) {
  std::string section =
      fmt::format(".SS {}\n{}.\n", escaped(name), escaped(command.get_description()));
  const auto options = own_options(command);
  if (!options.empty()) section += fmt::format(".PP\n{}\n", synopsis_of(command, name));
  for (const CLI::Option* option : options) section += entry_of(*option);
  return section + example_of(command);
}

void add_sections(std::string& page, const CLI::App& command, const std::string& name) {
  for (const CLI::App* child : command.get_subcommands({})) {
    const std::string child_name = name + " " + child->get_name();
    page += section_of(*child, child_name);
    add_sections(page, *child, child_name);
  }
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  bool starts_line = true;
  for (const char character : text) {
    if (starts_line && (character == '.' || character == '\'')) result += "\\&";
    result += escape_of(character);
    starts_line = character == '\n';
  }
  return result;
}

std::string manual_page(const CLI::App& program, const PageFacts& facts) {
  const std::string& name = program.get_name();
  std::string page = fmt::format(".TH {} 1 {} \"{} {}\" \"User Commands\"\n", escaped(name),
                                 facts.date, escaped(name), escaped(facts.version));
  page += fmt::format(".SH NAME\n{} \\- {}\n", escaped(name), escaped(facts.purpose));
  page += fmt::format(".SH SYNOPSIS\n.B {}\n[{} [{}]]\n", escaped(name), italic("command"),
                      italic("options"));
  page += fmt::format(".SH DESCRIPTION\n{}.\n", escaped(program.get_description()));
  page += ".SH OPTIONS\n" + entry_of(*program.get_help_ptr());
  page += ".PP\nEvery command has this option, too.\n";
  for (const CLI::Option* option : own_options(program)) page += entry_of(*option);
  page += ".SH COMMANDS\n";
  add_sections(page, program, name);
  return page + facts.more_sections;
}

}  // namespace flytri::manual
