/// @file  The icons of the window, as UTF-8 of their place in Font Awesome 4.7.
#pragma once

namespace flytri::ui {

inline constexpr unsigned short kFirstIcon = 0xF000;
inline constexpr unsigned short kLastIcon = 0xF2E0;

namespace icon {
inline constexpr const char* kScan = "\xef\x81\x8b";         ///< play, F04B
inline constexpr const char* kPause = "\xef\x81\x8c";        ///< pause, F04C
inline constexpr const char* kUndo = "\xef\x83\xa2";         ///< undo, F0E2
inline constexpr const char* kRedo = "\xef\x80\x9e";         ///< repeat, F01E
inline constexpr const char* kTrim = "\xef\x84\xad";         ///< eraser, F12D
inline constexpr const char* kLock = "\xef\x80\xa3";         ///< lock, F023
inline constexpr const char* kUnlock = "\xef\x82\x9c";       ///< unlock, F09C
inline constexpr const char* kMeasure = "\xef\x81\xbe";      ///< arrows-h, F07E
inline constexpr const char* kFinish = "\xef\x80\x8c";       ///< check, F00C
inline constexpr const char* kExport = "\xef\x80\x99";       ///< download, F019
inline constexpr const char* kResume = "\xef\x80\xa1";       ///< refresh, F021
inline constexpr const char* kCancel = "\xef\x80\x8d";       ///< times, F00D
inline constexpr const char* kHelp = "\xef\x84\x9c";         ///< keyboard, F11C
inline constexpr const char* kWarning = "\xef\x81\xb1";      ///< exclamation-triangle, F071
inline constexpr const char* kInformation = "\xef\x81\x9a";  ///< info-circle, F05A
inline constexpr const char* kNext = "\xef\x81\xa1";         ///< arrow-right, F061
inline constexpr const char* kCase = "\xef\x81\xbc";         ///< folder-open, F07C
inline constexpr const char* kSettings = "\xef\x80\x93";     ///< cog, F013
inline constexpr const char* kSaved = "\xef\x81\x98";        ///< check-circle, F058
inline constexpr const char* kScanned = "\xef\x81\x82";      ///< adjust, F042
inline constexpr const char* kSound = "\xef\x80\xa8";        ///< volume-up, F028
inline constexpr const char* kMuted = "\xef\x80\xa6";        ///< volume-off, F026
inline constexpr const char* kHand = "\xef\x89\x96";         ///< hand-paper, F256
inline constexpr const char* kPath = "\xef\x80\x98";         ///< road, F018
inline constexpr const char* kTrash = "\xef\x87\xb8";        ///< trash, F1F8
inline constexpr const char* kTarget = "\xef\x81\x9b";       ///< crosshairs, F05B
inline constexpr const char* kDevice = "\xef\x80\xb0";       ///< camera, F030
}  // namespace icon

}  // namespace flytri::ui
