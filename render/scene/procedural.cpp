#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <string>

#include "render/scene/mesh_tools.h"
#include "render/scene/model.h"

namespace render {
namespace {

// A rectangle about `centre` with half edges u and v; its normal is u x v, its texture coordinates are in metres,
// v downwards as in pictures.
void add_rectangle(Mesh& mesh, const glm::vec3& centre, const glm::vec3& u, const glm::vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(u, v));
  const glm::vec4 tangent(glm::normalize(u), 1.0F);
  const glm::vec2 size(2.0F * glm::length(u), 2.0F * glm::length(v));
  for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    const glm::vec2 side = 2.0F * corner - 1.0F;
    mesh.vertices.push_back(
        {centre + side.x * u + side.y * v, normal, tangent, glm::vec2(corner.x, 1.0F - corner.y) * size});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
}

Model one_mesh_model(const char* name, Mesh mesh) {
  Model model;
  model.name = name;
  Material material;
  material.name = name;
  material.base_color = glm::vec4(0.18F, 0.18F, 0.18F, 1.0F);  // photographers' middle grey
  material.metallic = 0.0F;
  model.materials.push_back(material);
  model.meshes.push_back(std::move(mesh));
  update_bounds(model);
  model.convex_pieces = find_convex_pieces(model);
  return model;
}

void check_positive(const char* what, float value) {
  if (!(value > 0.0F))
    throw std::runtime_error(std::string(what) + " must be positive, found " + std::to_string(value));
}

}  // namespace

std::size_t Model::triangle_count() const {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.indices.size() / 3;
  return count;
}

Model make_ground(float half_size_m) {
  check_positive("the ground's half size", half_size_m);
  Mesh mesh;
  add_rectangle(mesh, glm::vec3(0.0F), {half_size_m, 0, 0}, {0, half_size_m, 0});
  return one_mesh_model("ground", std::move(mesh));
}

Model make_box(const glm::vec3& size_m) {
  for (int axis = 0; axis < 3; ++axis) check_positive("a box's edge", size_m[axis]);
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-0.5F, 0.5F}) {
      glm::vec3 out(0.0F);
      glm::vec3 u(0.0F);
      glm::vec3 v(0.0F);
      out[axis] = side * size_m[axis];
      u[(axis + 1) % 3] = side * size_m[(axis + 1) % 3];  // the sign keeps u x v pointing outwards
      v[(axis + 2) % 3] = 0.5F * size_m[(axis + 2) % 3];
      add_rectangle(mesh, out, u, v);
    }
  }
  return one_mesh_model("box", std::move(mesh));
}

glm::dmat4 place_model(const glm::dvec3& position_in_world, double heading_rad, double scale) {
  const glm::dmat4 world_from_turned = glm::translate(glm::dmat4(1.0), position_in_world);
  // A heading grows clockwise seen from above, a rotation about +z counter-clockwise.
  const glm::dmat4 turned_from_scaled = glm::rotate(glm::dmat4(1.0), -heading_rad, glm::dvec3(0, 0, 1));
  return world_from_turned * turned_from_scaled * glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
}

}  // namespace render
