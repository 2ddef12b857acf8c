/// @file  Checks what the compiler cannot: which libraries a layer uses, that each folder is
/// described, that the files named in documents exist, that no two classes have the same name.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace flytri {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = testing::source_folder();
constexpr std::array kLayers = {"core", "hw", "ui", "app", "assets"};

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// The first group of a pattern wherever a line of a file matches it.
std::vector<std::string> matches_in(const fs::path& path, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (const std::string& line : lines_of(path)) {
    for (std::sregex_iterator match(line.begin(), line.end(), regex), end; match != end; ++match) {
      found.push_back((*match)[1]);
    }
  }
  return found;
}

/// Calls `visit(path)` for every source file of a layer.
template <typename Visitor>
void for_each_source(const std::string& layer, const Visitor& visit) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / layer)) {
    const std::string ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") visit(entry.path());
  }
}

void forbid_includes(const std::string& layer, const std::string& pattern) {
  const std::regex forbidden(pattern);
  int count = 0;
  for_each_source(layer, [&](const fs::path& path) {
    for (const std::string& include : matches_in(path, "^#include [<\"]([^>\"]+)[>\"]")) {
      ++count;
      EXPECT_FALSE(std::regex_match(include, forbidden)) << path << " includes " << include;
    }
  });
  EXPECT_GT(count, 20) << "no includes were read in " << layer;
}

// The folders of the project are kept apart by what each library links. System headers and
// libraries without a CMake target are found from everywhere.

TEST(Architecture, CoreUsesNoWindowNoDeviceAndNoCommandLine) {
  forbid_includes(
      "core",
      R"((GLFW|epoxy|GL|AL|backends|embree\d|linux|CLI|cairo)[/.].*|imgui.*|libudev.*|gpiod.*)");
}

TEST(Architecture, DevicesUseNoWindow) {
  forbid_includes("hw", R"((GLFW|epoxy|GL|AL|backends|CLI)[/.].*|imgui.*)");
}

TEST(Architecture, TheWindowUsesNoDevice) {
  forbid_includes("ui", R"((embree\d|linux|CLI)[/.].*|libudev.*|gpiod.*)");
}

TEST(Architecture, TheTestsAreNoPartOfTheProgram) {
  for (const char* layer : kLayers) forbid_includes(layer, "tests/.*");
}

TEST(Architecture, EachFolderIsDescribed) {
  const std::vector<std::string> rows =
      matches_in(kRoot / "docs/architecture.md", R"(^\| *`?([a-z0-9_/]+)`? *\|)");
  const std::set<std::string> described(rows.begin(), rows.end());
  int count = 0;
  for (const char* layer : kLayers) {
    const fs::path list = kRoot / layer / "CMakeLists.txt";
    for (const std::string& folder : matches_in(list, R"(^ *flytri_library\(([a-z0-9_/]+))")) {
      ++count;
      EXPECT_TRUE(described.contains(folder))
          << folder << " has no row in docs/architecture.md: add | " << folder << " | ... |";
    }
  }
  EXPECT_GT(count, 40) << "no lines with flytri_library were read";
}

TEST(Architecture, FilesNamedInDocumentsExist) {
  int count = 0;
  const auto expect_file = [&](const fs::path& document, const fs::path& file) {
    ++count;
    EXPECT_TRUE(fs::exists(file)) << document << " names " << file << ", which does not exist";
  };
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    const fs::path& document = entry.path();
    if (document.extension() != ".md") continue;
    for (const std::string& link : matches_in(document, R"(\]\(([^):#]+)[#)])")) {
      expect_file(document, document.parent_path() / link);
    }
    for (const std::string& file :
         matches_in(document, R"(\b((?:core|hw|ui|app|assets|tests)/[a-z0-9_/]+\.[a-z]+)\b)")) {
      expect_file(document, kRoot / file);
    }
  }
  EXPECT_GT(count, 100) << "no names of files were read";
}

/// Names of the classes, structs and enums that a file declares outside of others, with their
/// namespaces. The format of the code is known: such a declaration begins in the first column.
std::vector<std::string> classes_of(const fs::path& path) {
  static const std::regex kNamespace("^namespace ([a-z0-9_:]+) \\{");
  static const std::regex kEnd("^\\}  // namespace");
  static const std::regex kClass(
      "^(class|struct|union|enum class|enum) ([A-Za-z0-9_]+)([^;]*$|.*\\{)");
  std::vector<std::string> namespaces, classes;
  std::smatch match;
  for (const std::string& line : lines_of(path)) {
    if (std::regex_search(line, match, kNamespace)) {
      namespaces.push_back(match[1].str() + "::");
    } else if (std::regex_search(line, kEnd) && !namespaces.empty()) {
      namespaces.pop_back();
    } else if (std::regex_search(line, match, kClass)) {
      std::string name;
      for (const std::string& part : namespaces) name += part;
      classes.push_back(name + match[2].str());
    }
  }
  return classes;
}

TEST(Architecture, NoTwoHeadersDeclareTheSameClass) {
  std::map<std::string, fs::path> header_of;
  for (const char* layer : kLayers) {
    for_each_source(layer, [&](const fs::path& path) {
      if (path.extension() != ".h") return;
      for (const std::string& name : classes_of(path)) {
        const auto [known, is_new] = header_of.try_emplace(name, path);
        EXPECT_TRUE(is_new) << name << " is declared in " << known->second << " and in " << path;
      }
    });
  }
  EXPECT_GT(header_of.size(), 200U) << "no classes were read";
  EXPECT_TRUE(header_of.contains("flytri::scan::FrameCounter"));
}

}  // namespace
}  // namespace flytri
