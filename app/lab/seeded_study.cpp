#include "app/lab/seeded_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/cli/output_files.h"
#include "core/io/files/file_bytes.h"

namespace flytri::lab {
namespace {

using nlohmann::ordered_json;

constexpr int kMostSeeds = 1000, kHighestSeed = 100000;

/// Version 1 had other records.
constexpr int kVersion = 2;

/// "2/10"
Result<Shard> parse_shard(const std::string& text) {
  Shard shard;
  int end = 0;
  const bool is_read = std::sscanf(text.c_str(), "%d/%d%n", &shard.index, &shard.count, &end) == 2;
  if (!is_read || static_cast<std::size_t>(end) != text.size() || shard.count < 1 ||
      shard.index < 1 || shard.index > shard.count) {
    return fail(ErrorCode::kBadOption, "expected PART/PARTS, such as 2/10, with PART from 1");
  }
  return shard;
}

std::vector<int> seeds_of(const SeedArguments& arguments) {
  std::vector<int> seeds;
  for (int i = arguments.shard.index - 1; i < arguments.seed_count; i += arguments.shard.count) {
    seeds.push_back(arguments.first_seed + i);
  }
  return seeds;
}

/// A file of a study, with all that merging reads.
Result<ordered_json> parse_study(const std::string& text, const std::string& name) {
  const auto refuse = [&](const char* what) {
    return fail(ErrorCode::kBadFormat, "{}: {}; give files that flytri-lab wrote with -o", name,
                what);
  };
  ordered_json study = ordered_json::parse(text, nullptr, false);
  if (study.is_discarded() || !study.is_object()) return refuse("is not JSON");
  const auto is = [&](const char* key, auto has_type) {
    return study.contains(key) && has_type(study[key]);
  };
  const auto is_in = [](const ordered_json& value, int low, int high) {
    return value.is_number_integer() && value >= low && value <= high;
  };
  if (!is("format", [](const ordered_json& value) { return value == kStudyFormat; })) {
    return refuse("is not a study");
  }
  if (!is("version", [](const ordered_json& value) { return value == kVersion; })) {
    return refuse("is a study of another version");
  }
  if (!is("study", [](const ordered_json& value) { return value.is_string(); }) ||
      !is("options", [](const ordered_json& value) { return value.is_object(); }) ||
      !is("first_seed", [&](const ordered_json& value) { return is_in(value, 1, kHighestSeed); }) ||
      !is("seed_count", [&](const ordered_json& value) { return is_in(value, 1, kMostSeeds); }) ||
      !is("records", [](const ordered_json& value) { return value.is_array(); })) {
    return refuse("is incomplete");
  }
  const int first = study["first_seed"].get<int>();
  const int last = first + study["seed_count"].get<int>() - 1;
  for (const ordered_json& record : study["records"]) {
    if (!record.is_object() || !record.contains("seed") || !is_in(record["seed"], first, last)) {
      return refuse("has a record without a seed of the study");
    }
  }
  return study;
}

int seed_of(const ordered_json& record) { return record["seed"].get<int>(); }

/// The first key but "records" in which two studies differ; null: none.
const char* difference(const ordered_json& a, const ordered_json& b) {
  for (const char* key : {"study", "options", "first_seed", "seed_count"}) {
    if (a[key] != b[key]) return key;
  }
  return nullptr;
}

/// @param records  sorted by seed
Result<void> check_complete(const ordered_json& study) {
  std::vector<int> missing;
  const int first = study["first_seed"].get<int>(), count = study["seed_count"].get<int>();
  auto record = study["records"].begin();
  for (int seed = first; seed < first + count; ++seed) {
    if (record != study["records"].end() && seed_of(*record) == seed) {
      ++record;
    } else {
      missing.push_back(seed);
    }
  }
  if (missing.empty()) return {};
  return fail(ErrorCode::kInsufficient,
              "no file has seed {}; give the files of all parts, or run the missing ones",
              fmt::join(missing, ", "));
}

}  // namespace

std::string text_of(const ordered_json& study) { return study.dump(1) + "\n"; }

void add_seed_options(CLI::App& command, SeedArguments& arguments, const std::string& count_option,
                      const std::string& what) {
  command.add_option("-o,--output", arguments.output, "Also write the figures as .json");
  cli::add_force_option(command, arguments.force);
  command.add_option(count_option, arguments.seed_count, what)
      ->check(CLI::Range(1, kMostSeeds))
      ->capture_default_str();
  command.add_option("--first", arguments.first_seed, "Number of the first one: its random seed")
      ->check(CLI::Range(1, kHighestSeed))
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--shard",
          [&arguments](const std::string& text) { arguments.shard = *parse_shard(text); },
          "Run only part I of N, given as I/N; flytri-lab merge makes one file of all parts")
      ->check([](const std::string& text) {
        const auto shard = parse_shard(text);
        return shard ? std::string() : shard.error().message;
      });
}

Result<void> run_seeds(const SeededStudy& study, const StudyPrinter& printer,
                       const SeedArguments& arguments) {
  auto checked = cli::check_output_files({}, {{arguments.output, kStudyFormat}}, arguments.force);
  if (!checked) return checked;
  ordered_json records = ordered_json::array();
  for (const int seed : seeds_of(arguments)) {
    const auto measured = study.measure(static_cast<std::uint64_t>(seed));
    if (!measured) return tl::unexpected(measured.error());
    ordered_json record = {{"seed", seed}};
    record.update(*measured);
    records.push_back(std::move(record));
  }
  if (!records.empty()) printer.print(records);
  if (arguments.output.empty()) return {};
  const ordered_json json = {{"format", kStudyFormat},
                             {"version", kVersion},
                             {"study", printer.name},
                             {"options", study.options},
                             {"first_seed", arguments.first_seed},
                             {"seed_count", arguments.seed_count},
                             {"records", std::move(records)}};
  return io::write_file(arguments.output, text_of(json));
}

Result<ordered_json> merged(const std::vector<std::string>& texts,
                            const std::vector<std::string>& names) {
  ordered_json all;
  std::vector<ordered_json> records;
  std::map<int, std::string> file_of;  // by seed
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto part = parse_study(texts[i], names[i]);
    if (!part) return part;
    if (all.is_null()) all = *part;
    if (const char* key = difference(all, *part)) {
      return fail(ErrorCode::kInconsistent,
                  "{}: has another \"{}\" than {}; give parts of one study", names[i], key,
                  names[0]);
    }
    for (ordered_json& record : (*part)["records"]) {
      const auto [other, is_new] = file_of.emplace(seed_of(record), names[i]);
      if (!is_new) {
        return fail(ErrorCode::kInconsistent, "{} and {} both have seed {}; give each part once",
                    other->second, names[i], other->first);
      }
      records.push_back(std::move(record));
    }
  }
  std::sort(records.begin(), records.end(),
            [](const ordered_json& a, const ordered_json& b) { return seed_of(a) < seed_of(b); });
  all["records"] = records;
  if (auto complete = check_complete(all); !complete) return tl::unexpected(complete.error());
  return all;
}

}  // namespace flytri::lab
