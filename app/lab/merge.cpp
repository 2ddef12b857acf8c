/// @file  flytri-lab merge: makes one study of its parts.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "app/cli/output_files.h"
#include "app/lab/studies.h"
#include "core/io/files/file_bytes.h"

namespace flytri::lab {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
  bool force = false;
};

Result<void> run(const MergeArguments& arguments) {
  auto checked = cli::check_output_files({}, {{arguments.output, kStudyFormat}}, arguments.force);
  if (!checked) return checked;
  std::vector<std::string> texts, names;
  for (const std::filesystem::path& part : arguments.parts) {
    auto text = io::read_file(part);
    if (!text) return tl::unexpected(text.error());
    texts.push_back(*std::move(text));
    names.push_back(part.string());
  }
  const auto study = merged(texts, names);
  if (!study) return tl::unexpected(study.error());
  const auto printer = std::find_if(kPrinters.begin(), kPrinters.end(),
                                    [&](const auto& one) { return (*study)["study"] == one.name; });
  if (printer == kPrinters.end()) {
    return fail(ErrorCode::kBadFormat, "{}: is a study \"{}\", which has no parts", names[0],
                (*study)["study"].get<std::string>());
  }
  try {
    printer->print((*study)["records"]);
  } catch (const nlohmann::json::exception&) {
    return fail(ErrorCode::kBadFormat, "a record of {} is incomplete; run its part again",
                fmt::join(names, ", "));
  }
  if (arguments.output.empty()) return {};
  return io::write_file(arguments.output, text_of(*study));
}

}  // namespace

void add_merge_command(CLI::App& lab, cli::Invocation& invocation) {
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command =
      lab.add_subcommand("merge", "Make one study of the files of its parts (--shard)");
  command->add_option("PART", arguments->parts, "Files of all parts, .json")->required();
  command->add_option("-o,--output", arguments->output, "Also write them as one .json");
  cli::add_force_option(*command, arguments->force);
  command->footer("Example: flytri-lab merge part-*.json -o table2.json");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::lab
