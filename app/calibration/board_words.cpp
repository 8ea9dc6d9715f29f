#include "app/calibration/board_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "app/error.h"
#include "ar/track/detector.h"
#include "ar/track/tag_face.h"
#include "render/base/number.h"

namespace app {
namespace {

struct Form {
  const char* kind;
  const char* text;
  std::size_t fewest;
  std::size_t most;  // parts
};
const std::vector<Form> kForms{{"chessboard", "chessboard:COLUMNSxROWS:SQUARE", 3, 3},
                               {"charuco", "charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY", 5, 5},
                               {"aprilgrid", "aprilgrid:COLUMNSxROWS:SIZE:GAP[:FAMILY]", 4, 5},
                               {"tag", "tag:ID:SIZE[:FAMILY]", 3, 4}};

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool parse(const std::string& text, int& value) {
  const auto read = render::parse_count<int>(text);
  value = read.value_or(0);
  return read.has_value();
}

bool parse(const std::string& text, double& value) {
  const auto read = render::parse_number(text);
  value = read.value_or(0.0);
  return read.has_value();
}

std::string check_family(const std::string& family) {
  const auto& known = ar::tag_families();
  if (std::find(known.begin(), known.end(), family) != known.end()) return family;
  throw UsageError(fmt::format("--board: no tag family '{}'\naccepted: {}", family, fmt::join(known, ", ")));
}

class ShortForm {
 public:
  explicit ShortForm(const std::string& text) : text_(text), parts_(parts_of(text, ':')) {
    form_ = &*std::find_if(kForms.begin(), kForms.end(), [&](const Form& f) { return parts_[0] == f.kind; });
    if (parts_.size() < form_->fewest || parts_.size() > form_->most) fail();
  }

  [[noreturn]] void fail() const {
    throw UsageError(fmt::format("board '{}' does not read as {}\nexample: {}", text_, form_->text,
                                 "chessboard:9x6:25mm, charuco:12x8:18mm:14mm:DICT_5X5_1000, aprilgrid:5x6:30mm:0.3, "
                                 "tag:7:160mm"));
  }
  const std::string& kind() const { return parts_[0]; }
  std::string part(std::size_t i, const std::string& otherwise) const {
    return i < parts_.size() ? parts_[i] : otherwise;
  }
  std::pair<int, int> size(int smallest) const {
    const auto sides = parts_of(parts_[1], 'x');
    int columns = 0;
    int rows = 0;
    if (sides.size() != 2 || !parse(sides[0], columns) || !parse(sides[1], rows)) fail();
    if (std::min(columns, rows) < smallest || std::max(columns, rows) > 200) fail();
    return {columns, rows};
  }
  double length(std::size_t i) const { return metres_from(parts_[i]); }
  template <typename Number>
  Number number(std::size_t i) const {
    Number value{};
    if (!parse(parts_[i], value) || !(value >= Number{})) fail();
    return value;
  }

 private:
  std::string text_;
  std::vector<std::string> parts_;
  const Form* form_;
};

calib::Board read_grid(const ShortForm& form) {
  calib::GridSpec grid;
  std::tie(grid.columns, grid.rows) = form.size(1);
  grid.size_m = form.length(2);
  grid.gap_x_m = grid.gap_y_m = form.number<double>(3) * grid.size_m;
  grid.family = check_family(form.part(4, "tag36h11"));
  if (!(grid.gap_x_m > 0.0) || grid.columns * grid.rows > ar::tag_count(grid.family)) form.fail();
  return calib::make_tag_grid(grid);
}

calib::Board read_tag(const ShortForm& form) {
  ar::TagMap tags;
  tags.family = check_family(form.part(3, "tag36h11"));
  const int id = form.number<int>(1);
  if (id >= ar::tag_count(tags.family)) form.fail();
  tags.tags[id] = {ar::Rigid3{}, form.length(2)};
  return calib::make_layout(tags);
}

}  // namespace

double metres_from(const std::string& text) {
  double unit = 1.0;
  std::string number = text;
  for (const auto& [suffix, metres] : {std::pair{"mm", 1e-3}, std::pair{"cm", 1e-2}, std::pair{"m", 1.0}}) {
    if (!number.ends_with(suffix)) continue;
    number.resize(number.size() - std::string(suffix).size());
    unit = metres;
    break;
  }
  double value = 0.0;
  if (!parse(number, value) || !(value > 0.0) || !(value < 1e6)) {
    throw UsageError(fmt::format("'{}' is no length\naccepted: metres above 0, or 25mm, 2.5cm", text));
  }
  return value * unit;
}

bool is_short_form(const std::string& specification) {
  const std::string kind = specification.substr(0, specification.find(':'));
  return specification.find(':') != std::string::npos &&
         std::any_of(kForms.begin(), kForms.end(), [&](const Form& f) { return kind == f.kind; });
}

calib::Board read_short_form(const std::string& specification) {
  const ShortForm form(specification);
  try {
    if (form.kind() == "chessboard") {
      const auto [columns, rows] = form.size(2);
      return calib::make_chessboard(columns, rows, form.length(2), form.length(2));
    }
    if (form.kind() == "charuco") {
      const auto [columns, rows] = form.size(3);
      return calib::make_charuco(form.part(4, ""), columns, rows, form.length(2), form.length(3), false);
    }
    return form.kind() == "aprilgrid" ? read_grid(form) : read_tag(form);
  } catch (const UsageError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace app
