/// @file  The manual page of a command line, made from what its --help says.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace flytri::manual {

/// What a manual page says and a command line does not know.
struct PageFacts {
  std::string version;
  std::string date;     ///< of that version, as 2026-11-21
  std::string purpose;  ///< a few words, for the list of all manual pages
  /// Whole sections in the language of man(7), put behind those on the commands.
  std::string more_sections;
};

/// `text` as man(7) takes it for plain: nothing of it is taken for a command or for typography.
[[nodiscard]] std::string escaped(const std::string& text);

/// The page in the language of man(7): name, synopsis, each subcommand with all its options.
[[nodiscard]] std::string manual_page(const CLI::App& program, const PageFacts& facts);

}  // namespace flytri::manual
