/// @file  Text fields for passphrases, and the copies of typed text that Dear ImGui keeps.
#pragma once

#include "core/base/secret.h"

namespace flytri::ui {

/// A text field that shows dots and writes into the secret itself. If the program has cleared the
/// secret since the last frame, the field is empty, too, and no longer active.
/// @return  true when the text was changed
bool secret_input(const char* id, Secret& secret);

/// Wipes what Dear ImGui keeps of fields that are no longer edited. Call it after each frame.
void wipe_typed_text();

}  // namespace flytri::ui
