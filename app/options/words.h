#pragma once

#include <string>
#include <vector>

namespace app {

// The entry of `choices` closest to `word`, when it is close enough to be a slip of the pen; empty otherwise.
std::string closest(const std::string& word, const std::vector<std::string>& choices);

// "a, b or c"
std::string join_or(const std::vector<std::string>& words);

}  // namespace app
