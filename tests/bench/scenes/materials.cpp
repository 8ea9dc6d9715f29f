#include "tests/bench/scenes/scenes.h"

namespace bench_scenes {

int add_material(render::Model& model, const std::string& name, std::vector<render::Image> images, float roughness) {
  render::Material material;
  material.name = name;
  material.metallic = 0.0F;
  material.roughness = roughness;
  const auto first = static_cast<int>(model.images.size());
  if (!images.empty()) material.base_color_texture.image = first;
  if (images.size() > 1) material.normal_texture.image = first + 1;
  for (render::Image& image : images) model.images.push_back(std::move(image));
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

int add_material(render::Model& model, const std::string& name, const glm::vec3& linear_rgb, float roughness) {
  const int index = add_material(model, name, std::vector<render::Image>{}, roughness);
  model.materials.back().base_color = glm::vec4(linear_rgb, 1.0F);
  return index;
}

}  // namespace bench_scenes
