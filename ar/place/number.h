#pragma once

#include <optional>
#include <string_view>

namespace ar {

// A finite decimal number that takes up the whole text, whatever the locale; a sign only in parse_number().
std::optional<double> parse_unsigned(std::string_view text);
std::optional<double> parse_number(std::string_view text);

// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace ar
