#include "render/scene/gltf/document.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

namespace render::gltf {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;

constexpr std::array<std::string_view, 3> kSupportedExtensions = {"KHR_materials_emissive_strength",
                                                                  "KHR_mesh_quantization", "KHR_texture_transform"};

std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
         std::uint32_t{bytes[at + 3]} << 24;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

Bytes decode_base64(std::string_view text, const std::string& where) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  Bytes bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) throw std::runtime_error(where + ": its data URI is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count & 255U));
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// "%20" and its like, RFC 3986.
std::string percent_decoded(const std::string& uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
    out += escape ? static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return out;
}

}  // namespace

Document::Document(const std::filesystem::path& path) : folder_(path.parent_path()) {
  read_container(read_file(path));
  const Json* asset = find(*root_, "asset");
  const std::string version = asset ? text_or(*asset, "version", "", "asset") : "";
  if (version.rfind("2.", 0) != 0) {
    throw std::runtime_error("glTF version \"" + version + "\" found, accepted is 2.x");
  }
  check_extensions();
  read_buffers();
}

Document::~Document() = default;

void Document::read_container(const Bytes& file) {
  if (file.empty()) throw std::runtime_error("the file is empty");
  std::span<const std::uint8_t> json = file;
  if (file.size() >= 4 && u32_at(file, 0) == kGlbMagic) {
    if (file.size() < kGlbHeader + kChunkHeader) throw std::runtime_error("truncated inside the GLB header");
    const std::size_t version = u32_at(file, 4);
    if (version != 2) throw std::runtime_error("GLB version " + std::to_string(version) + " found, accepted is 2");
    const std::size_t length = u32_at(file, 8);
    if (length > file.size()) {
      throw std::runtime_error("truncated: it should have " + std::to_string(length) + " bytes, it has " +
                               std::to_string(file.size()));
    }
    json = {};
    for (std::size_t at = kGlbHeader; at + kChunkHeader <= length;) {
      const std::size_t size = u32_at(file, at);
      const std::uint32_t type = u32_at(file, at + 4);
      at += kChunkHeader;
      if (size > length - at) throw std::runtime_error("truncated: a chunk goes past the end of the file");
      const auto chunk = std::span(file).subspan(at, size);
      if (type == kJsonChunk && json.empty()) json = chunk;
      if (type == kBinaryChunk && binary_chunk_.empty()) binary_chunk_.assign(chunk.begin(), chunk.end());
      at += size;
    }
    if (json.empty()) throw std::runtime_error("the GLB file has no JSON chunk");
  }
  try {
    root_ = std::make_unique<Json>(Json::parse(json.begin(), json.end()));
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("not a glTF file, or broken JSON: ") + error.what());
  }
  if (!root_->is_object()) throw std::runtime_error("not a glTF file: its JSON is not an object");
}

void Document::check_extensions() const {
  const Json* required = find(*root_, "extensionsRequired");
  if (!required || !required->is_array()) return;
  for (const Json& name : *required) {
    const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
    if (std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), text) != kSupportedExtensions.end()) {
      continue;
    }
    std::string accepted;
    for (const std::string_view supported : kSupportedExtensions) {
      if (!accepted.empty()) accepted += ", ";
      accepted += supported;
    }
    throw std::runtime_error("it requires the extension " + text + ", which is not supported; supported are " +
                             accepted + "\nExport the model again without that extension.");
  }
}

std::size_t Document::size(const char* array_key) const {
  return array(*root_, array_key, "the file").size();
}

const Json& Document::element(const char* array_key, std::size_t index) const {
  const Json& elements = array(*root_, array_key, "the file");
  if (index >= elements.size()) {
    throw std::runtime_error(std::string("there is no element ") + std::to_string(index) + " in `" + array_key +
                             "`, it has " + std::to_string(elements.size()));
  }
  if (!elements[index].is_object()) {
    throw std::runtime_error(std::string("element ") + std::to_string(index) + " of `" + array_key +
                             "` is not an object");
  }
  return elements[index];
}

void Document::read_buffers() {
  for (std::size_t i = 0; i < size("buffers"); ++i) {
    const Json& buffer = element("buffers", i);
    const std::string where = "buffer " + std::to_string(i);
    const std::size_t length = count(buffer, "byteLength", where);
    Bytes bytes;
    if (find(buffer, "uri")) {
      bytes = resource(text_or(buffer, "uri", "", where), where);
    } else if (i == 0) {
      bytes = std::move(binary_chunk_);
    }
    if (bytes.size() < length) {
      throw std::runtime_error(where + " should have " + std::to_string(length) + " bytes, it has " +
                               std::to_string(bytes.size()));
    }
    bytes.resize(length);
    buffers_.push_back(std::move(bytes));
  }
}

std::span<const std::uint8_t> Document::view(std::size_t buffer_view) const {
  const Json& json = element("bufferViews", buffer_view);
  const std::string where = "buffer view " + std::to_string(buffer_view);
  const Bytes& buffer = buffers_[index(json, "buffer", buffers_.size(), where)];
  const std::size_t offset = count_or(json, "byteOffset", 0, where);
  const std::size_t length = count(json, "byteLength", where);
  if (offset > buffer.size() || length > buffer.size() - offset) {
    throw std::runtime_error(where + " ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                             std::to_string(buffer.size()));
  }
  return std::span(buffer).subspan(offset, length);
}

std::size_t Document::view_stride(std::size_t buffer_view) const {
  return count_or(element("bufferViews", buffer_view), "byteStride", 0, "buffer view " + std::to_string(buffer_view));
}

Bytes Document::resource(const std::string& uri, const std::string& where) const {
  if (uri.rfind("data:", 0) == 0) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos) {
      throw std::runtime_error(where + ": its data URI is not base64");
    }
    return decode_base64(std::string_view(uri).substr(comma + 1), where);
  }
  if (uri.empty() || uri.find("://") != std::string::npos) {
    throw std::runtime_error(where + ": `uri` is \"" + uri + "\", accepted is a base64 data URI or a file's name");
  }
  try {
    return read_file(folder_ / percent_decoded(uri));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(where + ": " + error.what());
  }
}

}  // namespace render::gltf
