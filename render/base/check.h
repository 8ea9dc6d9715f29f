// CHECK(a <= b): the caller broke a function's contract. Prints both values, and where.
//
// It throws instead of aborting: the program closes what it was writing on its way out (recordings, reports), and tests
// look at what was said. It is meant for what would otherwise give a wrong number silently; user input is refused with
// an error that says what would be accepted, by the parser that reads it.

#ifndef SKYSHAFT_RENDER_BASE_CHECK_H
#define SKYSHAFT_RENDER_BASE_CHECK_H

#include <source_location>
#include <sstream>
#include <stdexcept>
#include <string>

namespace render::check {

// Throws std::logic_error: "FILE:LINE: FUNCTION: CHECK(WHAT) failed: VALUES".
[[noreturn]] inline void fail(const char* what, const std::string& values, const std::source_location& at) {
  std::ostringstream text;
  text << at.file_name() << ':' << at.line() << ": " << at.function_name() << ": CHECK(" << what << ") failed";
  if (!values.empty()) text << ": " << values;
  throw std::logic_error(text.str());
}

// How a comparison ended, and the values on both sides.
struct Outcome {
  bool holds = false;
  std::string values;
};

template <typename L>
class Left {
 public:
  explicit Left(const L& value) : value_(value) {}
  template <typename R>
  Outcome operator<=(const R& right) const {
    return compared(value_ <= right, "<=", right);
  }
  template <typename R>
  Outcome operator<(const R& right) const {
    return compared(value_ < right, "<", right);
  }
  template <typename R>
  Outcome operator>=(const R& right) const {
    return compared(value_ >= right, ">=", right);
  }
  template <typename R>
  Outcome operator>(const R& right) const {
    return compared(value_ > right, ">", right);
  }
  template <typename R>
  Outcome operator==(const R& right) const {
    return compared(value_ == right, "==", right);
  }
  template <typename R>
  Outcome operator!=(const R& right) const {
    return compared(value_ != right, "!=", right);
  }
  // A condition without a comparison.
  operator Outcome() const { return {static_cast<bool>(value_), ""}; }  // NOLINT(google-explicit-constructor)

 private:
  template <typename R>
  Outcome compared(bool holds, const char* sign, const R& right) const {
    if (holds) return {true, {}};
    std::ostringstream text;
    text.precision(17);
    text << value_ << ' ' << sign << ' ' << right;
    return {false, text.str()};
  }
  const L& value_;
};

struct Start {
  template <typename L>
  Left<L> operator<<(const L& value) const {
    return Left<L>(value);
  }
};

}  // namespace render::check

#endif

// Outside the guard: glog, which Ceres brings along, defines a CHECK that ends the process. Include this after it.
#undef CHECK
#define CHECK(condition)                                                                                  \
  do {                                                                                                    \
    if (const ::render::check::Outcome outcome = ::render::check::Start() << condition; !outcome.holds) { \
      ::render::check::fail(#condition, outcome.values, std::source_location::current());                 \
    }                                                                                                     \
  } while (false)
