#include "core/scan/finishing_thread.h"

#include <utility>

#include "core/base/free_memory.h"

namespace flytri::scan {

void FinishingThread::expect_run() {
  const std::lock_guard lock(mutex_);
  progress_ = Progress();
  step_.clear();
}

Progress FinishingThread::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void FinishingThread::run(Collect collect, Done done) {
  thread_.post([this, collect = std::move(collect), done = std::move(done)] {
    const Progress progress = this->progress();
    StageClock clock(now_s_);
    Result<reconstruct::FinishedScan> finished =
        reconstruct::finish_scan(collect(progress), options_, Workers(), progress, clock);
    release_free_memory();
    done(std::move(finished));
  });
}

FinishingState FinishingThread::state() {
  constexpr double kTelling = 0.05;  // an earlier guess would jump about
  const std::lock_guard lock(mutex_);
  const Progress::Snapshot step = progress_.snapshot();
  if (step.stage != step_) {
    step_ = step.stage;
    step_since_s_ = now_s_();
  }
  const double spent_s = now_s_() - step_since_s_;
  const double remaining_s =
      step.fraction > kTelling ? spent_s * (1.0 - step.fraction) / step.fraction : -1.0;
  return {step, remaining_s};
}

void FinishingThread::stop() {
  cancel();
  thread_.stop();
}

}  // namespace flytri::scan
