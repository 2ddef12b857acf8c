#include "app/cli/console.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace flytri::cli {
namespace {

TEST(Console, NamesOfFilesCannotSteerTheTerminal) {
  EXPECT_EQ(printable("Müller 1.png"), "Müller 1.png");
  EXPECT_EQ(printable("a\x1b[31mb\r\nflytri: done"), "a\\x1b[31mb\\x0d\\nflytri: done");
  EXPECT_EQ(printable("\x7f\t"), "\\x7f\\x09");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m");  // the same, as one character of UTF-8
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Console, KeepsTheFormatAndEscapesTheArguments) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  print_to(file, "{:>4}: {}\n", 7, std::string("a\nb"));
  std::rewind(file);
  std::array<char, 32> text{};
  const std::size_t size = std::fread(text.data(), 1, text.size(), file);
  EXPECT_EQ(std::string_view(text.data(), size), "   7: a\\nb\n");
  std::fclose(file);
}

TEST(Console, AStreamThatCannotBeWrittenEndsNothing) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  std::setvbuf(full, nullptr, _IONBF, 0);
  print_to(full, "{}\n", "lost");  // fmt::print would throw
  EXPECT_NE(std::ferror(full), 0);
  std::fclose(full);
}

}  // namespace
}  // namespace flytri::cli
