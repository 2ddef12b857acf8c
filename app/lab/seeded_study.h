/// @file  A study that measures the same with seeds 1, 2, 3 ..., in one run or in parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command.h"

namespace flytri::lab {

/// The "format" of a study's file.
inline constexpr const char* kStudyFormat = "flytri.study";

/// Part `index` of `count`: every count-th seed, beginning with number `index`.
struct Shard {
  int index = 1;  ///< 1..count
  int count = 1;  ///< >= 1
};

/// What the command line says of any such study.
struct SeedArguments {
  std::filesystem::path output;
  bool force = false;
  int first_seed = 1;
  int seed_count = 10;
  Shard shard;
};

/// What is measured. The figures of a seed depend on the options alone, not on the shard, so that
/// merged parts have the bits of one run.
struct SeededStudy {
  nlohmann::ordered_json options;  ///< all that changes the figures, but the seed
  /// The figures of one seed, an object.
  std::function<Result<nlohmann::ordered_json>(std::uint64_t seed)> measure;
};

/// A study by its name, and how it prints what its records say together.
struct StudyPrinter {
  std::string_view name;
  /// Throws an exception of nlohmann::json where a record lacks a figure.
  /// @param records  by seed, at least one
  void (*print)(const nlohmann::ordered_json& records);
};

/// Adds --output, --force, --shard and the options that number the seeds.
/// @param count_option  name of the option that counts the seeds, such as "--seeds"
/// @param what          the seeds' meaning, such as "Scans, each of another jaw"
void add_seed_options(CLI::App& command, SeedArguments& arguments, const std::string& count_option,
                      const std::string& what);

/// Measures the seeds of the shard, prints and writes their records.
/// @errors  As check_output_files, measure and write_file.
[[nodiscard]] Result<void> run_seeds(const SeededStudy& study, const StudyPrinter& printer,
                                     const SeedArguments& arguments);

/// The study of which these are the parts.
/// @param texts  of the files
/// @param names  of the files, for messages
/// @errors  kBadFormat; kInconsistent: they are of different studies, or two have the same seed;
///          kInsufficient: seeds are missing.
[[nodiscard]] Result<nlohmann::ordered_json> merged(const std::vector<std::string>& texts,
                                                    const std::vector<std::string>& names);

/// The text of a study's file.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& study);

}  // namespace flytri::lab
