#include "app/report/span_json.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace flytri::report {
namespace {

using nlohmann::json;
using reconstruct::JawSpan;
using reconstruct::JawSpanKind;
using reconstruct::JudgedSpan;

/// All spans that have a name.
std::vector<JawSpan> named_spans() {
  std::vector<JawSpan> spans;
  for (const JawSpanKind kind : {JawSpanKind::kLastTeeth, JawSpanKind::kPremolars,
                                 JawSpanKind::kHalf, JawSpanKind::kLength}) {
    spans.push_back({kind, std::nullopt, {}});
  }
  for (const bool is_right : {false, true}) spans.push_back({JawSpanKind::kHalf, is_right, {}});
  return spans;
}

std::optional<Vec3> place_in(const json& span, const char* key) {
  const auto at = span.find(key);
  if (at == span.end() || !at->is_array() || at->size() != 3) return std::nullopt;
  Vec3 place;
  for (int i = 0; i < 3; ++i) {
    if (!(*at)[static_cast<std::size_t>(i)].is_number()) return std::nullopt;
    place[i] = (*at)[static_cast<std::size_t>(i)].get<double>();
  }
  return place;
}

std::optional<JudgedSpan> span_in(const json& object) {
  if (!object.is_object()) return std::nullopt;
  const auto name = object.find("name"), sigma = object.find("sigma_mm");
  const auto from = place_in(object, "from_mm"), to = place_in(object, "to_mm");
  const bool is_whole = name != object.end() && name->is_string() && sigma != object.end() &&
                        sigma->is_number() && from && to;
  if (!is_whole) return std::nullopt;
  for (JawSpan span : named_spans()) {
    if (name_of(span) != name->get_ref<const std::string&>()) continue;
    span.ends = {*from, *to};
    return JudgedSpan{span, sigma->get<double>()};
  }
  return std::nullopt;
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<JudgedSpan>& spans) {
  const auto place = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const JudgedSpan& judged : spans) {
    const refinement::Span& ends = judged.span.ends;
    list.push_back({{"name", name_of(judged.span)},
                    {"length_mm", ends.length_mm()},
                    {"sigma_mm", judged.sigma_mm},
                    {"from_mm", place(ends.from_mm)},
                    {"to_mm", place(ends.to_mm)}});
  }
  return list;
}

std::vector<JudgedSpan> spans_in(std::string_view summary_json) {
  const json summary = json::parse(summary_json, nullptr, false);
  std::vector<JudgedSpan> spans;
  if (!summary.is_object() || !summary.contains(kDistancesKey)) return spans;
  for (const json& object : summary[kDistancesKey]) {
    if (auto span = span_in(object)) spans.push_back(*span);
  }
  return spans;
}

}  // namespace flytri::report
