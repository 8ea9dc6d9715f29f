#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Hand-made tiny glTF files for the tests of the reader.
namespace test {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// A folder of this test's own, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "skyshaft_test_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

template <typename T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Collects a model's JSON and its binary buffer.
class GltfMaker {
 public:
  Json json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", Json::array({Json::object()})}}}}};
  Bytes binary;

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }

  // Appends bytes as a buffer view; returns its index.
  std::size_t view(const Bytes& bytes, std::size_t stride = 0) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    json["bufferViews"].push_back(view);
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return json["bufferViews"].size() - 1;
  }

  std::size_t accessor(std::size_t view_index, int component_type, const char* type, std::size_t count) {
    json["accessors"].push_back(
        {{"bufferView", view_index}, {"componentType", component_type}, {"type", type}, {"count", count}});
    return json["accessors"].size() - 1;
  }

  template <typename T>
  void attribute(const char* name, const std::vector<T>& values, int component_type, const char* type,
                 std::size_t components) {
    primitive()["attributes"][name] =
        accessor(view(bytes_of(values)), component_type, type, values.size() / components);
  }
  void positions(const std::vector<float>& xyz) { attribute("POSITION", xyz, 5126, "VEC3", 3); }

  Bytes glb() {
    json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    Bytes data = binary;
    while (data.size() % 4 != 0) data.push_back(0);
    std::vector<std::uint32_t> head = {0x46546C67, 2, static_cast<std::uint32_t>(28 + text.size() + data.size()),
                                       static_cast<std::uint32_t>(text.size()), 0x4E4F534A};
    Bytes file = bytes_of(head);
    file.insert(file.end(), text.begin(), text.end());
    const Bytes chunk = bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(data.size()), 0x004E4942});
    file.insert(file.end(), chunk.begin(), chunk.end());
    file.insert(file.end(), data.begin(), data.end());
    return file;
  }
};

// A right triangle in glTF's x, y plane, seen from +z.
inline GltfMaker triangle() {
  GltfMaker maker;
  maker.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return maker;
}

}  // namespace test
