#include "render/scene/gltf/json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace render::gltf {
namespace {

constexpr double kMaxCount = 9007199254740992.0;  // 2^53, the largest whole number JSON carries exactly

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

[[noreturn]] void fail(const std::string& where, const char* key, const Json& found, const std::string& accepted) {
  throw std::runtime_error(where + ": `" + key + "` is " + shown(found) + ", accepted is " + accepted);
}

double number(const Json& value, const char* key, const std::string& where) {
  const double x = value.is_number() ? value.get<double>() : NAN;
  if (!std::isfinite(x)) fail(where, key, value, "a number");
  return x;
}

}  // namespace

const Json* find(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

const Json& array(const Json& object, const char* key, const std::string& where) {
  static const Json kEmpty = Json::array();
  const Json* value = find(object, key);
  if (!value) return kEmpty;
  if (!value->is_array()) fail(where, key, *value, "an array");
  return *value;
}

std::optional<std::size_t> optional_count(const Json& object, const char* key, const std::string& where) {
  const Json* value = find(object, key);
  if (!value) return std::nullopt;
  const double x = value->is_number() ? value->get<double>() : -1.0;
  if (!(x >= 0.0 && x <= kMaxCount) || x != std::floor(x)) fail(where, key, *value, "a whole number not below 0");
  return static_cast<std::size_t>(x);
}

std::size_t count(const Json& object, const char* key, const std::string& where) {
  const std::optional<std::size_t> value = optional_count(object, key, where);
  if (!value) throw std::runtime_error(where + ": `" + key + "` is missing");
  return *value;
}

std::size_t count_or(const Json& object, const char* key, std::size_t otherwise, const std::string& where) {
  return optional_count(object, key, where).value_or(otherwise);
}

std::optional<std::size_t> optional_index(const Json& object, const char* key, std::size_t size,
                                          const std::string& where) {
  const std::optional<std::size_t> value = optional_count(object, key, where);
  if (value && *value >= size) {
    throw std::runtime_error(where + ": `" + key + "` is " + std::to_string(*value) + ", but there are " +
                             std::to_string(size));
  }
  return value;
}

std::size_t index(const Json& object, const char* key, std::size_t size, const std::string& where) {
  const std::optional<std::size_t> value = optional_index(object, key, size, where);
  if (!value) throw std::runtime_error(where + ": `" + key + "` is missing");
  return *value;
}

double number_or(const Json& object, const char* key, double otherwise, const std::string& where) {
  const Json* value = find(object, key);
  return value ? number(*value, key, where) : otherwise;
}

bool numbers(const Json& object, const char* key, std::span<double> values, const std::string& where) {
  const Json* value = find(object, key);
  if (!value) return false;
  if (!value->is_array() || value->size() != values.size()) {
    fail(where, key, *value, "an array of " + std::to_string(values.size()) + " numbers");
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = number((*value)[i], key, where);
  return true;
}

std::string text_or(const Json& object, const char* key, const std::string& otherwise, const std::string& where) {
  const Json* value = find(object, key);
  if (!value) return otherwise;
  if (!value->is_string()) fail(where, key, *value, "a string");
  return value->get<std::string>();
}

bool flag_or(const Json& object, const char* key, bool otherwise, const std::string& where) {
  const Json* value = find(object, key);
  if (!value) return otherwise;
  if (!value->is_boolean()) fail(where, key, *value, "true or false");
  return value->get<bool>();
}

const Json* extension(const Json& object, const char* name) {
  const Json* extensions = find(object, "extensions");
  return extensions ? find(*extensions, name) : nullptr;
}

}  // namespace render::gltf
