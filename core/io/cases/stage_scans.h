/// @file  Which records of a stage are those of the scan that is shown, and which are those of one
/// that was cleared and is kept.
///
/// For the sources of core/io/cases only. A stage holds two scans at most, 0 and 1. The records of
/// a frame belong to the scan to which its number belongs; the numbers of all other records are
/// above kScanNumbers in scan 1. So to clear a stage changes one record, and moves none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_records.h"

namespace flytri::io {

/// Numbers of the records of scan 0 that belong to no frame; those of scan 1 follow.
inline constexpr int kScanNumbers = 1 << 29;
/// The number of the record that says which frames belong to which scan.
inline constexpr int kScansNumber = 1 << 30;
/// In the models, the number of the record with the surface, see encode_held_surface(). Programs
/// that do not know it pass it over.
inline constexpr int kHeldNumber = 1;
/// In the summaries, the number of the record with the occlusal plane that the user has set.
inline constexpr int kPlaneNumber = 1;
/// The numbers of margin lines begin here, in the table of summaries: programs that know none of
/// them pass them over.
inline constexpr int kFirstMargin = 2;
/// Both tables hold it: if one is damaged, the scans are not mixed up.
inline constexpr std::array kScansTables = {CaseTable::kEditCursors, CaseTable::kSummaries};

class StageScans {
 public:
  /// 0 or 1.
  [[nodiscard]] int shown() const { return starts_.back().scan; }
  [[nodiscard]] int kept() const { return 1 - shown(); }
  /// All frames from this one on belong to the scan that is shown.
  [[nodiscard]] int first_shown() const { return starts_.back().frame; }
  /// From this frame on, all frames belong to the other scan, which is shown from now on.
  void turn_at(int frame) { starts_.push_back({frame, kept()}); }

  /// The records of a table that belong to a scan.
  [[nodiscard]] std::vector<RecordRange> records_of(CaseTable table, ScanStage stage,
                                                    int scan) const;
  /// The id of a record of the shown scan that belongs to no frame.
  [[nodiscard]] std::int64_t shown_id(ScanStage stage, int number = 0) const;
  /// The margin lines of the shown scan.
  [[nodiscard]] RecordRange margins_of(ScanStage stage) const;

  /// A JSON object: `scans`, a list of pairs of first frame and scan.
  [[nodiscard]] std::string encode() const;
  /// @errors  kBadFormat.
  [[nodiscard]] static Result<StageScans> decode(std::string_view bytes);

 private:
  struct Start {
    int frame = 0, scan = 0;
  };
  std::vector<Start> starts_ = {{0, 0}};  ///< by rising frame; the first is 0
};

/// Whether a record is the surface of a model.
[[nodiscard]] bool is_held(CaseTable table, std::int64_t id);

/// Whether a record is a margin line.
[[nodiscard]] bool is_margin(CaseTable table, std::int64_t id);

/// Whether the records of a table belong to frames.
[[nodiscard]] bool is_by_frame(CaseTable table);

}  // namespace flytri::io
