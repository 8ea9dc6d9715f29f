#include "data/generator/glb_writer.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "render/base/whole_file.h"
#include "render/images/image_codec.h"

namespace generator {
namespace {

using Json = nlohmann::json;
using render::Bytes;

constexpr int kJpegQuality = 91;  // above 90 the encoder keeps full chroma, which normal maps need
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;

template <typename T>
void append(Bytes& bytes, const T& value) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof value);
}

void pad(Bytes& bytes, std::uint8_t filler) {
  while (bytes.size() % 4 != 0) bytes.push_back(filler);
}

// glTF's axes from the world's: the inverse of (x, -z, y).
glm::vec3 gltf_from_world(const glm::vec3& v) {
  return {v.x, v.z, -v.y};
}

class Writer {
 public:
  explicit Writer(const render::Model& model) : model_(model) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "skyshaft-models"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    json_["nodes"] = Json::array({{{"mesh", 0}, {"name", model.name}}});
    for (const render::Image& image : model_.images) add_image(image);
    for (const render::Material& material : model_.materials) add_material(material);
    json_["meshes"] = Json::array({{{"name", model.name}, {"primitives", Json::array()}}});
    for (const render::Mesh& mesh : model_.meshes) add_primitive(mesh);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  }

  Bytes glb() {
    const std::string text = json_.dump();
    Bytes json(text.begin(), text.end());
    pad(json, ' ');
    pad(binary_, 0);
    Bytes file;
    append(file, std::uint32_t{0x46546C67});
    append(file, std::uint32_t{2});
    append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary_.size()));
    append(file, static_cast<std::uint32_t>(json.size()));
    append(file, std::uint32_t{0x4E4F534A});
    file.insert(file.end(), json.begin(), json.end());
    append(file, static_cast<std::uint32_t>(binary_.size()));
    append(file, std::uint32_t{0x004E4942});
    file.insert(file.end(), binary_.begin(), binary_.end());
    return file;
  }

 private:
  std::size_t add_view(const Bytes& bytes) {
    pad(binary_, 0);
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return json_["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(const Bytes& bytes, int component, const char* type, std::size_t count) {
    json_["accessors"].push_back(
        {{"bufferView", add_view(bytes)}, {"componentType", component}, {"type", type}, {"count", count}});
    return json_["accessors"].size() - 1;
  }

  void add_image(const render::Image& image) {
    bool opaque = true;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) opaque = opaque && image.rgba[i] == 255;
    const Bytes bytes = opaque ? render::encode_jpeg(image, kJpegQuality) : render::encode_png(image);
    json_["images"].push_back({{"bufferView", add_view(bytes)}, {"mimeType", opaque ? "image/jpeg" : "image/png"}});
    json_["textures"].push_back({{"source", json_["images"].size() - 1}});
  }

  void add_material(const render::Material& m) {
    Json pbr = {{"baseColorFactor", {m.base_color.r, m.base_color.g, m.base_color.b, m.base_color.a}},
                {"metallicFactor", m.metallic},
                {"roughnessFactor", m.roughness}};
    const auto use = [](Json& holder, const char* key, const render::TextureRef& ref) {
      if (ref.image >= 0) holder[key] = {{"index", ref.image}};
    };
    use(pbr, "baseColorTexture", m.base_color_texture);
    use(pbr, "metallicRoughnessTexture", m.metallic_roughness_texture);
    Json material = {{"name", m.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", m.double_sided}};
    use(material, "normalTexture", m.normal_texture);
    if (m.emissive != glm::vec3(0.0F)) material["emissiveFactor"] = {m.emissive.r, m.emissive.g, m.emissive.b};
    if (m.alpha_mode == render::AlphaMode::Mask) {
      material["alphaMode"] = "MASK";
      material["alphaCutoff"] = m.alpha_cutoff;
    }
    json_["materials"].push_back(material);
  }

  void add_primitive(const render::Mesh& mesh) {
    Bytes positions;
    Bytes normals;
    Bytes uvs;
    Bytes indices;
    glm::vec3 low(1e30F);
    glm::vec3 high(-1e30F);
    for (const render::Vertex& vertex : mesh.vertices) {
      const glm::vec3 position = gltf_from_world(vertex.position);
      low = glm::min(low, position);
      high = glm::max(high, position);
      append(positions, position);
      append(normals, gltf_from_world(vertex.normal));
      append(uvs, vertex.uv);
    }
    const bool narrow = mesh.vertices.size() < 65535;
    for (const std::uint32_t i : mesh.indices) {
      if (narrow) {
        append(indices, static_cast<std::uint16_t>(i));
      } else {
        append(indices, i);
      }
    }
    const std::size_t count = mesh.vertices.size();
    Json attributes;
    attributes["POSITION"] = add_accessor(positions, kFloat, "VEC3", count);
    json_["accessors"].back()["min"] = {low.x, low.y, low.z};
    json_["accessors"].back()["max"] = {high.x, high.y, high.z};
    attributes["NORMAL"] = add_accessor(normals, kFloat, "VEC3", count);
    attributes["TEXCOORD_0"] = add_accessor(uvs, kFloat, "VEC2", count);
    const std::size_t index_accessor =
        add_accessor(indices, narrow ? kUnsignedShort : kUnsignedInt, "SCALAR", mesh.indices.size());
    json_["meshes"][0]["primitives"].push_back(
        {{"attributes", attributes}, {"indices", index_accessor}, {"material", mesh.material}});
  }

  const render::Model& model_;
  Json json_;
  Bytes binary_;
};

}  // namespace

void write_glb(const std::filesystem::path& path, const render::Model& model) {
  render::write_file_whole(path, Writer(model).glb());
}

}  // namespace generator
