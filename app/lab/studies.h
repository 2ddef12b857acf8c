/// @file  The commands of flytri-lab, one function and one file each. They make the figures in
/// docs/.
#pragma once

#include <array>

#include "app/cli/command.h"
#include "app/lab/seeded_study.h"

namespace flytri::lab {

inline constexpr double kMicrons = 1e3;  ///< of a millimeter

/// The studies that repeat their measurement.
void print_table2(const nlohmann::ordered_json& records);
void print_occlusion(const nlohmann::ordered_json& records);
void print_lengths(const nlohmann::ordered_json& records);
void print_standard_tests(const nlohmann::ordered_json& records);
void print_structure(const nlohmann::ordered_json& records);
inline constexpr StudyPrinter kTable2Printer{"table2", print_table2};
inline constexpr StudyPrinter kOcclusionPrinter{"occlusion", print_occlusion};
inline constexpr StudyPrinter kLengthsPrinter{"lengths", print_lengths};
inline constexpr StudyPrinter kStandardTestsPrinter{"standard-tests", print_standard_tests};
inline constexpr StudyPrinter kStructurePrinter{"structure", print_structure};
inline constexpr std::array kPrinters = {kTable2Printer, kOcclusionPrinter, kLengthsPrinter,
                                         kStandardTestsPrinter, kStructurePrinter};

void add_table2_study(CLI::App& lab, cli::Invocation& invocation);
void add_refinement_study(CLI::App& lab, cli::Invocation& invocation);
void add_tracking_study(CLI::App& lab, cli::Invocation& invocation);
void add_continuation_study(CLI::App& lab, cli::Invocation& invocation);
void add_returns_study(CLI::App& lab, cli::Invocation& invocation);
void add_occlusion_study(CLI::App& lab, cli::Invocation& invocation);
void add_lengths_study(CLI::App& lab, cli::Invocation& invocation);
void add_standard_tests_study(CLI::App& lab, cli::Invocation& invocation);
void add_structure_study(CLI::App& lab, cli::Invocation& invocation);
void add_merge_command(CLI::App& lab, cli::Invocation& invocation);
void add_plot_command(CLI::App& lab, cli::Invocation& invocation);
void add_growth_study(CLI::App& lab, cli::Invocation& invocation);
void add_synchronization_study(CLI::App& lab, cli::Invocation& invocation);
void add_live_command(CLI::App& lab, cli::Invocation& invocation);
void add_tissue_study(CLI::App& lab, cli::Invocation& invocation);
void add_lines_study(CLI::App& lab, cli::Invocation& invocation);
void add_enamel_study(CLI::App& lab, cli::Invocation& invocation);

}  // namespace flytri::lab
