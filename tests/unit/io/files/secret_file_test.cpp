#include "core/io/files/secret_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/files/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace flytri::io {
namespace {

using ::testing::HasSubstr;

TEST(SecretFile, HasThePassphraseInItsFirstLine) {
  const TemporaryFolder folder;
  const auto path = folder / "passphrase";
  for (const char* text : {"o∴p & q", "o∴p & q\n", "o∴p & q\r\nmore\n"}) {
    ASSERT_TRUE(write_file(path, text));
    EXPECT_EQ(read_secret(path).value().view(), "o∴p & q");
  }
  ASSERT_TRUE(write_file(path, ""));
  EXPECT_TRUE(read_secret(path).value().empty());
}

TEST(SecretFile, WhatIsNoPassphraseIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "passphrase";
  const std::string longest(1000, 'x');
  ASSERT_TRUE(write_file(path, longest + "\n"));
  EXPECT_EQ(read_secret(path).value().view(), longest);
  for (const std::string& text : {longest + "x", std::string("a\0b", 3)}) {
    ASSERT_TRUE(write_file(path, text));
    const auto refused = read_secret(path);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("passphrase: its first line"));
  }
  EXPECT_EQ(read_secret(folder / "nothing").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace flytri::io
