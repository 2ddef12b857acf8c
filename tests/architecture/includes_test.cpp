/// @file  The layers hold: docs/architecture.md names the order, the includes obey it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace flytri {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = testing::source_folder();

/// The folders of core from the table after the marker, bottom first.
std::vector<std::string> core_order() {
  std::ifstream file(kRoot / "docs/architecture.md");
  std::vector<std::string> order;
  const std::regex row("^\\| ([a-z]+) \\|.*");
  bool is_after_marker = false;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (line.find("core-order") != std::string::npos) is_after_marker = true;
    if (line.starts_with("## ")) is_after_marker = false;
    if (is_after_marker && std::regex_match(line, match, row) && match[1] != "folder") {
      order.push_back(match[1]);
    }
  }
  return order;
}

std::vector<std::string> includes_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> includes;
  const std::regex include("^#include [<\"]([^>\"]+)[>\"].*");
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, match, include)) includes.push_back(match[1]);
  }
  return includes;
}

/// Calls `visit(path from the root, include)` for every include below a folder.
template <typename Visitor>
void for_each_include(const std::string& folder, const Visitor& visit) {
  if (!fs::exists(kRoot / folder)) return;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const std::string ending = entry.path().extension();
    if (ending != ".h" && ending != ".cpp") continue;
    const std::string source = fs::relative(entry.path(), kRoot).generic_string();
    for (const std::string& include : includes_of(entry.path())) visit(source, include);
  }
}

/// The second part of core/folder/file.
std::string folder_in_core(const std::string& path) {
  const fs::path parts(path);
  return std::next(parts.begin())->string();
}

TEST(Architecture, CoreIncludesOnlyFoldersAboveItInTheList) {
  const std::vector<std::string> order = core_order();
  ASSERT_GT(order.size(), 10U) << "the table in docs/architecture.md was not found";
  const auto rank = [&](const std::string& folder) {
    const auto at = std::find(order.begin(), order.end(), folder);
    EXPECT_NE(at, order.end()) << "core/" << folder << " is not in docs/architecture.md";
    return at - order.begin();
  };
  int count = 0;
  for_each_include("core", [&](const std::string& source, const std::string& include) {
    if (!include.starts_with("core/")) return;
    ++count;
    EXPECT_LE(rank(folder_in_core(include)), rank(folder_in_core(source)))
        << source << " includes " << include << ", which is below it";
  });
  EXPECT_GT(count, 20) << "no includes were read";
}

TEST(Architecture, CoreKnowsNothingOfTheOutside) {
  const std::regex outside(
      "^(hw|ui|app|assets|tests)/.*|^(GLFW|epoxy|GL|embree[34]|linux|libudev|gpiod|CLI)[/"
      ".].*|^imgui.*");
  for_each_include("core", [&](const std::string& source, const std::string& include) {
    EXPECT_FALSE(std::regex_match(include, outside)) << source << " includes " << include;
  });
}

TEST(Architecture, DevicesAndWindowsDoNotKnowEachOtherNorTheProgram) {
  const auto forbid = [](const std::string& folder, const std::regex& outside) {
    for_each_include(folder, [&](const std::string& source, const std::string& include) {
      EXPECT_FALSE(std::regex_match(include, outside)) << source << " includes " << include;
    });
  };
  forbid("hw", std::regex("^(ui|app|assets|tests)/.*"));
  forbid("ui", std::regex("^(hw|app|tests)/.*"));
}

}  // namespace
}  // namespace flytri
