/// @file  A passphrase in memory: not swapped to a disk, not in a core dump, wiped after use.
#pragma once

#include <cstddef>
#include <string_view>

namespace flytri {

/// A text without zero bytes, in memory of its own. The memory is locked where the system permits
/// it, and wiped when the text is cleared, assigned, moved from or destroyed. An empty secret that
/// never held a text takes no memory. It has no operator== and no way into a stream or a format,
/// so that it is neither compared nor printed by accident.
class Secret {
 public:
  Secret() = default;
  /// The caller wipes its own copy.
  explicit Secret(std::string_view text);
  Secret(const Secret& other) : Secret(other.view()) {}
  Secret& operator=(const Secret& other);
  Secret(Secret&& other) noexcept;
  Secret& operator=(Secret&& other) noexcept;
  ~Secret();

  /// Valid until the secret is changed. Make no copies of it.
  [[nodiscard]] std::string_view view() const;
  [[nodiscard]] bool empty() const { return view().empty(); }
  /// Takes as long for a wrong text as for the right one of the same length.
  [[nodiscard]] bool equals(const Secret& other) const;
  void clear();

  /// Memory for a text field, or for reading a file, to write the text into: at least
  /// `capacity` bytes, the last of which must stay zero. The present text is kept.
  [[nodiscard]] char* buffer(std::size_t capacity);

 private:
  char* data_ = nullptr;  ///< whole pages; null: there are none
  std::size_t size_ = 0;  ///< of the pages, bytes
};

/// Wipes what a text that is no secret yet was read into.
void wipe(void* memory, std::size_t size);

}  // namespace flytri
