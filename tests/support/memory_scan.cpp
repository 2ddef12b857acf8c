#include "tests/support/memory_scan.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <string_view>

namespace flytri::testing {
namespace {

struct Region {
  std::uint64_t first = 0, end = 0;
  std::string permissions, name;
  bool is_locked = false;
};

/// The sanitizers map terabytes, of which they use little.
constexpr std::uint64_t kLargestRegion = std::uint64_t{4} << 30U;
constexpr std::size_t kChunk = std::size_t{1} << 20U;

std::vector<Region> regions_of(pid_t process) {
  std::vector<Region> regions;
  std::ifstream file(fmt::format("/proc/{}/smaps", process));
  for (std::string line; std::getline(file, line);) {
    Region region;
    char dash = 0;
    std::string offset, device, inode;
    std::istringstream words(line);
    if (words >> std::hex >> region.first >> dash >> region.end >> region.permissions &&
        dash == '-') {
      words >> offset >> device >> inode >> region.name;
      regions.push_back(region);
    } else if (line.starts_with("VmFlags:")) {
      regions.back().is_locked = line.find(" lo") != std::string::npos;
    }
  }
  return regions;
}

/// Whether the letters stand here, each in so many bytes.
bool stands_at(std::string_view text, const char* bytes, std::size_t width) {
  constexpr std::array<char, 4> kZeros = {};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char* const letter = bytes + i * width;
    if (*letter != text[i] || std::memcmp(letter + 1, kZeros.data(), width - 1) != 0) return false;
  }
  return true;
}

/// The offset of the first copy, or the size.
std::size_t find_text(std::string_view text, const char* bytes, std::size_t size) {
  for (std::size_t at = 0; at + text.size() <= size; ++at) {
    const void* const next = std::memchr(bytes + at, text.front(), size - at);
    if (next == nullptr) break;
    at = static_cast<std::size_t>(static_cast<const char*>(next) - bytes);
    for (const std::size_t width : {1, 2, 4}) {
      if (at + text.size() * width <= size && stands_at(text, bytes + at, width)) return at;
    }
  }
  return size;
}

/// Of either half: the other one may be overwritten.
std::size_t find_copy(std::string_view text, const char* bytes, std::size_t size) {
  const std::size_t half = text.size() / 2;
  return std::min(find_text(text.substr(0, half), bytes, size),
                  find_text(text.substr(half), bytes, size));
}

}  // namespace

Secret random_passphrase() {
  constexpr std::size_t kLength = 16;
  std::random_device random;
  std::uniform_int_distribution<int> letter('a', 'z');
  Secret secret;
  char* const text = secret.buffer(kLength + 1);
  for (std::size_t i = 0; i < kLength; ++i) text[i] = static_cast<char>(letter(random));
  return secret;
}

bool memory_can_be_locked() {
  const Secret secret("secret");
  const auto place = reinterpret_cast<std::uintptr_t>(secret.view().data());
  for (const Region& region : regions_of(::getpid())) {
    if (region.first <= place && place < region.end) return region.is_locked;
  }
  return false;
}

std::vector<std::string> unlocked_copies(pid_t process, const Secret& text) {
  std::vector<std::string> copies;
  // What is read is in locked memory, so that the scan does not find itself.
  Secret memory;
  char* const bytes = memory.buffer(kChunk);
  const std::size_t overlap = 4 * text.view().size();
  const int file = ::open(fmt::format("/proc/{}/mem", process).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {"the memory cannot be read"};
  for (const Region& region : regions_of(process)) {
    if (region.is_locked || region.permissions[0] != 'r' ||
        region.end - region.first > kLargestRegion)
      continue;
    for (std::uint64_t at = region.first; at < region.end; at += kChunk - overlap) {
      const ssize_t size = ::pread(file, bytes, std::min<std::uint64_t>(kChunk, region.end - at),
                                   static_cast<off_t>(at));
      if (size <= 0) break;
      const std::size_t found = find_copy(text.view(), bytes, static_cast<std::size_t>(size));
      if (found == static_cast<std::size_t>(size)) continue;
      copies.push_back(fmt::format("{:x} {} {}", at + found, region.permissions, region.name));
    }
  }
  ::close(file);
  return copies;
}

}  // namespace flytri::testing
