#include "app/calibration/tag_map_text.h"

#include <fmt/format.h>

namespace app {

std::string tag_map_text(const ar::TagMap& map, const std::string& heading,
                         const std::function<std::string(int)>& note_of) {
  std::string text = fmt::format("# {}\nskyshaft_tags: 1\nfamily: {}\nmap:\n", heading, map.family);
  for (const auto& [id, tag] : map.tags) {
    const cv::Vec3d& p = tag.world_from_tag.translation;
    const cv::Vec4d q = ar::quaternion_wxyz(tag.world_from_tag.rotation);
    const std::string note = note_of(id);
    text += fmt::format(
        "  - {{ id: {}, position: [{:.6f}, {:.6f}, {:.6f}], orientation: [{:.9f}, {:.9f}, {:.9f}, {:.9f}], "
        "size: {:.9g} }}{}{}\n",
        id, p[0], p[1], p[2], q[0], q[1], q[2], q[3], tag.size_m, note.empty() ? "" : "  # ", note);
  }
  return text;
}

}  // namespace app
