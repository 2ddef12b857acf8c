#include "core/base/secret.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <new>
#include <utility>

namespace flytri {
namespace {

std::size_t whole_pages(std::size_t size) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return (size + page - 1) / page * page;
}

/// New pages, all zero. What the system does not permit is left out: the text is needed all the
/// same.
char* take_pages(std::size_t size) {
  void* const pages =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  (void)::mlock(pages, size);
  (void)::madvise(pages, size, MADV_DONTDUMP);
  // A child process gets zeros.
  (void)::madvise(pages, size, MADV_WIPEONFORK);
  return static_cast<char*>(pages);
}

void return_pages(char* pages, std::size_t size) {
  if (pages == nullptr) return;
  wipe(pages, size);
  ::munmap(pages, size);
}

}  // namespace

void wipe(void* memory, std::size_t size) {
  if (size > 0) ::explicit_bzero(memory, size);
}

Secret::Secret(std::string_view text) {
  if (!text.empty()) std::memcpy(buffer(text.size() + 1), text.data(), text.size());
}

Secret& Secret::operator=(const Secret& other) {
  if (this != &other) *this = Secret(other);
  return *this;
}

Secret::Secret(Secret&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

Secret& Secret::operator=(Secret&& other) noexcept {
  if (this == &other) return *this;
  return_pages(data_, size_);
  data_ = std::exchange(other.data_, nullptr);
  size_ = std::exchange(other.size_, 0);
  return *this;
}

Secret::~Secret() { return_pages(data_, size_); }

std::string_view Secret::view() const {
  return data_ == nullptr ? std::string_view() : std::string_view(data_, ::strnlen(data_, size_));
}

bool Secret::equals(const Secret& other) const {
  const std::string_view own = view(), others = other.view();
  if (own.size() != others.size()) return false;
  unsigned char differing_bits = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    differing_bits |= static_cast<unsigned char>(own[i]) ^ static_cast<unsigned char>(others[i]);
  }
  return differing_bits == 0;
}

void Secret::clear() { wipe(data_, size_); }

char* Secret::buffer(std::size_t capacity) {
  if (capacity <= size_) return data_;
  const std::size_t size = whole_pages(capacity);
  char* const pages = take_pages(size);
  const std::string_view text = view();
  if (!text.empty()) std::memcpy(pages, text.data(), text.size());
  return_pages(std::exchange(data_, pages), std::exchange(size_, size));
  return data_;
}

}  // namespace flytri
