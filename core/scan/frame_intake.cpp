#include "core/scan/frame_intake.h"

#include <algorithm>
#include <utility>

namespace flytri::scan {

FrameIntake::Slot* FrameIntake::first_waiting() {
  const auto found = std::find_if(slots_.begin(), slots_.end(),
                                  [](const Slot& slot) { return slot.state == State::kWaiting; });
  return found == slots_.end() ? nullptr : &*found;
}

void FrameIntake::offer(Frame frame, double now_s) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    Slot slot{next_number_++,
              State::kWaiting,
              {std::move(frame), now_s, false, measurement::MeasuredView{}}};
    if (unfinished_ >= capacity_) {
      Slot* oldest = first_waiting();
      Slot& given_up = oldest != nullptr ? *oldest : slot;
      given_up.state = State::kDone;
      given_up.result.skipped = true;
      if (oldest != nullptr) --unfinished_;
    }
    if (slot.state == State::kWaiting) ++unfinished_;
    slots_.push_back(std::move(slot));
  }
  has_task_.notify_one();
  has_result_.notify_one();
}

std::optional<FrameIntake::Task> FrameIntake::take() {
  std::unique_lock lock(mutex_);
  Slot* slot = nullptr;
  has_task_.wait(lock, [&] { return closed_ || (slot = first_waiting()) != nullptr; });
  if (closed_) return std::nullopt;
  slot->state = State::kTaken;
  return Task{slot->number, slot->result.frame};
}

void FrameIntake::deliver(std::uint64_t number, Result<measurement::MeasuredView> measured) {
  {
    const std::lock_guard lock(mutex_);
    const auto slot = std::find_if(slots_.begin(), slots_.end(),
                                   [&](const Slot& s) { return s.number == number; });
    slot->state = State::kDone;
    slot->result.measured = std::move(measured);
  }
  has_result_.notify_one();
}

std::optional<IntakeResult> FrameIntake::next() {
  std::unique_lock lock(mutex_);
  const auto ready = [&] { return !slots_.empty() && slots_.front().state == State::kDone; };
  has_result_.wait(lock, [&] { return closed_ || woken_ || ready(); });
  woken_ = false;
  if (closed_ || !ready()) return std::nullopt;
  IntakeResult result = std::move(slots_.front().result);
  slots_.pop_front();
  if (!result.skipped) --unfinished_;
  return result;
}

std::size_t FrameIntake::backlog() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) {
    return slot.state == State::kDone && !slot.result.skipped;
  }));
}

void FrameIntake::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  has_result_.notify_one();
}

void FrameIntake::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  has_task_.notify_all();
  has_result_.notify_all();
}

}  // namespace flytri::scan
