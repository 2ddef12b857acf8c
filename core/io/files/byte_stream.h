/// @file  Writes little-endian numbers to files and to memory, and reads them from memory.
#pragma once

#include <bit>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/files/atomic_file.h"

namespace flytri::io {

static_assert(std::endian::native == std::endian::little, "the formats here are little-endian");

/// Appends a number to some bytes.
template <typename T>
void append_number(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Collects small pieces of a model for an AtomicFile that only its owner may read. The first
/// failure is reported at the end.
class ByteWriter {
 public:
  [[nodiscard]] static Result<ByteWriter> create(const std::filesystem::path& path) {
    return AtomicFile::create(path, Access::kOwnerOnly).map([](AtomicFile&& file) {
      return ByteWriter(std::move(file));
    });
  }
  void text(std::string_view bytes) {
    buffer_.append(bytes);
    if (buffer_.size() >= kBlock) flush();
  }
  template <typename T>
  void number(T value) {
    text({reinterpret_cast<const char*>(&value), sizeof(T)});
  }
  [[nodiscard]] Result<void> commit() {
    flush();
    return outcome_ ? file_.commit() : outcome_;
  }
  /// Hands over the written file, for commit_together(). Write nothing afterwards.
  [[nodiscard]] Result<AtomicFile> finish() {
    flush();
    if (!outcome_) return tl::unexpected(outcome_.error());
    return std::move(file_);
  }

 private:
  static constexpr std::size_t kBlock = 1U << 20U;

  explicit ByteWriter(AtomicFile&& file) : file_(std::move(file)) {}
  void flush() {
    if (outcome_) outcome_ = file_.write(buffer_);
    buffer_.clear();
  }

  AtomicFile file_;
  std::string buffer_;
  Result<void> outcome_;
};

/// Reads numbers one after another from some bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  template <typename T>
  [[nodiscard]] std::optional<T> number() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

}  // namespace flytri::io
