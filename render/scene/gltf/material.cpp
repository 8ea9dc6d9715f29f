#include "render/scene/gltf/material.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render/images/image_codec.h"

namespace render::gltf {
namespace {

enum Wrap : std::size_t { Repeat = 10497, ClampToEdge = 33071, MirroredRepeat = 33648 };

TextureWrap wrap_of(std::size_t code, const std::string& where) {
  switch (code) {
    case Repeat:
      return TextureWrap::Repeat;
    case ClampToEdge:
      return TextureWrap::Clamp;
    case MirroredRepeat:
      return TextureWrap::Mirror;
    default:
      throw std::runtime_error(where + ": wrap mode is " + std::to_string(code) +
                               ", accepted are 10497, 33071 and 33648");
  }
}

TextureWrap sampler_wrap(const Json& sampler, const std::string& where) {
  const std::size_t s = count_or(sampler, "wrapS", Repeat, where);
  const std::size_t t = count_or(sampler, "wrapT", Repeat, where);
  if (s != t) spdlog::warn("{}: wrapT differs from wrapS; wrapS is used for both", where);
  return wrap_of(s, where);
}

// KHR_texture_transform: translation * rotation * scale.
glm::mat3 texture_transform(const Json& extension, const std::string& where) {
  std::array<double, 2> offset{0.0, 0.0};
  std::array<double, 2> scale{1.0, 1.0};
  numbers(extension, "offset", offset, where);
  numbers(extension, "scale", scale, where);
  const double angle = number_or(extension, "rotation", 0.0, where);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return glm::mat3(
      glm::dmat3(c * scale[0], -s * scale[0], 0.0, s * scale[1], c * scale[1], 0.0, offset[0], offset[1], 1.0));
}

float check_range(double value, double least, double most, const char* key, const std::string& where) {
  if (value >= least && value <= most) return static_cast<float>(value);
  throw std::runtime_error(fmt::format("{}: `{}` is {:g}, accepted is {:g} to {:g}", where, key, value, least, most));
}

float in_unit_range(const Json& object, const char* key, double otherwise, const std::string& where) {
  return check_range(number_or(object, key, otherwise, where), 0.0, 1.0, key, where);
}

AlphaMode alpha_mode(const Json& material, const std::string& where) {
  const std::string mode = text_or(material, "alphaMode", "OPAQUE", where);
  if (mode == "OPAQUE") return AlphaMode::Opaque;
  if (mode == "MASK") return AlphaMode::Mask;
  if (mode == "BLEND") return AlphaMode::Blend;
  throw std::runtime_error(where + ": `alphaMode` is \"" + mode + "\", accepted are OPAQUE, MASK and BLEND");
}

}  // namespace

int MaterialReader::load_image(std::size_t index) {
  if (const auto known = image_of_.find(index); known != image_of_.end()) return known->second;
  const Json& image = document_.element("images", index);
  const std::string where = "image " + std::to_string(index);
  Image decoded;
  if (const auto view = optional_index(image, "bufferView", document_.size("bufferViews"), where)) {
    const std::span<const std::uint8_t> bytes = document_.view(*view);
    try {
      decoded = decode_image(bytes);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(where + ": " + error.what());
    }
  } else {
    const std::string uri = text_or(image, "uri", "", where);
    const Bytes bytes = document_.resource(uri, where);
    try {
      decoded = decode_image(bytes);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(where + (uri.rfind("data:", 0) == 0 ? "" : " ('" + uri + "')") + ": " + error.what());
    }
  }
  model_.images.push_back(std::move(decoded));
  const int loaded = static_cast<int>(model_.images.size()) - 1;
  image_of_[index] = loaded;
  return loaded;
}

MaterialReader::Texture MaterialReader::read_texture(const Json& info, const std::string& where) {
  Texture result;
  const std::size_t texture_index = index(info, "index", document_.size("textures"), where);
  const Json& texture = document_.element("textures", texture_index);
  const std::string texture_where = "texture " + std::to_string(texture_index);
  result.uv_set = count_or(info, "texCoord", 0, where);
  if (const Json* transform = extension(info, "KHR_texture_transform")) {
    result.texture_from_mesh = texture_transform(*transform, where);
    result.uv_set = count_or(*transform, "texCoord", result.uv_set, where);
  }
  const auto sampler = optional_index(texture, "sampler", document_.size("samplers"), texture_where);
  if (sampler) {
    result.ref.wrap = sampler_wrap(document_.element("samplers", *sampler), "sampler " + std::to_string(*sampler));
  }
  const auto source = optional_index(texture, "source", document_.size("images"), texture_where);
  if (!source) {
    spdlog::warn("{} has no image in PNG or JPEG; it is left out", texture_where);
    return result;
  }
  result.ref.image = load_image(*source);
  return result;
}

void MaterialReader::use(const Json& holder, const char* key, TextureRef& ref, MaterialSource& source,
                         const std::string& where) {
  const Json* info = find(holder, key);
  if (!info) return;
  const Texture texture = read_texture(*info, where + ", " + key);
  if (texture.ref.image < 0) return;
  if (!coordinates_set_) {
    source.uv_set = texture.uv_set;
    source.texture_from_mesh = texture.texture_from_mesh;
    coordinates_set_ = true;
  } else if (texture.uv_set != source.uv_set || texture.texture_from_mesh != source.texture_from_mesh) {
    spdlog::warn("{}: {} uses other texture coordinates than the textures before it; it is left out", where, key);
    return;
  }
  ref = texture.ref;
}

MaterialSource MaterialReader::read(std::size_t material_index) {
  const Json& json = document_.element("materials", material_index);
  const std::string where = "material " + std::to_string(material_index);
  coordinates_set_ = false;
  MaterialSource source;
  Material& material = source.material;
  material.name = text_or(json, "name", "", where);
  static const Json kNone = Json::object();
  const Json* found = find(json, "pbrMetallicRoughness");
  const Json& pbr = found ? *found : kNone;
  std::array<double, 4> color{1.0, 1.0, 1.0, 1.0};
  numbers(pbr, "baseColorFactor", color, where);
  for (const double factor : color) check_range(factor, 0.0, 1.0, "baseColorFactor", where);
  material.base_color = glm::vec4(glm::dvec4(color[0], color[1], color[2], color[3]));
  material.metallic = in_unit_range(pbr, "metallicFactor", 1.0, where);
  material.roughness = in_unit_range(pbr, "roughnessFactor", 1.0, where);
  use(pbr, "baseColorTexture", material.base_color_texture, source, where);
  use(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture, source, where);
  use(json, "normalTexture", material.normal_texture, source, where);
  if (const Json* info = find(json, "normalTexture")) {
    material.normal_scale = check_range(number_or(*info, "scale", 1.0, where), -1e3, 1e3, "scale", where);
  }
  use(json, "emissiveTexture", material.emissive_texture, source, where);
  use(json, "occlusionTexture", material.occlusion_texture, source, where);
  if (const Json* info = find(json, "occlusionTexture")) {
    material.occlusion_strength = in_unit_range(*info, "strength", 1.0, where);
  }
  std::array<double, 3> emissive{0.0, 0.0, 0.0};
  numbers(json, "emissiveFactor", emissive, where);
  for (const double factor : emissive) check_range(factor, 0.0, 1.0, "emissiveFactor", where);
  const Json* strength = extension(json, "KHR_materials_emissive_strength");
  const double scale = strength ? number_or(*strength, "emissiveStrength", 1.0, where) : 1.0;
  check_range(scale, 0.0, 1e6, "emissiveStrength", where);
  material.emissive = glm::vec3(glm::dvec3(emissive[0], emissive[1], emissive[2]) * scale);
  material.alpha_mode = alpha_mode(json, where);
  material.alpha_cutoff = check_range(number_or(json, "alphaCutoff", 0.5, where), 0.0, 1e3, "alphaCutoff", where);
  material.double_sided = flag_or(json, "doubleSided", false, where);
  return source;
}

}  // namespace render::gltf
