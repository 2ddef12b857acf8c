/// @file  A case on disk: a patient's scans as they come, what was made of them, and all of it
/// again after the program or the power went away.
///
/// One SQLite database a case; docs/formats.md lists what is in it. Whoever commits at least each
/// second loses at most the last second when the process is killed.
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
#include "core/editing/edits.h"
#include "core/geometry/view.h"
#include "core/imaging/frame.h"

namespace flytri::io {

/// What is scanned in one go. Each stage has a world frame of its own.
enum class ScanStage { kUpper, kLower, kBite };
inline constexpr std::array kScanStages = {ScanStage::kUpper, ScanStage::kLower, ScanStage::kBite};
/// "upper", "lower", "bite".
[[nodiscard]] std::string_view to_string(ScanStage stage);

/// Who and what the case is about. Any text, as the user entered it.
struct CaseFields {
  std::string patient_name;
  std::string patient_id;
  std::string birth_date;  ///< ISO 8601: 2026-11-21
  std::string clinician;
  std::string notes;
  std::string created;  ///< ISO 8601, UTC
  bool operator==(const CaseFields&) const = default;
};

/// One frame that was offered, and what became of it.
struct StoredFrame {
  FrameIndex frame;
  double time_s = 0.0;
  FrameKind kind = FrameKind::kUnknown;
  std::string fate;    ///< in the pipeline's words: registered, interpolated, textured, rejected
  std::string reason;  ///< of a rejection
  bool operator==(const StoredFrame&) const = default;
};

/// A distance that the user measured.
struct Measurement {
  std::int64_t id = 0;                                ///< given by the case
  Vec3 from_mm = Vec3::Zero(), to_mm = Vec3::Zero();  ///< world frame of the stage
  std::string label;
};

/// A measured view, and where it was placed if it was.
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
  std::optional<ResultBasis> made_of;
};

/// All of a stage that a scan needs to go on, and a reconstruction to start.
struct StoredStage {
  std::vector<StoredView> views;      ///< by rising frame index
  std::vector<Frame> texture_frames;  ///< by rising frame index
  std::vector<StoredFrame> frames;    ///< by rising frame index
  editing::EditStack edits;           ///< with what can be undone and redone
  std::vector<Measurement> measurements;
  std::vector<std::string> damage;  ///< what could not be read, one entry a record or a gap
};

/// How much of a stage there is, without reading it.
struct StageCounts {
  std::int64_t views = 0;
  std::int64_t texture_frames = 0;
  std::int64_t measurements = 0;
  bool has_result = false;
};

/// The basis of a model that is made of a stage now.
[[nodiscard]] ResultBasis basis_of(const StageCounts& counts, const editing::EditList& edits);

struct CaseOptions {
  /// Empty: not encrypted. A case that is not encrypted opens with any passphrase.
  std::string passphrase;
  /// Neither the file nor its folder is changed.
  bool read_only = false;
  /// Default 256 MiB, about two minutes of views. Bound on the records that wait in memory because
  /// they could not be written.
  std::size_t max_waiting_bytes = std::size_t{256} << 20U;
};

class CaseRecords;

/// An open case. Use it from one thread at a time. While a program has it open for writing, no
/// other program can open it.
///
/// Writes collect in a transaction until commit(). Without a commit() they are dropped when the
/// object is destroyed. A write that fails is not dropped: the record waits in memory, and the next
/// write or commit() tries it again. So after a full disk nothing needs to be written twice; free
/// some space and call commit(). If more records wait than CaseOptions::max_waiting_bytes allow,
/// further writes are refused with kInsufficient, and these records are lost.
/// A case that turns out to be damaged is read-only from then on.
/// @errors  All functions that write: kWriteFailed (disk full, failing device; the record waits),
///          kNotPermitted (read-only, or locked by another program), kInsufficient (too many
///          records wait).
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
  /// Opens a case. A damaged one is opened read-only, see damage().
  /// @errors  kNotFound; kNotPermitted (permissions, or another program has it open); kInconsistent
  ///          (encrypted, and the passphrase is wrong or missing); kBadFormat (no case, of a newer
  ///          version, or damaged beyond reading).
  [[nodiscard]] static Result<CaseFile> open(const std::filesystem::path& path,
                                             const CaseOptions& options = {});
  CaseFile(CaseFile&&) noexcept;
  CaseFile& operator=(CaseFile&&) noexcept;
  ~CaseFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] bool is_read_only() const;
  /// True if records wait in memory because they could not be written.
  [[nodiscard]] bool has_waiting() const;
  /// What was found damaged when the case was opened; each stage has a list of its own.
  [[nodiscard]] const std::vector<std::string>& damage() const;

  [[nodiscard]] Result<CaseFields> fields();
  [[nodiscard]] Result<void> write_fields(const CaseFields& fields);
  /// The JSON text of the calibration that all views of the case were measured with.
  /// @errors  Also kInsufficient: there is none.
  [[nodiscard]] Result<std::string> calibration();
  [[nodiscard]] Result<void> write_calibration(std::string_view json);

  /// Keeps a view under its frame index.
  /// @errors  Also kInconsistent: the stage has a view of that frame already.
  [[nodiscard]] Result<void> append_view(ScanStage stage, const View& view);
  /// Keeps a texture frame, packed without loss.
  /// @errors  As append_view and encode_png.
  [[nodiscard]] Result<void> append_texture(ScanStage stage, const Frame& frame);
  /// What became of frames; what was said of the same frames before is replaced.
  [[nodiscard]] Result<void> write_frames(ScanStage stage, std::span<const StoredFrame> frames);
  /// Poses of kept views; those of the same views are replaced, others stay.
  [[nodiscard]] Result<void> write_poses(ScanStage stage, std::span<const AlignedView> views);
  /// Takes the poses of views back, as when they turned out to contradict the others.
  [[nodiscard]] Result<void> erase_poses(ScanStage stage, std::span<const FrameIndex> frames);
  /// All states of the edits, and the one that holds.
  [[nodiscard]] Result<void> write_edits(ScanStage stage, const editing::EditStack& edits);
  /// Keeps a measurement; its id is chosen here and returned.
  [[nodiscard]] Result<std::int64_t> add_measurement(ScanStage stage,
                                                     const Measurement& measurement);
  /// Nothing happens if there is none of that id.
  [[nodiscard]] Result<void> remove_measurement(std::int64_t id);
  /// Replaces the result of the stage.
  [[nodiscard]] Result<void> write_result(ScanStage stage, const StageResult& result);
  /// Forgets all of a stage but the case's fields: it is to be scanned anew.
  [[nodiscard]] Result<void> clear_stage(ScanStage stage);
  /// Saves all writes since the last commit, so that they survive the end of the process. A power
  /// failure may cost more, back to the last checkpoint of the log (every 8 MiB), but the case stays
  /// consistent.
  [[nodiscard]] Result<void> commit();

  [[nodiscard]] Result<StageCounts> counts(ScanStage stage);
  /// Everything of a stage that can be read; what cannot is named in its list of damage.
  [[nodiscard]] Result<StoredStage> load_stage(ScanStage stage);
  /// @errors  Also kInsufficient: the stage has no result.
  [[nodiscard]] Result<StageResult> load_result(ScanStage stage);

 private:
  CaseFile(std::filesystem::path path, std::unique_ptr<CaseRecords> records);

  std::filesystem::path path_;
  std::unique_ptr<CaseRecords> records_;
};

}  // namespace flytri::io
