#include "ui/gpu/frame_timer.h"

namespace flytri::ui {

void delete_query(GLuint name) { glDeleteQueries(1, &name); }

FrameTimer::FrameTimer() {
  for (Piece& piece : pieces_) {
    GLuint name = 0;
    glGenQueries(1, &name);
    piece.query = GlObject<delete_query>(name);
  }
}

void FrameTimer::begin() {
  // With all pieces under way this one goes unmeasured.
  is_open_ = waiting_ < pieces_.size();
  if (!is_open_) return;
  glBeginQuery(GL_TIME_ELAPSED, pieces_[next_].query.name());
  began_ = std::chrono::steady_clock::now();
}

void FrameTimer::end(std::size_t amount) {
  if (!is_open_) return;
  glEndQuery(GL_TIME_ELAPSED);
  Piece& piece = pieces_[next_];
  piece.amount = amount;
  piece.handed_over_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_).count();
  next_ = (next_ + 1) % pieces_.size();
  ++waiting_;
  is_open_ = false;
}

std::optional<TimedWork> FrameTimer::take() {
  if (waiting_ == 0) return std::nullopt;
  const Piece& oldest = pieces_[(next_ + pieces_.size() - waiting_) % pieces_.size()];
  GLuint is_ready = GL_FALSE;
  glGetQueryObjectuiv(oldest.query.name(), GL_QUERY_RESULT_AVAILABLE, &is_ready);
  if (is_ready == GL_FALSE) return std::nullopt;
  GLuint64 drawing_ns = 0;
  glGetQueryObjectui64v(oldest.query.name(), GL_QUERY_RESULT, &drawing_ns);
  --waiting_;
  return TimedWork{oldest.amount, oldest.handed_over_ms + 1e-6 * static_cast<double>(drawing_ns)};
}

}  // namespace flytri::ui
