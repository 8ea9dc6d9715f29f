#include "render/gl/timer.h"

#include "render/gl/extensions.h"

namespace render::gl {

Timer& Timer::operator=(Timer&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(timed_, other.timed_);
  return *this;
}

Timer::~Timer() {
  if (id_ != 0) extensions().delete_queries(1, &id_);
}

void Timer::start() {
  if (!extensions().has_timer()) return;
  if (id_ == 0) extensions().gen_queries(1, &id_);
  extensions().begin_query(GL_TIME_ELAPSED_EXT, id_);
}

void Timer::stop() {
  if (!extensions().has_timer()) return;
  extensions().end_query(GL_TIME_ELAPSED_EXT);
  timed_ = true;
}

std::optional<double> Timer::milliseconds() const {
  if (!timed_) return std::nullopt;
  GLuint64 nanoseconds = 0;
  extensions().query_result_u64(id_, GL_QUERY_RESULT_EXT, &nanoseconds);
  return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace render::gl
