#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

// Reading of untrusted JSON for glTF: every value's type and range is checked. All throw std::runtime_error that names
// the place (`where`, such as "node 3"), the key, what was found and what is accepted.
namespace render::gltf {

using Json = nlohmann::json;

// The member, or nullptr where absent.
const Json* find(const Json& object, const char* key);

// The member as an array; empty where absent.
const Json& array(const Json& object, const char* key, const std::string& where);

// A whole number in [0, 2^53].
std::optional<std::size_t> optional_count(const Json& object, const char* key, const std::string& where);
std::size_t count(const Json& object, const char* key, const std::string& where);
std::size_t count_or(const Json& object, const char* key, std::size_t otherwise, const std::string& where);

// An index into something that has `size` elements.
std::optional<std::size_t> optional_index(const Json& object, const char* key, std::size_t size,
                                          const std::string& where);
std::size_t index(const Json& object, const char* key, std::size_t size, const std::string& where);

// Finite numbers.
double number_or(const Json& object, const char* key, double otherwise, const std::string& where);
// Fills `values` from an array of exactly that many numbers; leaves it and returns false where the key is absent.
bool numbers(const Json& object, const char* key, std::span<double> values, const std::string& where);

std::string text_or(const Json& object, const char* key, const std::string& otherwise, const std::string& where);
bool flag_or(const Json& object, const char* key, bool otherwise, const std::string& where);

// The extension's object inside `extensions`, or nullptr.
const Json* extension(const Json& object, const char* name);

}  // namespace render::gltf
