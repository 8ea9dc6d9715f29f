#include "app/calibration/board_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "app/calibration/board_words.h"
#include "app/error.h"
#include "app/scene_file/sections.h"
#include "ar/error.h"
#include "ar/track/detector.h"
#include "ar/track/tag_face.h"

namespace app {
namespace {

using calib::Board;
using calib::GridOrder;
using calib::GridSpec;

int count(const YamlMap& map, const std::string& key, int smallest) {
  return map.require(key, fmt::format("a whole number from {} to 200", smallest)).integer(smallest, 200);
}

double length(const YamlMap& map, const std::string& key) {
  return read_positive(map.require(key, "metres"), "metres");
}

// One number for both directions, or [across, down].
std::pair<double, double> both_ways(const YamlValue& value, const std::string& accepted) {
  const auto positive = [](double v) { return v > 0.0; };
  if (value.is_scalar()) {
    const double v = value.number(accepted, positive);
    return {v, v};
  }
  const auto list = value.list();
  if (list.size() != 2) value.fail(accepted);
  return {list[0].number(accepted, positive), list[1].number(accepted, positive)};
}

// What the parts cannot know of themselves is said with the place in the file.
template <typename Make>
Board made(const YamlValue& at, const Make& make) {
  try {
    return make();
  } catch (const std::runtime_error& error) {
    throw ar::InputError(at.where() + ": " + error.what());
  }
}

Board read_chessboard(const YamlValue& value) {
  const YamlMap map = value.map({"columns", "rows", "square"});
  const auto [width, height] = both_ways(map.require("square", "metres"), "metres above 0, or [across, down]");
  return calib::make_chessboard(count(map, "columns", 2), count(map, "rows", 2), width, height);
}

Board read_charuco(const YamlValue& value) {
  const YamlMap map = value.map({"dictionary", "columns", "rows", "square", "marker", "first"});
  const auto first = map.find("first");
  const bool marker_first = first && first->one_of({"black", "marker"}) == "marker";
  const std::string dictionary =
      map.require("dictionary", "an ArUco dictionary, such as DICT_5X5_1000").one_of(calib::charuco_dictionaries());
  return made(value, [&] {
    return calib::make_charuco(dictionary, count(map, "columns", 3), count(map, "rows", 3), length(map, "square"),
                               length(map, "marker"), marker_first);
  });
}

void check_ids(const YamlValue& at, const GridSpec& grid) {
  const int last = grid.first_id + grid.columns * grid.rows - 1;
  const int known = ar::tag_count(grid.family);
  if (last >= known) {
    at.fail_found(fmt::format("ids up to {}", last), fmt::format("{} has ids 0 to {}", grid.family, known - 1));
  }
}

Board read_aprilgrid(const YamlValue& value) {
  const YamlMap map =
      value.map({"family", "columns", "rows", "size", "gap", "first_id", "first", "border_bits", "filled_gaps"});
  GridSpec grid;
  if (const auto family = map.find("family")) grid.family = family->one_of(ar::tag_families());
  grid.columns = count(map, "columns", 1);
  grid.rows = count(map, "rows", 1);
  grid.size_m = length(map, "size");
  const auto [across, down] = both_ways(map.require("gap", "white between two tags, in tag sizes"),
                                        "white between two tags, in tag sizes above 0, or [across, down]");
  grid.gap_x_m = across * grid.size_m;
  grid.gap_y_m = down * grid.size_m;
  if (const auto first = map.find("first_id")) grid.first_id = first->integer(0, 48713);
  if (const auto first = map.find("first")) {
    grid.order = first->one_of({"top-left", "bottom-left"}) == "top-left" ? GridOrder::TopLeft : GridOrder::BottomLeft;
  }
  if (const auto bits = map.find("border_bits")) grid.border_bits = bits->integer(1, 2);
  if (const auto filled = map.find("filled_gaps")) grid.filled_gaps = filled->boolean();
  if (grid.border_bits == 2 && grid.family != "tag36h11") {
    map.require("border_bits", "1").fail("1; two-bit borders are Kalibr's, of tag36h11");
  }
  check_ids(value, grid);
  return calib::make_tag_grid(grid);
}

Board read_tag(const YamlValue& value) {
  const YamlMap map = value.map({"family", "id", "size"});
  ar::TagMap tags;
  if (const auto family = map.find("family")) tags.family = family->one_of(ar::tag_families());
  const int id = map.require("id", "the tag's number").integer(0, ar::tag_count(tags.family) - 1);
  tags.tags[id] = {ar::Rigid3{}, length(map, "size")};
  return calib::make_layout(tags);
}

Board read_own(const YamlValue& root) {
  const YamlMap map = root.map({"skyshaft_board", "chessboard", "charuco", "aprilgrid", "tag"});
  map.require("skyshaft_board", "1, the version of this format").integer(1, 1);
  const std::string kind = map.exactly_one_of({"chessboard", "charuco", "aprilgrid", "tag"});
  const YamlValue value = *map.find(kind);
  if (kind == "chessboard") return read_chessboard(value);
  if (kind == "charuco") return read_charuco(value);
  if (kind == "aprilgrid") return read_aprilgrid(value);
  return read_tag(value);
}

// Kalibr's target files (github.com/ethz-asl/kalibr, wiki "Calibration targets"): tagSpacing is the gap over the size;
// ids start at the lower left; the black squares in the gaps belong to the pattern.
Board read_kalibr(const YamlValue& root) {
  const YamlMap map = root.map({"target_type", "tagCols", "tagRows", "tagSize", "tagSpacing", "codeOffset",
                                "targetCols", "targetRows", "colSpacingMeters", "rowSpacingMeters"});
  const std::string type = map.require("target_type", "aprilgrid").one_of({"aprilgrid", "checkerboard"});
  if (type == "checkerboard") {
    return calib::make_chessboard(count(map, "targetCols", 2), count(map, "targetRows", 2),
                                  length(map, "colSpacingMeters"), length(map, "rowSpacingMeters"));
  }
  GridSpec grid;
  grid.columns = count(map, "tagCols", 1);
  grid.rows = count(map, "tagRows", 1);
  grid.size_m = length(map, "tagSize");
  grid.gap_x_m = grid.gap_y_m =
      grid.size_m * read_positive(map.require("tagSpacing", "gap over tag size"), "gap over tag size");
  if (const auto offset = map.find("codeOffset")) grid.first_id = offset->integer(0, 586);
  grid.order = GridOrder::BottomLeft;
  grid.border_bits = 2;
  grid.filled_gaps = true;
  check_ids(root, grid);
  return calib::make_tag_grid(grid);
}

Board read_file(const std::string& path) {
  const YamlValue root = YamlValue::load(path, "board file");
  if (root.is_map() && root.has("skyshaft_tags")) return calib::make_layout(read_tag_map(root));
  if (root.is_map() && root.has("target_type")) return read_kalibr(root);
  return read_own(root);
}

}  // namespace

const char* const kBoardHelp =
    "Boards: a board file, a tag map, Kalibr's target YAML, or a short form:\n"
    "  chessboard:9x6:25mm                     inner corners across x down, square\n"
    "  charuco:12x8:18mm:14mm:DICT_5X5_1000    squares across x down, square, marker, dictionary\n"
    "  aprilgrid:5x6:30mm:0.3[:tag36h11]       tags across x down, tag size, gap in tag sizes, family\n"
    "  tag:7:160mm[:tag36h11]                  id, tag size, family\n"
    "Lengths in m, cm or mm. A board file says the same and more:\n"
    "  skyshaft_board: 1\n"
    "  aprilgrid: { family: tag36h11, columns: 5, rows: 6, size: 0.03, gap: [0.5, 0.62], first_id: 0, first: top-left "
    "}\n"
    "A tag's size is the outer edge of its black border.";

Board read_board(const std::string& specification) {
  std::error_code error;
  if (!std::filesystem::exists(specification, error) && is_short_form(specification)) {
    return read_short_form(specification);
  }
  return read_file(specification);
}

std::string board_text(const Board& board) {
  std::string text = fmt::format("# {}\n", board.description);
  if (board.kind == calib::BoardKind::Chessboard) {
    return text + fmt::format("skyshaft_board: 1\nchessboard: {{ columns: {}, rows: {}, square: [{:.9g}, {:.9g}] }}\n",
                              board.columns, board.rows, board.square_width_m, board.square_height_m);
  }
  if (board.kind == calib::BoardKind::Charuco) {
    return text + fmt::format(
                      "skyshaft_board: 1\ncharuco: {{ dictionary: {}, columns: {}, rows: {}, square: {:.9g}, "
                      "marker: {:.9g}, first: {} }}\n",
                      board.family, board.columns, board.rows, board.square_width_m, board.marker_m,
                      board.marker_first ? "marker" : "black");
  }
  if (board.grid) {
    const double size = board.tags.front().size_m;
    const auto step = [&](std::size_t i, int axis) {
      return i < board.tags.size()
                 ? board.tags[i].board_from_tag.translation[axis] - board.tags[0].board_from_tag.translation[axis]
                 : 1.3 * size;
    };
    const double gap_x = board.columns > 1 ? step(1, 0) / size - 1.0 : 0.3;
    const double gap_y = board.rows > 1 ? step(static_cast<std::size_t>(board.columns), 1) / size - 1.0 : 0.3;
    const bool top = board.order == GridOrder::TopLeft;
    const int first =
        top ? board.tags.front().id : board.tags[board.tags.size() - static_cast<std::size_t>(board.columns)].id;
    return text + fmt::format(
                      "skyshaft_board: 1\naprilgrid: {{ family: {}, columns: {}, rows: {}, size: {:.9g}, gap: "
                      "[{:.9g}, {:.9g}], first_id: {}, first: {}, border_bits: {}, filled_gaps: {} }}\n",
                      board.family, board.columns, board.rows, size, gap_x, gap_y, first,
                      top ? "top-left" : "bottom-left", board.border_bits, board.filled_gap_m > 0.0);
  }
  text += fmt::format("skyshaft_tags: 1\nfamily: {}\nmap:\n", board.family);
  for (const calib::BoardTag& tag : board.tags) {
    const cv::Vec3d& p = tag.board_from_tag.translation;
    const cv::Vec4d q = ar::quaternion_wxyz(tag.board_from_tag.rotation);
    text += fmt::format(
        "  - {{ id: {}, size: {:.9g}, position: [{:.9g}, {:.9g}, {:.9g}], orientation: [{:.12g}, {:.12g}, "
        "{:.12g}, {:.12g}] }}\n",
        tag.id, tag.size_m, p[0], p[1], p[2], q[0], q[1], q[2], q[3]);
  }
  return text;
}

}  // namespace app
