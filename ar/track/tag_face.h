#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ar {

// A tag as printed: square cells, black or white, with the white margin that its family asks for and one cell more.
struct TagFace {
  int cells = 0;                    // a side, margin included
  double cell_m = 0.0;              // for a tag of that size (outer edge of the border the corners are measured on)
  std::vector<std::uint8_t> white;  // cells * cells, row 0 at the tag's top

  double side_m() const { return cells * cell_m; }
  // At (x, y) in the tag's frame, metres: x right, y down from the centre.
  bool is_white(double x, double y) const;
};

// The printed form of a tag, from libapriltag's own code. Throws std::runtime_error for an unknown family or id.
TagFace make_tag_face(const std::string& family, int id, double size_m);

// How many ids the family has. Throws std::runtime_error for an unknown family.
int tag_count(const std::string& family);

}  // namespace ar
