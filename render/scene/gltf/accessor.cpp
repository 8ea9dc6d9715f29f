#include "render/scene/gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace render::gltf {
namespace {

enum ComponentType : std::size_t { Byte = 5120, UByte = 5121, Short = 5122, UShort = 5123, UInt = 5125, Float = 5126 };

// An accessor without a buffer view is all zeros: nothing in the file bounds its size.
constexpr std::size_t kMaxZeros = std::size_t{1} << 26;

std::size_t component_size(std::size_t type, const std::string& where) {
  switch (type) {
    case Byte:
    case UByte:
      return 1;
    case Short:
    case UShort:
      return 2;
    case UInt:
    case Float:
      return 4;
    default:
      throw std::runtime_error(where + ": `componentType` is " + std::to_string(type) +
                               ", accepted are 5120, 5121, 5122, 5123, 5125 and 5126");
  }
}

std::size_t component_count(const std::string& type, const std::string& where) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  throw std::runtime_error(where + ": `type` is \"" + type + "\", accepted are SCALAR, VEC2, VEC3 and VEC4");
}

template <typename T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // data may be unaligned; glTF and the machine are little-endian
  return value;
}

template <typename T>
float scaled(const std::uint8_t* at, bool normalized) {
  const auto value = static_cast<float>(load<T>(at));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

float read_component(const std::uint8_t* at, std::size_t type, bool normalized) {
  switch (type) {
    case Byte:
      return scaled<std::int8_t>(at, normalized);
    case UByte:
      return scaled<std::uint8_t>(at, normalized);
    case Short:
      return scaled<std::int16_t>(at, normalized);
    case UShort:
      return scaled<std::uint16_t>(at, normalized);
    case UInt:
      return scaled<std::uint32_t>(at, normalized);
    default:
      return load<float>(at);
  }
}

std::uint32_t read_unsigned(const std::uint8_t* at, std::size_t type, const std::string& where) {
  switch (type) {
    case UByte:
      return load<std::uint8_t>(at);
    case UShort:
      return load<std::uint16_t>(at);
    case UInt:
      return load<std::uint32_t>(at);
    default:
      throw std::runtime_error(where + ": indices have `componentType` " + std::to_string(type) +
                               ", accepted are 5121, 5123 and 5125");
  }
}

// Elements in memory, `count` of them inside their buffer view for certain.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};

Elements elements(const Document& document, std::size_t view, std::size_t offset, std::size_t count, std::size_t size,
                  const std::string& where) {
  const std::span<const std::uint8_t> bytes = document.view(view);
  const std::size_t own_stride = document.view_stride(view);
  const std::size_t stride = own_stride == 0 ? size : own_stride;
  if (stride < size) throw std::runtime_error(where + ": its buffer view's `byteStride` is smaller than an element");
  const bool fits = offset <= bytes.size() && size <= bytes.size() - offset &&
                    (count == 0 || count - 1 <= (bytes.size() - offset - size) / stride);
  if (count > 0 && !fits) {
    throw std::runtime_error(where + ": " + std::to_string(count) + " elements go past the end of buffer view " +
                             std::to_string(view));
  }
  return {count > 0 ? bytes.data() + offset : nullptr, stride, count};
}

struct Accessor {
  const Json& json;
  std::string where;
  std::size_t type;
  std::size_t component_bytes;
  std::size_t components;
  std::size_t count;
  bool normalized;
};

Accessor parse(const Document& document, std::size_t index) {
  const Json& json = document.element("accessors", index);
  const std::string where = "accessor " + std::to_string(index);
  const std::size_t type = count(json, "componentType", where);
  const std::size_t bytes = component_size(type, where);
  const std::size_t components = component_count(text_or(json, "type", "", where), where);
  return {json, where, type, bytes, components, count(json, "count", where), flag_or(json, "normalized", false, where)};
}

// Calls `store(element index, bytes)` for every element, the sparse ones last.
template <typename Store>
void for_each_element(const Document& document, const Accessor& accessor, Store store) {
  const std::size_t size = accessor.component_bytes * accessor.components;
  const std::size_t views = document.size("bufferViews");
  if (const auto view = optional_index(accessor.json, "bufferView", views, accessor.where)) {
    const std::size_t offset = count_or(accessor.json, "byteOffset", 0, accessor.where);
    const Elements base = elements(document, *view, offset, accessor.count, size, accessor.where);
    for (std::size_t i = 0; i < base.count; ++i) store(i, base.first + i * base.stride);
  }
  const Json* sparse = find(accessor.json, "sparse");
  if (!sparse) return;
  const std::string where = accessor.where + ", sparse";
  const Json* where_to = find(*sparse, "indices");
  const Json* what = find(*sparse, "values");
  if (!where_to || !what) throw std::runtime_error(where + ": `indices` or `values` is missing");
  const std::size_t replaced = count(*sparse, "count", where);
  const std::size_t type = count(*where_to, "componentType", where);
  const Elements places =
      elements(document, index(*where_to, "bufferView", views, where), count_or(*where_to, "byteOffset", 0, where),
               replaced, component_size(type, where), where);
  const Elements values = elements(document, index(*what, "bufferView", views, where),
                                   count_or(*what, "byteOffset", 0, where), replaced, size, where);
  for (std::size_t i = 0; i < replaced; ++i) {
    const std::size_t place = read_unsigned(places.first + i * places.stride, type, where);
    if (place >= accessor.count) {
      throw std::runtime_error(where + ": index " + std::to_string(place) + " of " + std::to_string(accessor.count) +
                               " elements");
    }
    store(place, values.first + i * values.stride);
  }
}

void check_zeros(const Accessor& accessor) {
  if (!find(accessor.json, "bufferView") && accessor.count > kMaxZeros) {
    throw std::runtime_error(accessor.where + ": `count` is " + std::to_string(accessor.count) +
                             " without a buffer view, accepted is up to " + std::to_string(kMaxZeros));
  }
}

// Checked before anything is allocated from `count`.
void check_size(const Document& document, const Accessor& accessor) {
  check_zeros(accessor);
  if (const auto view = optional_index(accessor.json, "bufferView", document.size("bufferViews"), accessor.where)) {
    elements(document, *view, count_or(accessor.json, "byteOffset", 0, accessor.where), accessor.count,
             accessor.component_bytes * accessor.components, accessor.where);
  }
}

}  // namespace

std::vector<float> read_floats(const Document& document, std::size_t accessor, std::size_t components) {
  const Accessor parsed = parse(document, accessor);
  if (parsed.components != components) {
    throw std::runtime_error(parsed.where + " has " + std::to_string(parsed.components) +
                             " components, its use needs " + std::to_string(components));
  }
  check_size(document, parsed);
  std::vector<float> values(parsed.count * components, 0.0F);
  for_each_element(document, parsed, [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t c = 0; c < components; ++c) {
      values[element * components + c] =
          read_component(bytes + c * parsed.component_bytes, parsed.type, parsed.normalized);
    }
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const Document& document, std::size_t accessor) {
  const Accessor parsed = parse(document, accessor);
  if (parsed.components != 1) throw std::runtime_error(parsed.where + " holds indices but is not SCALAR");
  check_size(document, parsed);
  std::vector<std::uint32_t> values(parsed.count, 0);
  for_each_element(document, parsed, [&](std::size_t element, const std::uint8_t* bytes) {
    values[element] = read_unsigned(bytes, parsed.type, parsed.where);
  });
  return values;
}

}  // namespace render::gltf
