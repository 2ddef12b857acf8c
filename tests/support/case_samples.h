/// @file  Sample views, frames and edits for tests of case files, and bitwise comparisons.
#pragma once

#include <filesystem>

#include "core/editing/edits.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/io/cases/case_file.h"

namespace flytri::testing {

/// A realistic view with `line_count` profiles: steps of 25 µm along the line, depth noise of 30
/// µm.
[[nodiscard]] View sample_view(int frame, int line_count = 10, int points_per_line = 450);

/// A color image with noise and a gradient.
[[nodiscard]] Frame sample_texture(int frame, ImageSize size = {64, 48});

/// A pose whose numbers have no short decimal form.
[[nodiscard]] Isometry sample_pose(int number);

/// A stroke of three dabs.
[[nodiscard]] editing::Edit sample_edit(int number);

/// Appends sample views, each with a pose and the frame that it is of.
[[nodiscard]] Result<void> append_registered_views(io::CaseFile& file, io::ScanStage stage,
                                                   int first, int count);

/// A closed line of `points` points with three clicks; the second point has no known uncertainty.
[[nodiscard]] io::StoredMargin sample_margin(int points = 12);

/// Runs SQL on a closed case with the library alone, as somebody who makes a crafted case would.
/// @return  the library's error message; empty: it was done
[[nodiscard]] std::string run_sql(const std::filesystem::path& path, const std::string& sql);

/// Makes a closed case one of version 1, which had no journal.
void make_version_1(const std::filesystem::path& path);

// Bitwise comparison: NaN equals NaN, and -0 differs from 0.
[[nodiscard]] bool same_bits(const View& a, const View& b);
[[nodiscard]] bool same_bits(const Isometry& a, const Isometry& b);
[[nodiscard]] bool same_bits(const editing::Edit& a, const editing::Edit& b);
[[nodiscard]] bool same_bits(const Frame& a, const Frame& b);

}  // namespace flytri::testing
