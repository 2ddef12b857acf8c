#include "core/io/cases/case_journal.h"

#include <algorithm>
#include <limits>

#include "core/io/cases/case_records.h"
#include "core/io/files/json_place.h"

namespace flytri::io {
namespace {

constexpr RecordRange kAllEvents = {1, std::numeric_limits<int>::max()};

/// Bytes that are not UTF-8, as a file's name may have, are replaced.
std::string encode_event(const CaseEvent& event) {
  nlohmann::json json = {{"action", to_string(event.action)},
                         {"time", event.time},
                         {"user", event.user},
                         {"host", event.host},
                         {"program", event.program}};
  if (event.stage) json["stage"] = to_string(*event.stage);
  if (event.from) json["from"] = to_string(*event.from);
  if (!event.files.empty()) json["files"] = event.files;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The one of `values` with this name. Rejects other names.
template <typename Values>
auto named(const Values& values, const JsonPlace& place) {
  const std::string name = place.text();
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const auto& value) { return to_string(value) == name; });
  if (found != values.end()) return *found;
  place.reject("the name of an action or a stage");
  return values.front();
}

Result<CaseEvent> decode_event(std::string_view bytes) {
  const Result<JsonPlace> json = JsonPlace::parse(bytes, "damaged");
  if (!json) return tl::unexpected(json.error());
  CaseEvent event{named(kCaseActions, json->at("action")),
                  json->at("time").text(),
                  json->at("user").text(),
                  json->at("host").text(),
                  json->at("program").text(),
                  std::nullopt,
                  {}};
  if (json->has("from")) event.from = named(kScanStages, json->at("from"));
  if (json->has("stage")) event.stage = named(kScanStages, json->at("stage"));
  if (json->has("files")) {
    for (const JsonPlace& file : json->at("files").elements()) event.files.push_back(file.text());
  }
  return json->outcome().map([&] { return event; });
}

}  // namespace

std::string_view to_string(CaseAction action) {
  constexpr std::array<std::string_view, kCaseActions.size()> kNames = {
      "created", "opened", "opened read-only", "exported", "computed", "moved", "copied"};
  return kNames[static_cast<std::size_t>(action)];
}

Result<void> CaseFile::add_event(const CaseEvent& event) {
  return records_->append(CaseTable::kEvents, kAllEvents, encode_event(event))
      .map([](std::int64_t) {});
}

Result<CaseJournal> CaseFile::journal() {
  CaseJournal journal;
  auto damage =
      records_->walk(CaseTable::kEvents, kAllEvents, [&](std::int64_t, std::string_view data) {
        return decode_event(data).map(
            [&](CaseEvent&& event) { journal.events.push_back(std::move(event)); });
      });
  if (!damage) return tl::unexpected(damage.error());
  journal.damage = *std::move(damage);
  return journal;
}

}  // namespace flytri::io
