#include "app/cli/review_request.h"

#include <charconv>
#include <cmath>

namespace flytri::cli {
namespace {

/// One point, "X,Y,Z".
std::optional<Vec3> parse_point(std::string_view text) {
  Vec3 point;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, point[k]);
    if (error != std::errc() || !std::isfinite(point[k])) return std::nullopt;
    at = next;
  }
  if (at != end) return std::nullopt;
  return point;
}

/// As parse_points, with exactly so many.
Result<std::vector<Vec3>> parse_count(const std::string& text, std::string_view option,
                                      std::size_t count, std::string_view form) {
  auto points = parse_points(text, option);
  if (!points || points->size() == count) return points;
  return fail(ErrorCode::kBadOption, "{} \"{}\": give it as \"{}\"", option, text, form);
}

constexpr std::string_view kTwoPoints = "X,Y,Z X,Y,Z";

Result<void> parse_section(const ReviewTexts& texts, ReviewRequest& request) {
  if (!texts.section_plane.empty()) {
    const auto plane = parse_count(texts.section_plane, "--section-plane", 2,
                                   "X,Y,Z NX,NY,NZ: a point and the normal");
    if (!plane) return tl::unexpected(plane.error());
    request.section = review::Plane{(*plane)[0], (*plane)[1]};
  }
  if (texts.section_points.empty()) return {};
  if (!request.section)
    return fail(ErrorCode::kBadOption,
                "--section-points measures on a section; add --section-plane");
  auto points = parse_count(texts.section_points, "--section-points", 2, kTwoPoints);
  if (!points) return tl::unexpected(points.error());
  request.section_points_mm = *std::move(points);
  return {};
}

Result<void> parse_axis(const ReviewTexts& texts, ReviewRequest& request) {
  if (!texts.around.empty()) {
    const auto around = parse_count(texts.around, "--around", 1, "X,Y,Z");
    if (!around) return tl::unexpected(around.error());
    request.around_mm = around->front();
  }
  if (texts.axis.empty()) {
    if (!request.around_mm) return {};
    return fail(ErrorCode::kBadOption, "--around chooses where the undercut is found; add --axis");
  }
  request.axis = ReviewAxis{};
  if (texts.axis == "auto") {
    if (request.around_mm) return {};
    return fail(ErrorCode::kBadOption,
                "--axis auto finds the axis of one tooth; add --around X,Y,Z, a point on it");
  }
  const auto axis = parse_count(texts.axis, "--axis", 1, "X,Y,Z, or auto");
  if (!axis) return tl::unexpected(axis.error());
  request.axis->direction = axis->front();
  return {};
}

Result<void> parse_groups(const std::vector<std::string>& texts, std::string_view option,
                          std::size_t count, std::string_view form,
                          std::vector<std::vector<Vec3>>& groups) {
  for (const std::string& text : texts) {
    auto points = parse_count(text, option, count, form);
    if (!points) return tl::unexpected(points.error());
    groups.push_back(*std::move(points));
  }
  return {};
}

Result<void> parse_margin(const ReviewTexts& texts, ReviewRequest& request) {
  for (const std::string& text : texts.margin) {
    const auto points = parse_points(text, "--margin");
    if (!points) return tl::unexpected(points.error());
    request.margin_mm.insert(request.margin_mm.end(), points->begin(), points->end());
  }
  return {};
}

}  // namespace

Result<std::vector<Vec3>> parse_points(std::string_view text, std::string_view option) {
  std::vector<Vec3> points;
  constexpr std::string_view kSpaces = " \t\n";
  for (std::size_t begin = text.find_first_not_of(kSpaces); begin != text.npos;
       begin = text.find_first_not_of(kSpaces, begin)) {
    const std::string_view word = text.substr(begin, text.find_first_of(kSpaces, begin) - begin);
    const auto point = parse_point(word);
    if (!point)
      return fail(ErrorCode::kBadOption,
                  "{}: \"{}\" is not a point; give three numbers with commas, as 1.5,-2,0 (mm)",
                  option, word);
    points.push_back(*point);
    begin += word.size();
  }
  if (!points.empty()) return points;
  return fail(ErrorCode::kBadOption, "{}: is empty; give points as X,Y,Z", option);
}

Result<ReviewRequest> parse_review(const ReviewTexts& texts) {
  ReviewRequest request;
  const Result<void> parsed =
      parse_section(texts, request)
          .and_then([&] { return parse_axis(texts, request); })
          .and_then([&] { return parse_margin(texts, request); })
          .and_then([&] {
            return parse_groups(texts.distances, "--distance", 2, kTwoPoints, request.distances_mm);
          })
          .and_then([&] {
            return parse_groups(texts.angles, "--angle", 3, "X,Y,Z X,Y,Z X,Y,Z, the apex second",
                                request.angles_mm);
          });
  if (!parsed) return tl::unexpected(parsed.error());
  if (request.section || request.axis || !request.margin_mm.empty() ||
      !request.distances_mm.empty() || !request.angles_mm.empty())
    return request;
  return fail(ErrorCode::kBadOption,
              "nothing to measure; give --section-plane, --axis, --margin, --distance or --angle");
}

}  // namespace flytri::cli
