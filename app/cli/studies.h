/// @file  The studies, one function and one file each: what the figures in docs/ come from.
#pragma once

#include "app/cli/command.h"

namespace flytri::cli {

inline constexpr double kMicrons = 1e3;  ///< of a millimeter

void add_table2_study(CLI::App& study, Invocation& invocation);
void add_refinement_study(CLI::App& study, Invocation& invocation);
void add_tracking_study(CLI::App& study, Invocation& invocation);
void add_continuation_study(CLI::App& study, Invocation& invocation);
void add_growth_study(CLI::App& study, Invocation& invocation);
void add_synchronization_study(CLI::App& study, Invocation& invocation);

}  // namespace flytri::cli
