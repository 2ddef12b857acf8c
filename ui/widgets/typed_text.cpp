#include "ui/widgets/typed_text.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "ui/imgui/text_undo.h"

namespace flytri::ui {
namespace {

/// The longest passphrase that can be typed, bytes, and the zero that ends it.
constexpr std::size_t kCapacity = 256;

template <typename Letter>
void wipe_letters(Letter* first, Letter* last) {
  wipe(first, static_cast<std::size_t>(last - first) * sizeof(Letter));
}

/// Wipes the memory behind the zero that ends the text.
template <typename Letter>
void wipe_behind_text(ImVector<Letter>& text) {
  Letter* const end = text.Data + text.Size;
  Letter* const zero = std::find(text.Data, end, Letter{});
  wipe_letters(zero, text.Data + text.Capacity);
}

template <typename Letter>
void wipe_text(ImVector<Letter>& text) {
  wipe_letters(text.Data, text.Data + text.Capacity);
}

// Releases of Dear ImGui differ in the texts that they keep: these call `wiping` for those that
// this one has.

template <typename State, typename Wiping>
void for_each_text(State& state, const Wiping& wiping) {
  if constexpr (requires { state.TextW.Data; }) wiping(state.TextW);
  if constexpr (requires { state.TextA.Data; }) wiping(state.TextA);
  if constexpr (requires { state.InitialTextA.Data; }) wiping(state.InitialTextA);
  if constexpr (requires { state.TextToRevertTo.Data; }) wiping(state.TextToRevertTo);
  if constexpr (requires { state.CallbackTextBackup.Data; }) wiping(state.CallbackTextBackup);
}

template <typename State>
auto& undo_of(State& state) {
  if constexpr (std::is_pointer_v<decltype(state.Stb)>) {
    return state.Stb->undostate;
  } else {
    return state.Stb.undostate;
  }
}

/// The text of a field that was edited until this frame, for its next frame.
template <typename Context>
void wipe_deactivated(Context& context) {
  if constexpr (requires { context.InputTextDeactivatedState.TextA; }) {
    auto& left = context.InputTextDeactivatedState;
    if (left.ID == 0 || left.ID != context.ActiveIdPreviousFrame) wipe_text(left.TextA);
  }
}

/// As if no field had been edited until this frame.
template <typename Context>
void forget_deactivated(Context& context) {
  if constexpr (requires { context.InputTextDeactivatedState.TextA; }) {
    wipe_text(context.InputTextDeactivatedState.TextA);
    context.InputTextDeactivatedState.ID = 0;
  }
}

/// The letters in events that Dear ImGui has passed on.
template <typename Context>
void wipe_past_events(Context& context) {
  if constexpr (requires { context.InputEventsTrail.Data; }) {
    wipe_text(context.InputEventsTrail);
    auto& waiting = context.InputEventsQueue;
    wipe_letters(waiting.Data + waiting.Size, waiting.Data + waiting.Capacity);
  }
}

/// Of a field that is edited, what an earlier one left in the same memory.
void wipe_remains(ImGuiInputTextState& typed) {
  for_each_text(typed, [](auto& text) { wipe_behind_text(text); });
  auto& undo = undo_of(typed);
  wipe_letters(undo.undo_char + undo.undo_char_point, undo.undo_char + undo.redo_char_point);
}

void forget(ImGuiInputTextState& typed) {
  for_each_text(typed, [](auto& text) { wipe_text(text); });
  auto& undo = undo_of(typed);
  wipe_letters(std::begin(undo.undo_char), std::end(undo.undo_char));
  typed.ID = 0;
}

}  // namespace

bool secret_input(const char* id, Secret& secret) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  ImGuiInputTextState& typed = context.InputTextState;
  const ImGuiID item = ImGui::GetID(id);
  const bool is_edited = context.ActiveId == item && typed.ID == item;
  const bool has_text = is_edited && !typed.TextA.empty() && typed.TextA[0] != '\0';
  if (secret.empty() && has_text) {
    ImGui::ClearActiveID();
    forget(typed);
    forget_deactivated(context);
  }
  return ImGui::InputText(id, secret.buffer(kCapacity), kCapacity, ImGuiInputTextFlags_Password);
}

void wipe_typed_text() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  ImGuiInputTextState& typed = context.InputTextState;
  if (typed.ID != 0 && context.ActiveId != typed.ID) {
    forget(typed);
  } else if (typed.ID != 0) {
    wipe_remains(typed);
  }
  wipe_deactivated(context);
  wipe_past_events(context);
  wipe_text(context.IO.InputQueueCharacters);
}

}  // namespace flytri::ui
