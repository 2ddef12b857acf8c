/// @file  The groups of the table of actions, each in a file of its own name.
#pragma once

#include <array>
#include <span>

#include "ui/actions/action_runner.h"
#include "ui/actions/action_table.h"
#include "ui/actions/situation.h"

namespace flytri::ui {

[[nodiscard]] std::span<const ActionRow> scanning_actions();
[[nodiscard]] std::span<const ActionRow> editing_actions();
[[nodiscard]] std::span<const ActionRow> looking_actions();
[[nodiscard]] std::span<const ActionRow> hand_actions();
[[nodiscard]] std::span<const ActionRow> calibrating_actions();
[[nodiscard]] std::span<const ActionRow> program_actions();

/// For a static_assert beside the rows of a group: each action of the group has its row, in order,
/// and does something.
template <std::size_t kSize>
[[nodiscard]] constexpr bool lists_all_of(ActionGroup group,
                                          const std::array<ActionRow, kSize>& rows) {
  if (rows.size() != end_of(group) - first_of(group)) return false;
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool is_complete = rows[i].state != nullptr && rows[i].perform != nullptr;
    if (!is_complete || index_of(rows[i].action) != first_of(group) + i) return false;
  }
  return true;
}

}  // namespace flytri::ui
