#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "ar/place/place.h"

namespace ar {
namespace {

using std::chrono::microseconds;

[[noreturn]] void refuse_time(const std::string& text, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("time '{}': {}\naccepted: ISO 8601 with a time zone, such as 2024-06-21T07:30:00Z or "
                  "2024-06-21T09:30+02:00",
                  text, why));
}

// Reads a time from its front; every refusal names the whole text.
class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text), rest_(text) {}

  bool done() const { return rest_.empty(); }

  bool take(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_[0]) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(std::string_view any_of, const std::string& where) {
    if (!take(any_of)) refuse_time(text_, fmt::format("'{}' expected {}, found '{}'", any_of[0], where, rest_));
  }

  int digits(std::size_t count, int low, int high, const char* what) {
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (i >= rest_.size() || rest_[i] < '0' || rest_[i] > '9') {
        refuse_time(text_, fmt::format("{} digits expected for the {}, found '{}'", count, what, rest_));
      }
      value = 10 * value + (rest_[i] - '0');
    }
    rest_.remove_prefix(count);
    if (value < low || value > high)
      refuse_time(text_, fmt::format("{} {} is not within {} ... {}", what, value, low, high));
    return value;
  }

  // The fraction of a second after its point, cut to microseconds.
  microseconds fraction() {
    int value = 0;
    std::size_t count = 0;
    for (; count < rest_.size() && rest_[count] >= '0' && rest_[count] <= '9'; ++count) {
      if (count < 6) value = 10 * value + (rest_[count] - '0');
    }
    if (count == 0) refuse_time(text_, "digits expected after the decimal point of the second");
    for (std::size_t i = count; i < 6; ++i) value *= 10;
    rest_.remove_prefix(count);
    return microseconds(value);
  }

  // 'Z', or an offset of local time from UTC: +02:00, +0200, +02.
  std::chrono::minutes offset() {
    if (take("Zz")) return std::chrono::minutes(0);
    const bool west = !rest_.empty() && rest_[0] == '-';
    if (!take("+-")) {
      refuse_time(text_,
                  "no time zone: add Z for UTC, or an offset such as +02:00, because a local time alone is ambiguous");
    }
    const int hours = digits(2, 0, 18, "offset's hour");
    int minutes = 0;
    if (take(":") || !done()) minutes = digits(2, 0, 59, "offset's minute");
    const std::chrono::minutes east(60 * hours + minutes);
    return west ? -east : east;
  }

 private:
  const std::string& text_;
  std::string_view rest_;
};

struct Clock {
  std::chrono::seconds of_day{0};
  microseconds fraction{0};
  bool leap_second = false;
};

Clock read_clock(Reader& in) {
  const int hour = in.digits(2, 0, 23, "hour");
  in.expect(":", "after the hour");
  const int minute = in.digits(2, 0, 59, "minute");
  Clock clock;
  int second = 0;
  if (in.take(":")) {
    second = in.digits(2, 0, 60, "second");
    if (in.take(".,")) clock.fraction = in.fraction();
  }
  clock.leap_second = second == 60;
  clock.of_day = std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second);
  return clock;
}

}  // namespace

// UTC's leap seconds have no number of their own in sys_time, so that 23:59:60 becomes the second after it, as POSIX
// has it; the label is taken at the end of a UTC day in June or December only, where leap seconds are.
UtcTime parse_time(const std::string& text) {
  Reader in(text);
  const int year = in.digits(4, 0, 9999, "year");
  in.expect("-", "after the year");
  const int month = in.digits(2, 1, 12, "month");
  in.expect("-", "after the month");
  const int day = in.digits(2, 1, 31, "day");
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) refuse_time(text, fmt::format("{:04}-{:02} has no day {}", year, month, day));
  in.expect("Tt ", "between date and time");
  const Clock clock = read_clock(in);
  const UtcTime time = std::chrono::sys_days(date) + clock.of_day - in.offset();
  if (!in.done()) refuse_time(text, "something follows the time zone");
  if (clock.leap_second) {
    const auto midnight = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day after{midnight};
    const bool possible = time == midnight && after.day() == std::chrono::day(1) &&
                          (after.month() == std::chrono::January || after.month() == std::chrono::July);
    if (!possible) refuse_time(text, "second 60 exists only as 23:59:60 UTC on 30 June or 31 December");
  }
  return time + clock.fraction;
}

std::string format_time(UtcTime time) {
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{midnight};
  const std::chrono::hh_mm_ss<microseconds> clock{time - midnight};
  std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", static_cast<int>(date.year()),
                                 static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                                 clock.hours().count(), clock.minutes().count(), clock.seconds().count());
  if (clock.subseconds().count() != 0) {
    text += fmt::format(".{:06}", clock.subseconds().count());
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text + 'Z';
}

}  // namespace ar
