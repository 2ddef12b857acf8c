#include "core/measurement/measure_view.h"

#include "core/base/check_options.h"
#include "core/localization/outline.h"

namespace flytri::measurement {
namespace {

Result<MeasuredView> measure_pattern(const Frame& frame, Pattern pattern,
                                     const calibration::Calibration& calibration,
                                     const MeasureOptions& options) {
  const bool is_dense = calibration.of(pattern).has_shared_areas();
  const auto traces = localization::localize_lines(
      frame.image, pattern, is_dense ? for_dense_lines(options.localize) : options.localize);
  if (!traces) return tl::unexpected(traces.error());
  const indexing::IndexedLines lines =
      indexing::index_lines(*traces, calibration, pattern, options.index);
  triangulation::Triangulation triangulation =
      triangulation::triangulate(lines, calibration, pattern, options.triangulate);

  MeasuredView measured;
  measured.view = std::move(triangulation.view);
  measured.view.frame = frame.index;
  measured.view.time_s = frame.time_s;
  for (const localization::LineTrace& trace : *traces) {
    measured.counts.localized += static_cast<int>(trace.size());
    measured.lines.push_back(localization::outline_of(trace, pattern));
  }
  measured.counts.index = lines.counts;
  measured.counts.short_profiles = triangulation.short_profiles;
  measured.counts.points = static_cast<int>(measured.view.point_count());
  return measured;
}

/// A rejected view has no points.
MeasuredView rejected(MeasuredView measured, MeasureOutcome outcome) {
  measured.outcome = outcome;
  measured.view.profiles.clear();
  return measured;
}

Result<MeasuredView> measure_unknown(const Frame& frame,
                                     const calibration::Calibration& calibration,
                                     const MeasureOptions& options) {
  auto vertical = measure_pattern(frame, Pattern::kVertical, calibration, options);
  if (!vertical) return vertical;
  auto horizontal = measure_pattern(frame, Pattern::kHorizontal, calibration, options);
  if (!horizontal) return horizontal;
  const bool is_vertical = vertical->counts.points >= horizontal->counts.points;
  const MeasuredView& more = is_vertical ? *vertical : *horizontal;
  const MeasuredView& less = is_vertical ? *horizontal : *vertical;
  const bool clear = more.counts.points >= options.min_pattern_ratio * less.counts.points;
  return clear ? more : rejected(more, MeasureOutcome::kAmbiguousPattern);
}

}  // namespace

Result<void> MeasureOptions::validate() const {
  return OptionCheck("MeasureOptions")
      .nested(localize)
      .nested(index)
      .nested(triangulate)
      .above("min_pattern_ratio", min_pattern_ratio, 1.0)
      .at_least("min_points", min_points, 1)
      .result();
}

std::string_view to_string(MeasureOutcome outcome) {
  switch (outcome) {
    case MeasureOutcome::kMeasured:
      return "measured";
    case MeasureOutcome::kTooFewPoints:
      return "too few points inside the measurement volume";
    case MeasureOutcome::kAmbiguousPattern:
      return "cannot recognize the pattern in the image";
  }
  return "";
}

Result<MeasuredView> measure_view(const Frame& frame, const calibration::Calibration& calibration,
                                  const MeasureOptions& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const ImageSize size{frame.image.cols, frame.image.rows};
  if (!(size == calibration.measurement_size)) {
    return fail(ErrorCode::kInconsistent,
                "frame {} has {} x {} pixels, but the calibration is for {} x {}; use the "
                "calibration of this sensor",
                frame.index.value, size.width_px, size.height_px,
                calibration.measurement_size.width_px, calibration.measurement_size.height_px);
  }
  if (frame.kind == FrameKind::kTexture) {
    return fail(
        ErrorCode::kBadOption,
        "frame {} is a texture frame and shows no lines; measure frames of a line pattern only",
        frame.index.value);
  }
  const auto pattern = pattern_of(frame.kind);
  auto measured = pattern ? measure_pattern(frame, *pattern, calibration, options)
                          : measure_unknown(frame, calibration, options);
  if (!measured) {
    return fail(measured.error().code, "frame {}: {}", frame.index.value, measured.error().message);
  }
  if (measured->outcome == MeasureOutcome::kMeasured &&
      measured->counts.points < options.min_points) {
    return rejected(*std::move(measured), MeasureOutcome::kTooFewPoints);
  }
  return measured;
}

}  // namespace flytri::measurement
