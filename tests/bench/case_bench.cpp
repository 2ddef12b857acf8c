/// @file  Benchmarks of case files: writes views of 4500 points with a commit each second, measures
/// the size on disk, and reads everything back.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "core/io/cases/case_file.h"
#include "core/io/cases/view_codec.h"
#include "tests/support/case_samples.h"
#include "tests/support/temporary_folder.h"

namespace flytri {
namespace {

using testing::sample_pose;
using testing::sample_view;

constexpr io::ScanStage kStage = io::ScanStage::kUpper;
constexpr int kViewsPerCommit = 30;

/// Sample views, returned in turn with increasing numbers.
class Views {
 public:
  Views() {
    for (int i = 0; i < 20; ++i) views_.push_back(sample_view(i));
  }
  [[nodiscard]] const View& next() {
    View& view = views_[static_cast<std::size_t>(count_) % views_.size()];
    view.frame = FrameIndex(count_++);
    return view;
  }

 private:
  std::vector<View> views_;
  int count_ = 0;
};

io::CaseOptions options_of(const benchmark::State& state) {
  return {Secret(state.range(0) != 0 ? "passphrase" : ""), false};
}

/// Appends thirty views and commits them.
bool append_second(io::CaseFile& file, Views& views) {
  for (int i = 0; i < kViewsPerCommit; ++i) {
    if (!file.append_view(kStage, views.next())) return false;
  }
  return file.commit().has_value();
}

void append_views(benchmark::State& state) {
  const TemporaryFolder folder;
  const auto path = folder / "a.flytri";
  Views views;
  std::int64_t kept = 0;
  {
    auto file = io::CaseFile::create(path, options_of(state));
    for (auto _ : state) {
      if (!file || !append_second(*file, views)) state.SkipWithError("cannot be written");
      kept += kViewsPerCommit;
    }
  }
  state.SetItemsProcessed(kept);
  state.counters["bytes/view"] =
      static_cast<double>(std::filesystem::file_size(path)) / static_cast<double>(kept);
}
BENCHMARK(append_views)->ArgName("encrypted")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Writes all poses of a minute of scanning, as after a joint optimization.
void write_poses(benchmark::State& state) {
  const TemporaryFolder folder;
  auto file = io::CaseFile::create(folder / "a.flytri", options_of(state));
  std::vector<AlignedView> placed;
  for (int i = 0; i < 1800; ++i) {
    View view;
    view.frame = FrameIndex(i);
    placed.push_back({std::make_shared<const View>(view), sample_pose(i)});
  }
  for (auto _ : state) {
    if (!file->write_poses(kStage, placed) || !file->commit()) {
      state.SkipWithError("cannot be written");
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(placed.size()) * state.iterations());
}
BENCHMARK(write_poses)->ArgName("encrypted")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void load_stage(benchmark::State& state) {
  const TemporaryFolder folder;
  const auto path = folder / "a.flytri";
  {
    Views views;
    auto file = io::CaseFile::create(path, options_of(state));
    for (int second = 0; second < 10; ++second) (void)append_second(*file, views);
  }
  auto file = io::CaseFile::open(path, options_of(state));
  std::int64_t count = 0;
  for (auto _ : state) count += static_cast<std::int64_t>(file->load_stage(kStage)->views.size());
  state.SetItemsProcessed(count);
}
BENCHMARK(load_stage)->ArgName("encrypted")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Opens a case; with a passphrase, this includes the derivation of the key.
void open_case(benchmark::State& state) {
  const TemporaryFolder folder;
  const auto path = folder / "a.flytri";
  (void)io::CaseFile::create(path, options_of(state));
  for (auto _ : state) {
    if (!io::CaseFile::open(path, options_of(state))) state.SkipWithError("cannot be opened");
  }
}
BENCHMARK(open_case)->ArgName("encrypted")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void code_view(benchmark::State& state) {
  const View view = sample_view(0);
  std::string bytes;
  for (auto _ : state) {
    bytes = io::encode_view(view);
    benchmark::DoNotOptimize(bytes);
  }
  state.counters["bytes/view"] = static_cast<double>(bytes.size());
}
BENCHMARK(code_view)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flytri
