/// @file  flytri journal: lists who opened, computed and exported a case, and when.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/case_access.h"
#include "app/cli/case_argument.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace flytri::cli {
namespace {

struct JournalArguments {
  std::filesystem::path case_path;
  CaseArguments case_options;
  bool as_json = false;
};

std::string stage_of(const io::CaseEvent& event) {
  return event.stage ? std::string(to_string(*event.stage)) : std::string();
}

/// "upper-preop", or "upper-preop of upper" of a copy.
std::string stages_of(const io::CaseEvent& event) {
  return event.from ? fmt::format("{} of {}", stage_of(event), to_string(*event.from))
                    : stage_of(event);
}

void print_as_text(const io::CaseJournal& journal) {
  for (const io::CaseEvent& event : journal.events) {
    print_out("{}  {:<16}  {:<5}  {}@{}  {}\n", event.time, std::string(to_string(event.action)),
              stages_of(event), event.user, event.host, event.program);
    for (const std::string& file : event.files) print_out("                      {}\n", file);
  }
}

void print_as_json(const io::CaseJournal& journal) {
  nlohmann::json events = nlohmann::json::array();
  for (const io::CaseEvent& event : journal.events) {
    events.push_back({{"time", event.time},
                      {"action", to_string(event.action)},
                      {"stage", stage_of(event)},
                      {"files", event.files},
                      {"user", event.user},
                      {"host", event.host},
                      {"program", event.program}});
    if (event.from) events.back()["from"] = to_string(*event.from);
  }
  const nlohmann::json document = {
      {"format", "flytri.journal"}, {"version", 1}, {"events", std::move(events)}};
  write_raw(stdout, document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

Result<void> run(const JournalArguments& arguments) {
  Result<CaseAccess> access = CaseAccess::begin(arguments.case_path, arguments.case_options);
  if (!access) return tl::unexpected(access.error());
  // Who reads the journal alone is not noted: it shows nothing of the patient.
  Result<io::CaseFile> file = access->open(true);
  if (!file) return tl::unexpected(file.error());
  const Result<io::CaseJournal> journal = file->journal();
  if (!journal) return tl::unexpected(journal.error());
  print_damage(journal->damage);
  arguments.as_json ? print_as_json(*journal) : print_as_text(*journal);
  return {};
}

}  // namespace

void add_journal_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<JournalArguments>();
  CLI::App* command =
      app.add_subcommand("journal", "List who opened, computed and exported a case, and when");
  command->add_option("CASE", arguments->case_path, "A case (.flytri)")->required();
  add_passphrase_option(*command, arguments->case_options);
  command->add_flag("--json", arguments->as_json, "Print JSON");
  command->footer("Example: flytri journal smith.flytri");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
