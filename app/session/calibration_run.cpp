#include "app/session/calibration_run.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "core/localization/localize.h"
#include "core/localization/outline.h"
#include "hw/shots/guided_session.h"

namespace flytri::session {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Shortest rest between two live images. After a slow one, the thread rests as long as it took.
constexpr std::chrono::milliseconds kRest{30};

/// Prepares an image for the window, with the lines found in it.
std::shared_ptr<const scan::LiveFrame> shown_frame(cv::Mat image, calibration::ShotKind kind) {
  auto shown = std::make_shared<scan::LiveFrame>();
  shown->frame.image = std::move(image);
  if (kind != calibration::ShotKind::kVertical) return shown;
  shown->frame.kind = FrameKind::kVertical;
  const auto traces = localization::localize_lines(shown->frame.image, Pattern::kVertical, {});
  if (!traces) return shown;
  for (const localization::LineTrace& trace : *traces) {
    shown->lines.push_back(localization::outline_of(trace, Pattern::kVertical));
  }
  return shown;
}

}  // namespace

CalibrationRun::CalibrationRun(CalibrationJob job) : job_(std::move(job)) {
  state_.task = job_.task;
  state_.folder = job_.folder.string();
  thread_.post([this] { open(); });
}

CalibrationRun::~CalibrationRun() {
  progress_.cancel();
  thread_.stop();
  if (source_ != nullptr) source_->stop();
}

ui::RunningCalibration CalibrationRun::state() const {
  const std::lock_guard lock(mutex_);
  ui::RunningCalibration state = state_;
  state.computed_share = progress_.snapshot().fraction;
  return state;
}

void CalibrationRun::change(const std::function<void(ui::RunningCalibration&)>& change) {
  const std::lock_guard lock(mutex_);
  change(state_);
}

void CalibrationRun::take() {
  const std::lock_guard lock(mutex_);
  if (state_.step != ui::CalibrationStep::kTarget || is_asked_) return;
  is_asked_ = true;
  state_.shots.clear();
  state_.message.clear();
  state_.step = ui::CalibrationStep::kTaking;
  thread_.post([this] { take_images(); });
}

void CalibrationRun::retake(std::size_t place) {
  const std::lock_guard lock(mutex_);
  const bool waits =
      state_.step == ui::CalibrationStep::kTarget || state_.step == ui::CalibrationStep::kRefused;
  if (!waits || is_asked_ || place >= state_.places.size() || !state_.places[place].is_done) return;
  is_asked_ = true;
  thread_.post([this, place] { reopen(place); });
}

void CalibrationRun::open() {
  auto source = job_.open_source();
  if (!source) return fail(source.error());
  source_ = *std::move(source);
  auto work = job_.begin_work(source_);
  if (!work) return fail(work.error());
  work_ = *std::move(work);
  if (auto started = source_->start(); !started) return fail(started.error());
  go_on();
  thread_.post([this] { look(); });
}

void CalibrationRun::go_on() {
  change([this](ui::RunningCalibration& state) {
    is_asked_ = false;
    state.places = work_->places();
    state.wanted = work_->wanted();
    state.step = state.wanted ? ui::CalibrationStep::kTarget : ui::CalibrationStep::kComputing;
  });
  if (!work_->wanted()) conclude();
}

/// Shows the camera's image again and again, while the user puts the target into place.
void CalibrationRun::look() {
  if (progress_.cancelled()) return;
  const ui::CalibrationStep step = state().step;
  if (step == ui::CalibrationStep::kDone || step == ui::CalibrationStep::kFailed) return;
  const auto begun = SteadyClock::now();
  if (step == ui::CalibrationStep::kTarget) {
    const CalibrationWork::Look wanted = work_->look();
    auto image = source_->look(wanted.kind, wanted.z_mm, progress_);
    if (!image) return fail(image.error());
    auto shown = shown_frame(*std::move(image), wanted.kind);
    change([&](ui::RunningCalibration& state) { state.image = std::move(shown); });
  }
  std::this_thread::sleep_for(std::max<SteadyClock::duration>(kRest, SteadyClock::now() - begun));
  thread_.post([this] { look(); });
}

void CalibrationRun::take_images() {
  const auto tell = [this](ui::JudgedShot shot) {
    change([&](ui::RunningCalibration& state) { state.shots.push_back(std::move(shot)); });
  };
  if (auto taken = work_->take(tell, progress_); !taken) return fail(taken.error());
  go_on();
}

void CalibrationRun::reopen(std::size_t place) {
  if (auto reopened = work_->reopen(place); !reopened) return fail(reopened.error());
  change([](ui::RunningCalibration& state) {
    state.shots.clear();
    state.message.clear();
  });
  go_on();
}

void CalibrationRun::conclude() {
  auto outcome = work_->conclude(progress_);
  if (!outcome && !shots::is_refusal(outcome.error())) return fail(outcome.error());
  if (outcome) source_->stop();
  change([&](ui::RunningCalibration& state) {
    state.shots.clear();
    if (outcome) {
      state.outcome = *std::move(outcome);
      state.step = ui::CalibrationStep::kDone;
    } else {
      state.message = outcome.error().message;
      state.step = ui::CalibrationStep::kRefused;
    }
  });
}

void CalibrationRun::fail(const Error& error) {
  if (source_ != nullptr) source_->stop();
  change([&](ui::RunningCalibration& state) {
    is_asked_ = false;
    state.message = error.message;
    state.step = ui::CalibrationStep::kFailed;
  });
}

}  // namespace flytri::session
