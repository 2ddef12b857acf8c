/// @file  Encodes and decodes the records of a case, except views, see view_codec.h.
///
/// For the sources of core/io/cases only. Numbers in bytes are little-endian.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/io/cases/case_file.h"

namespace flytri::io {

/// A JSON object with a key for each field.
[[nodiscard]] std::string encode_fields(const CaseFields& fields);
[[nodiscard]] Result<CaseFields> decode_fields(std::string_view bytes);

/// JSON: time_s, kind, fate, reason. The number of the record is the frame index.
[[nodiscard]] std::string encode_frame(const StoredFrame& frame);
[[nodiscard]] Result<StoredFrame> decode_frame(std::string_view bytes, FrameIndex index);

/// JSON: from_mm, to_mm, label. The id is that of the record.
[[nodiscard]] std::string encode_measurement(const Measurement& measurement);
[[nodiscard]] Result<Measurement> decode_measurement(std::string_view bytes, std::int64_t id);

/// JSON: occlusal_points_mm, the nine coordinates of the three points.
[[nodiscard]] std::string encode_plane(const OcclusalPoints& points);
[[nodiscard]] Result<OcclusalPoints> decode_plane(std::string_view bytes);
/// JSON: clicks_mm, points_mm (x, y, z, and sigma where it is known), edge_share, least_turn_rad.
/// The id is that of the record.
[[nodiscard]] std::string encode_margin(const StoredMargin& margin);
[[nodiscard]] Result<StoredMargin> decode_margin(std::string_view bytes, std::int64_t id);
/// Whether it is a closed line that somebody can have drawn.
/// @errors  kBadOption.
[[nodiscard]] Result<void> check_margin(const StoredMargin& margin);

/// f64[12]: the upper three rows of the matrix, row by row.
[[nodiscard]] std::string encode_pose(const Isometry& T_world_sensor);
[[nodiscard]] Result<Isometry> decode_pose(std::string_view bytes);

/// u8 kind (0 trim, 1 lock, 2 unlock), f64 made_at_s, then f32[7] for each dab: center, normal,
/// radius.
[[nodiscard]] std::string encode_edit(const editing::Edit& edit);
[[nodiscard]] Result<editing::Edit> decode_edit(std::string_view bytes);

/// u32: how many of the edits apply.
[[nodiscard]] std::string encode_count(std::size_t count);
[[nodiscard]] Result<std::size_t> decode_count(std::string_view bytes);

/// The summary, a JSON object or empty, with the basis under "made_of": view_count, edited_at_s.
[[nodiscard]] std::string encode_summary(const std::string& summary_json,
                                         const std::optional<ResultBasis>& made_of);
/// None: the summary does not say what the model was made of.
[[nodiscard]] std::optional<ResultBasis> decode_made_of(std::string_view summary_json);

/// The view of a frame, see view_codec.h. A crafted file may hold any numbers: they are such as a
/// sensor can have measured.
[[nodiscard]] Result<View> decode_measured_view(std::string_view bytes, FrameIndex index);

/// f64 time_s, then a PNG.
/// @errors  As encode_png.
[[nodiscard]] Result<std::string> encode_texture(const Frame& frame);
[[nodiscard]] Result<Frame> decode_texture(std::string_view bytes, FrameIndex index);

}  // namespace flytri::io
