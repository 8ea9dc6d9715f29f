#pragma once

#include <string>
#include <vector>

namespace app {

// The YAML text with the value at that path of keys ({"sky", "clouds", "preset"}) changed to `value`, a plain scalar as
// it is to be written, and everything else, comments, order and spacing, as it was. Keys that are missing are added;
// where a scalar stands for a whole map (`sky: perez`), `scalar_key` names the key that it stands for. Throws
// std::runtime_error where the text is not YAML or the path leads through a list.
std::string with_yaml_value(const std::string& text, const std::vector<std::string>& path, const std::string& value,
                            const std::string& scalar_key = "model");

}  // namespace app
