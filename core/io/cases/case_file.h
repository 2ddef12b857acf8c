/// @file  A case on disk: the scans of a patient as they come, and the models made of them. They
/// survive a crash of the program or a power failure.
///
/// Each case is one SQLite database; docs/formats.md lists its contents. A program that commits
/// every second loses at most the last second when it is killed.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/secret.h"
#include "core/editing/edits.h"
#include "core/editing/held_surface.h"
#include "core/geometry/jaw_axes.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"
#include "core/io/cases/scan_stage.h"
#include "core/review/margin.h"

namespace flytri::io {

/// What the user entered about the case. Any text is allowed.
struct CaseFields {
  std::string patient_name;
  std::string patient_id;
  std::string birth_date;  ///< ISO 8601: 2026-11-21
  std::string clinician;
  std::string notes;
  std::string created;  ///< ISO 8601, UTC
  bool operator==(const CaseFields&) const = default;
};

/// An offered frame and its fate.
struct StoredFrame {
  FrameIndex frame;
  double time_s = 0.0;
  FrameKind kind = FrameKind::kUnknown;
  std::string fate;    ///< registered, interpolated, textured or rejected
  std::string reason;  ///< of a rejection
  bool operator==(const StoredFrame&) const = default;
};

/// A distance that the user measured.
struct Measurement {
  std::int64_t id = 0;                                ///< chosen by the case
  Vec3 from_mm = Vec3::Zero(), to_mm = Vec3::Zero();  ///< world frame of the stage
  std::string label;
};

/// A margin line that the user drew on the finished model.
struct StoredMargin {
  std::int64_t id = 0;          ///< chosen by the case
  std::vector<Vec3> clicks_mm;  ///< that it was found from, in order; world frame of the stage
  review::Margin margin;        ///< world frame of the stage
};

/// A measured view, with its pose if it was registered.
struct StoredView {
  std::shared_ptr<const View> view;
  std::optional<Isometry> T_world_sensor;
};

/// The state of a stage that a model was made from. A model is current while the stage is still in
/// that state.
struct ResultBasis {
  std::int64_t view_count = 0;
  std::vector<double> edited_at_s;  ///< times of the edits that apply
  bool operator==(const ResultBasis&) const = default;
};

/// A finished model.
struct StageResult {
  std::string glb;           ///< the bytes of a .glb, see encode_glb
  std::string summary_json;  ///< a JSON object about the model, or empty
  /// Kept in the summary under "made_of". None: the model is not known to be current, and the
  /// window does not show it.
  std::optional<ResultBasis> made_of = std::nullopt;
  /// Its surface, for the next run; see StoredStage. Only written with the model.
  std::shared_ptr<const editing::HeldSurface> held = nullptr;
};

/// All of a stage that is needed to continue its scan or to reconstruct it.
struct StoredStage {
  std::vector<StoredView> views;      ///< by rising frame index
  std::vector<Frame> texture_frames;  ///< by rising frame index
  std::vector<StoredFrame> frames;    ///< by rising frame index
  editing::EditStack edits;           ///< including what can be undone and redone
  std::vector<Measurement> measurements;
  std::optional<OcclusalPoints> plane;  ///< that the user has set
  std::vector<StoredMargin> margins;
  /// The surface of the finished model, also if the stage has changed since: what is locked of it
  /// stays. Null: there is none.
  std::shared_ptr<const editing::HeldSurface> held;
  /// The largest frame index in the stage, also of a scan that was cleared; -1: none. New frames
  /// come after it.
  FrameIndex last_frame{-1};
  std::vector<std::string> damage;  ///< what could not be read, an entry for each record or gap
};

/// The size of a stage, without reading it.
struct StageCounts {
  std::int64_t views = 0;
  std::int64_t texture_frames = 0;
  std::int64_t measurements = 0;
  bool has_result = false;
  bool operator==(const StageCounts&) const = default;
};

/// What of a case can be read, and what cannot.
struct CaseSurvey {
  std::array<StageCounts, kScanStages.size()> readable;
  std::vector<std::string> lost;  ///< an entry for each record or gap, and where it is
};

/// The basis of a model that is made of a stage now.
[[nodiscard]] ResultBasis basis_of(const StageCounts& counts, const editing::EditList& edits);
/// Whether a model is that of a stage as it is now. Views that were lost since are in the model.
[[nodiscard]] bool is_made_of(const ResultBasis& made_of, const StageCounts& counts,
                              const StoredStage& stored);

struct CaseOptions {
  /// Empty: not encrypted. A case that is not encrypted opens with any passphrase.
  Secret passphrase;
  /// Neither the file nor its folder is changed.
  bool read_only = false;
  /// Default 256 MiB, about two minutes of views. Bound on the records that wait in memory because
  /// they could not be written.
  std::size_t max_waiting_bytes = std::size_t{256} << 20U;
};

struct CaseEvent;
struct CaseJournal;
class CaseRecords;
class StageScans;

/// An open case. Use it from one thread at a time. While a program has it open for writing, no
/// other program can open it.
///
/// Writes collect in a transaction until commit(). Without a commit() they are dropped when the
/// object is destroyed. A write that fails is not dropped: its record waits in memory, and so do
/// all later ones, until a commit() succeeds. So after a full disk nothing needs to be written
/// twice; free some space and call commit(). If more records wait than
/// CaseOptions::max_waiting_bytes allow, further writes are refused with kInsufficient, and these
/// records are lost. A case that turns out to be damaged is read-only from then on: what is written
/// waits as well, and goes into a rescue copy.
/// @errors  All functions that write: kWriteFailed (disk full, failing device; the record waits),
///          kNotPermitted (read-only, damaged, or locked by another program), kBadFormat (it was
///          found damaged; the record waits), kInsufficient (too many records wait).
/// @errors  All functions that read: kBadFormat (nothing there can be read).
class CaseFile {
 public:
  /// Creates a case; only its owner may read the file. On failure no file is left.
  /// @param calibration_json  see write_calibration(); empty: the case gets none yet
  /// @errors  As write_file; kBadOption: the file exists already, or the options say read-only.
  [[nodiscard]] static Result<CaseFile> create(const std::filesystem::path& path,
                                               const CaseOptions& options,
                                               const CaseFields& fields = {},
                                               std::string_view calibration_json = {});
  /// Opens a case. If it is damaged, it is opened read-only, see damage().
  /// @errors  kNotFound; kNotPermitted (permissions, or another program has it open); kInconsistent
  ///          (encrypted, and the passphrase is wrong or missing); kBadFormat (not a case, of a
  ///          newer version, or too damaged to be read).
  [[nodiscard]] static Result<CaseFile> open(const std::filesystem::path& path,
                                             const CaseOptions& options = {});
  CaseFile(CaseFile&&) noexcept;
  CaseFile& operator=(CaseFile&&) noexcept;
  ~CaseFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// That the case is encrypted with; empty: it is not.
  [[nodiscard]] const Secret& passphrase() const;
  [[nodiscard]] bool is_read_only() const;
  /// True if records wait in memory because they could not be written.
  [[nodiscard]] bool has_waiting() const;
  /// True if damage was found, when the case was opened or since.
  [[nodiscard]] bool is_damaged() const;
  /// The damage found when the case was opened. Each stage has its own list.
  [[nodiscard]] const std::vector<std::string>& damage() const;

  [[nodiscard]] Result<CaseFields> fields();
  [[nodiscard]] Result<void> write_fields(const CaseFields& fields);
  /// The calibration, as JSON, with which the views of the case were measured.
  /// @errors  Also kInsufficient: the case has none.
  [[nodiscard]] Result<std::string> calibration();
  [[nodiscard]] Result<void> write_calibration(std::string_view json);

  /// Adds a view under its frame index.
  /// @errors  Also kInconsistent: the stage already has a view of that frame.
  [[nodiscard]] Result<void> append_view(ScanStage stage, const View& view);
  /// Adds a texture frame, compressed without loss.
  /// @errors  As append_view and encode_png.
  [[nodiscard]] Result<void> append_texture(ScanStage stage, const Frame& frame);
  /// Writes the fates of frames, and replaces earlier fates of the same frames.
  [[nodiscard]] Result<void> write_frames(ScanStage stage, std::span<const StoredFrame> frames);
  /// Writes the poses of views, and replaces earlier poses of the same views.
  [[nodiscard]] Result<void> write_poses(ScanStage stage, std::span<const AlignedView> views);
  /// Erases the poses of views, for instance if these contradict the other views.
  [[nodiscard]] Result<void> erase_poses(ScanStage stage, std::span<const FrameIndex> frames);
  /// Writes all edits, and how many of them apply.
  [[nodiscard]] Result<void> write_edits(ScanStage stage, const editing::EditStack& edits);
  /// Adds a measurement, chooses its id and returns it.
  [[nodiscard]] Result<std::int64_t> add_measurement(ScanStage stage,
                                                     const Measurement& measurement);
  /// Does nothing if there is no measurement with this id.
  [[nodiscard]] Result<void> remove_measurement(std::int64_t id);
  /// Keeps the occlusal plane that the user has set. None: it is found by itself.
  /// @errors  Also kBadOption: a coordinate is not finite.
  [[nodiscard]] Result<void> write_plane(ScanStage stage,
                                         const std::optional<OcclusalPoints>& points);
  /// Adds a margin line, chooses its id and returns it.
  /// @errors  Also kBadOption: fewer than three clicks, no points, or numbers that are not finite.
  [[nodiscard]] Result<std::int64_t> add_margin(ScanStage stage, const StoredMargin& margin);
  /// Replaces the margin line with the same id.
  /// @errors  As add_margin.
  [[nodiscard]] Result<void> replace_margin(const StoredMargin& margin);
  /// Does nothing if there is no margin line with this id.
  [[nodiscard]] Result<void> remove_margin(std::int64_t id);
  /// Replaces the result of the stage.
  [[nodiscard]] Result<void> write_result(ScanStage stage, const StageResult& result);
  /// Empties a stage, so that it can be scanned again. What was in it is kept until the stage is
  /// cleared once more; what was kept so far is erased. Does nothing if the stage is empty.
  [[nodiscard]] Result<void> clear_stage(ScanStage stage);
  /// Shows what was kept when the stage was cleared, and keeps what was shown in its place.
  /// @errors  Also kInsufficient: nothing is kept.
  [[nodiscard]] Result<void> bring_back_stage(ScanStage stage);
  /// Starts an empty stage as a copy of another scan of the same jaw: its views, poses, texture
  /// frames, edits and distances, and so in its frame. Commits. After a failure the stage is still
  /// empty. What it keeps of a scan that was cleared stays. Locks hold the surface of the former
  /// model in the copy, too.
  /// @param with_model  the finished model, too
  /// @errors  Also kBadOption: not of the same jaw; kInsufficient: `from` is empty; kInconsistent:
  ///          `to` is not; kBadFormat: `from` is damaged.
  [[nodiscard]] Result<void> copy_stage(ScanStage from, ScanStage to, bool with_model);
  /// Adds an entry to the journal, see case_journal.h.
  [[nodiscard]] Result<void> add_event(const CaseEvent& event);
  /// Saves all writes since the last commit, so that they survive the end of the process. A power
  /// failure may cost more, back to the last checkpoint of the log (every 8 MiB), but the case
  /// stays consistent.
  [[nodiscard]] Result<void> commit();
  /// Commits, and moves the case to another file, which may be encrypted. On failure the case stays
  /// where it is, and no other file is left.
  /// @errors  As create; kBadFormat: a record is damaged.
  [[nodiscard]] Result<void> move_to(const std::filesystem::path& path, const CaseOptions& options);

  /// Reads everything, which takes as long as a copy.
  [[nodiscard]] Result<CaseSurvey> survey();
  /// Writes all that can be read, and what waits to be written, to a new case with the same
  /// passphrase. This case stays as it is. On failure no file is left.
  /// @errors  As create.
  [[nodiscard]] Result<CaseSurvey> rescue_to(const std::filesystem::path& path);

  [[nodiscard]] Result<StageCounts> counts(ScanStage stage);
  /// What bring_back_stage() would show.
  [[nodiscard]] Result<StageCounts> kept_counts(ScanStage stage);
  /// Loads everything of a stage that can be read. Its list of damage names the rest.
  [[nodiscard]] Result<StoredStage> load_stage(ScanStage stage);
  /// None: the user has set no occlusal plane.
  [[nodiscard]] Result<std::optional<OcclusalPoints>> plane(ScanStage stage);
  /// The margin lines of a stage, without all that is damaged.
  [[nodiscard]] Result<std::vector<StoredMargin>> load_margins(ScanStage stage);
  /// @errors  Also kInsufficient: the stage has no result.
  [[nodiscard]] Result<StageResult> load_result(ScanStage stage);
  /// Empty for a case of version 1 that is open read-only.
  [[nodiscard]] Result<CaseJournal> journal();

 private:
  CaseFile(std::filesystem::path path, std::unique_ptr<CaseRecords> records);
  [[nodiscard]] Result<CaseSurvey> rescue(CaseRecords* target);
  [[nodiscard]] StageScans& scans_of(ScanStage stage);
  [[nodiscard]] Result<StageCounts> counts_of(ScanStage stage, int scan);
  [[nodiscard]] Result<FrameIndex> last_frame(ScanStage stage);
  [[nodiscard]] Result<void> turn_stage(ScanStage stage);
  [[nodiscard]] Result<void> check_copy(ScanStage from, ScanStage to);

  std::filesystem::path path_;
  std::unique_ptr<CaseRecords> records_;
  std::vector<StageScans> scans_;  ///< of each stage
};

/// Removes the file of a case, and those that SQLite keeps beside it. Does nothing if there is
/// none.
void remove_case(const std::filesystem::path& path);

}  // namespace flytri::io
