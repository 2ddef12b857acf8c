#include "app/session/export_name.h"

#include <fmt/format.h>
#include <locale.h>
#include <wctype.h>

#include <cctype>
#include <memory>
#include <type_traits>

namespace flytri::session {
namespace {

constexpr std::size_t kMaxBytes = 80;

/// A character of a text, and how many bytes it takes.
struct Character {
  char32_t code = 0;  ///< 0: not UTF-8
  std::size_t bytes = 1;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80U) return {lead, 1};
  const std::size_t count = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < count) return {};
  char32_t code = lead & (0x7FU >> count);
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  return {code, count};
}

/// Knows the letters of all scripts, whatever the locale of the program is.
class Letters {
 public:
  [[nodiscard]] bool contain(char32_t code) const {
    // Accents that follow their letter.
    if (code >= 0x300 && code <= 0x36F) return true;
    if (locale_ == nullptr) return code < 0x80 && std::isalnum(static_cast<int>(code)) != 0;
    return ::iswalnum_l(static_cast<wint_t>(code), locale_.get()) != 0;
  }

 private:
  struct Free {
    void operator()(locale_t locale) const { ::freelocale(locale); }
  };
  std::unique_ptr<std::remove_pointer_t<locale_t>, Free> locale_{
      ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)};
};

/// Adds a part after a dash, if it is not empty.
void add_part(std::string& name, std::string_view text) {
  const std::string part = file_name_part(text);
  if (part.empty()) return;
  if (!name.empty()) name += '-';
  name += part;
}

}  // namespace

std::string file_name_part(std::string_view text) {
  const Letters letters;
  std::string part;
  while (!text.empty()) {
    const Character next = first_character(text);
    const bool stays = next.code == '_' || letters.contain(next.code);
    if (stays && part.size() + next.bytes > kMaxBytes) break;
    if (stays) {
      part += text.substr(0, next.bytes);
    } else if (!part.empty() && part.back() != '-') {
      part += '-';
    }
    text.remove_prefix(next.bytes);
  }
  if (!part.empty() && part.back() == '-') part.pop_back();
  return part;
}

std::string proposed_jaws_name(const ui::CaseState& file, std::string_view date) {
  std::string name;
  if (!file.path.empty()) {
    if (!file.is_encrypted) add_part(name, file.fields.patient_name);
    add_part(name, file.fields.patient_id);
  }
  return name.empty() ? fmt::format("scan-{}", date) : name;
}

std::string proposed_export_name(const ui::CaseState& file, io::ScanStage stage,
                                 std::string_view date) {
  return fmt::format("{}-{}", proposed_jaws_name(file, date), io::to_string(stage));
}

}  // namespace flytri::session
