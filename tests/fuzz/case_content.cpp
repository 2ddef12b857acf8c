/// @file  A case whose records hold anything, with checksums that fit: what is read of them becomes
/// the surface that the window shows. The input is a list of changes: u8 which table, u8 which of
/// its records, u16 where, u8 what.
#include <sqlcipher/sqlite3.h>
#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/cases/case_journal.h"
#include "core/io/files/byte_stream.h"
#include "core/io/files/file_bytes.h"
#include "core/io/models/glb.h"
#include "core/live/live_surface.h"
#include "core/reconstruct/finish_scan.h"
#include "tests/fuzz/scratch.h"

namespace flytri {
namespace {

constexpr io::ScanStage kStage = io::ScanStage::kUpper;
constexpr int kViews = 6;
constexpr std::array<const char*, 11> kTables = {
    "fields", "calibration",  "views",        "textures", "frames",   "poses",
    "edits",  "edit_cursors", "measurements", "models",   "summaries"};

View small_view(int frame) {
  Profile profile{LineIndex(frame), Vec3::UnitX(), {}};
  for (int i = 0; i < 40; ++i) {
    profile.points.push_back({{0.1 * i, 0.05 * frame, 1.0}, Vec3f::Constant(0.01F), 1.0F * i});
  }
  return {frame % 2 == 0 ? Pattern::kVertical : Pattern::kHorizontal,
          FrameIndex(frame),
          frame / 30.0,
          {profile}};
}

std::string small_model() {
  TexturedMesh model;
  for (const Vec3f& corner : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}) {
    model.mesh.vertices.emplace_back();
    model.mesh.vertices.back().position_mm = corner;
    model.mesh.vertices.back().normal = Vec3f::UnitZ();
  }
  model.mesh.triangles = {{0, 1, 2}};
  model.uv = {{0, 0}, {1, 0}, {0, 1}};
  model.atlas = cv::Mat(4, 4, CV_8UC3, cv::Scalar(1, 2, 3));
  return io::encode_glb(model, "fuzz").value();
}

bool fill(io::CaseFile& file) {
  editing::EditStack edits;
  edits.push({editing::EditKind::kTrim, 1.0, {editing::BrushDab{}}});
  bool done = file.write_edits(kStage, edits) && file.write_calibration("{}") &&
              file.write_result(kStage, {small_model(), "{\"views\": 1}"}) &&
              file.add_measurement(kStage, {}) &&
              file.append_texture(kStage, {FrameIndex(kViews), FrameKind::kTexture, 1.0,
                                           cv::Mat(6, 8, CV_8UC3, cv::Scalar(1, 2, 3))});
  for (int i = 0; i < kViews; ++i) {
    const auto view = std::make_shared<const View>(small_view(i));
    done = done && file.append_view(kStage, *view) &&
           file.write_poses(kStage, std::array{AlignedView{view, Isometry::Identity()}});
  }
  return done && file.commit();
}

std::string whole_case(const std::filesystem::path& path) {
  {
    auto file = io::CaseFile::create(path, {}, {"a", "b", "", "", "", ""});
    if (!file || !fill(*file)) std::abort();
  }
  return io::read_file(path).value();
}

std::int64_t checksum_of(std::int64_t id, const std::string& data) {
  const uLong head = crc32_z(0, reinterpret_cast<const Bytef*>(&id), sizeof(id));
  return static_cast<std::int64_t>(
      crc32_z(head, reinterpret_cast<const Bytef*>(data.data()), data.size()));
}

/// Writes another byte into a record, or behind its end.
void change(sqlite3* database, const char* table, int row, std::size_t at, char value) {
  const std::string select =
      std::string("SELECT id, data FROM ") + table + " LIMIT 1 OFFSET " + std::to_string(row);
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, select.c_str(), -1, &statement, nullptr);
  if (sqlite3_step(statement) != SQLITE_ROW) {
    sqlite3_finalize(statement);
    return;
  }
  const std::int64_t id = sqlite3_column_int64(statement, 0);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, 1));
  std::string data(static_cast<const char*>(sqlite3_column_blob(statement, 1)), size);
  sqlite3_finalize(statement);
  data.resize(std::max(data.size(), std::min(at + 1, data.size() + 64)));
  data[at % data.size()] = value;
  const std::string update =
      std::string("UPDATE ") + table + " SET checksum = ?, data = ? WHERE id = ?";
  sqlite3_prepare_v2(database, update.c_str(), -1, &statement, nullptr);
  sqlite3_bind_int64(statement, 1, checksum_of(id, data));
  sqlite3_bind_blob(statement, 2, data.data(), static_cast<int>(data.size()), SQLITE_STATIC);
  sqlite3_bind_int64(statement, 3, id);
  sqlite3_step(statement);
  sqlite3_finalize(statement);
}

void change_records(const std::filesystem::path& path, std::string_view changes) {
  sqlite3* database = nullptr;
  if (sqlite3_open(path.c_str(), &database) != SQLITE_OK) std::abort();
  sqlite3_exec(database, "PRAGMA synchronous = OFF; BEGIN", nullptr, nullptr, nullptr);
  io::ByteReader reader(changes);
  for (;;) {
    const auto table = reader.number<std::uint8_t>();
    const auto row = reader.number<std::uint8_t>();
    const auto at = reader.number<std::uint16_t>();
    const auto value = reader.number<char>();
    if (!value) break;
    change(database, kTables[*table % kTables.size()], *row % kViews, *at, *value);
  }
  sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(database);
}

/// As the window shows it.
void show(const io::StoredStage& stage) {
  auto surface = live::LiveSurface::create();
  if (!surface) std::abort();
  for (const io::StoredView& stored : stage.views) {
    if (stored.T_world_sensor) (void)surface->add({stored.view, *stored.T_world_sensor});
  }
  surface->set_edits(stage.edits);
  surface->settle_edits();
  (void)surface->publish();
  (void)surface->points();
}

void open_and_show(const std::filesystem::path& path) {
  auto file = io::CaseFile::open(path);
  if (!file) std::abort();
  (void)file->fields();
  (void)file->calibration();
  (void)file->journal();
  const auto counts = file->counts(kStage);
  const auto stage = file->load_stage(kStage);
  if (stage) show(*stage);
  const auto result = file->load_result(kStage);
  if (!result) return;
  if (stage && counts) (void)(result->made_of == io::basis_of(*counts, stage->edits.state()));
  auto model = io::parse_glb(result->glb, "fuzz");
  if (model) (void)reconstruct::finished_scan_of(*std::move(model));
}

}  // namespace
}  // namespace flytri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const flytri::Scratch kScratch;
  static const std::string kWhole = flytri::whole_case(kScratch.file());
  const std::string_view changes(reinterpret_cast<const char*>(data), size);
  if (!flytri::io::write_file(kScratch.file(), kWhole)) std::abort();
  flytri::change_records(kScratch.file(), changes);
  flytri::open_and_show(kScratch.file());
  return 0;
}
