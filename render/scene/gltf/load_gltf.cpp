#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "render/scene/gltf/document.h"
#include "render/scene/gltf/material.h"
#include "render/scene/gltf/primitive.h"
#include "render/scene/mesh_tools.h"
#include "render/scene/model.h"

namespace render {
namespace {

using gltf::Document;
using gltf::Json;

// (x, y, z) of glTF is (x, -z, y) here.
const glm::dmat4 kModelFromGltf(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);

// A node whose turn is still to come.
struct PlacedNode {
  std::size_t node;
  glm::dmat4 model_from_parent;
};

glm::dmat4 parent_from_node(const Json& node, const std::string& where) {
  std::array<double, 16> matrix{};
  if (gltf::numbers(node, "matrix", matrix, where)) {
    glm::dmat4 result(1.0);
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = matrix[static_cast<std::size_t>(i)];
    return result;
  }
  std::array<double, 3> t{0, 0, 0};
  std::array<double, 4> q{0, 0, 0, 1};
  std::array<double, 3> s{1, 1, 1};
  gltf::numbers(node, "translation", t, where);
  gltf::numbers(node, "rotation", q, where);
  gltf::numbers(node, "scale", s, where);
  const glm::dquat rotation(q[3], q[0], q[1], q[2]);
  if (!(glm::length(rotation) > 1e-6)) throw std::runtime_error(where + ": `rotation` is zero");
  return glm::translate(glm::dmat4(1.0), glm::dvec3(t[0], t[1], t[2])) * glm::mat4_cast(glm::normalize(rotation)) *
         glm::scale(glm::dmat4(1.0), glm::dvec3(s[0], s[1], s[2]));
}

// Positions, normals and tangents through `model_from_mesh`; a mirroring turns the winding and the handedness too.
void transform(Mesh& mesh, const glm::dmat4& model_from_mesh, const std::string& where) {
  const glm::dmat3 linear(model_from_mesh);
  const double determinant = glm::determinant(linear);
  // The cofactor matrix is the inverse transpose times the determinant; it exists for flattened nodes too.
  const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  const double side = determinant < 0.0 ? -1.0 : 1.0;
  for (Vertex& vertex : mesh.vertices) {
    vertex.position = glm::vec3(model_from_mesh * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    vertex.normal = glm::vec3(side * (cofactor * glm::dvec3(vertex.normal)));
    vertex.tangent = glm::vec4(glm::vec3(linear * glm::dvec3(vertex.tangent)), side * vertex.tangent.w);
    if (!std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z)) {
      throw std::runtime_error(where + ": a vertex lies at infinity");
    }
  }
  for (std::size_t i = 0; determinant < 0.0 && i + 2 < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  repair_normals(mesh);
  repair_tangents(mesh);
}

class Flattener {
 public:
  Flattener(const Document& document, Model& model)
      : document_(document), model_(model), materials_(document, model), reached_(document.size("nodes"), 0) {}

  void run() {
    std::vector<PlacedNode> open;
    for (const std::size_t root : roots()) open.push_back({root, kModelFromGltf});
    while (!open.empty()) {
      const PlacedNode placed = open.back();
      open.pop_back();
      visit(placed, open);
    }
  }

 private:
  // The default scene's nodes; without a scene, all nodes that are nobody's child.
  std::vector<std::size_t> roots() const {
    const std::size_t node_count = document_.size("nodes");
    if (document_.size("scenes") > 0) {
      const std::size_t scene =
          gltf::optional_index(document_.root(), "scene", document_.size("scenes"), "the file").value_or(0);
      return node_list(document_.element("scenes", scene), "nodes", "scene " + std::to_string(scene));
    }
    std::vector<char> is_child(node_count, 0);
    for (std::size_t i = 0; i < node_count; ++i) {
      const std::string where = "node " + std::to_string(i);
      for (const std::size_t child : node_list(document_.element("nodes", i), "children", where)) is_child[child] = 1;
    }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < node_count; ++i) {
      if (!is_child[i]) result.push_back(i);
    }
    return result;
  }

  std::vector<std::size_t> node_list(const Json& object, const char* key, const std::string& where) const {
    std::vector<std::size_t> result;
    const std::size_t node_count = document_.size("nodes");
    for (const Json& element : gltf::array(object, key, where)) {
      if (!element.is_number_unsigned() || element.get<std::uint64_t>() >= node_count) {
        throw std::runtime_error(where + ": `" + key + "` names node " + element.dump() + ", but there are " +
                                 std::to_string(node_count));
      }
      result.push_back(element.get<std::size_t>());
    }
    return result;
  }

  void visit(const PlacedNode& placed, std::vector<PlacedNode>& open) {
    const Json& node = document_.element("nodes", placed.node);
    const std::string where = "node " + std::to_string(placed.node);
    if (reached_[placed.node]) throw std::runtime_error(where + " is reached twice; nodes must form trees");
    reached_[placed.node] = 1;
    const glm::dmat4 model_from_node = placed.model_from_parent * parent_from_node(node, where);
    if (const auto mesh = gltf::optional_index(node, "mesh", document_.size("meshes"), where)) {
      if (gltf::find(node, "skin")) spdlog::warn("{} is skinned; it is shown in its bind pose", where);
      add_mesh(*mesh, model_from_node);
    }
    for (const std::size_t child : node_list(node, "children", where)) open.push_back({child, model_from_node});
  }

  void add_mesh(std::size_t mesh_index, const glm::dmat4& model_from_mesh) {
    const std::string where = "mesh " + std::to_string(mesh_index);
    const Json& primitives = gltf::array(document_.element("meshes", mesh_index), "primitives", where);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const std::string place = where + ", primitive " + std::to_string(i);
      const int material = material_of(primitives[i], place);
      std::optional<Mesh> mesh =
          gltf::read_primitive(document_, primitives[i], sources_[static_cast<std::size_t>(material)], place);
      if (!mesh) continue;
      mesh->material = material;
      transform(*mesh, model_from_mesh, place);
      model_.meshes.push_back(std::move(*mesh));
    }
  }

  // The model's material for a primitive; materials come in the order of their first use.
  int material_of(const Json& primitive, const std::string& where) {
    const auto used = gltf::optional_index(primitive, "material", document_.size("materials"), where);
    const auto known = material_of_.find(used);
    if (known != material_of_.end()) return known->second;
    sources_.push_back(used ? materials_.read(*used) : gltf::MaterialSource{});
    model_.materials.push_back(sources_.back().material);
    const int added = static_cast<int>(sources_.size()) - 1;
    material_of_[used] = added;
    return added;
  }

  const Document& document_;
  Model& model_;
  gltf::MaterialReader materials_;
  std::vector<gltf::MaterialSource> sources_;
  std::map<std::optional<std::size_t>, int> material_of_;
  std::vector<char> reached_;
};

}  // namespace

Model load_gltf(const std::filesystem::path& path) {
  try {
    const Document document(path);
    Model model;
    model.name = path.stem().string();
    Flattener(document, model).run();
    if (model.triangle_count() == 0) throw std::runtime_error("its scene has no triangles");
    update_bounds(model);
    model.convex_pieces = find_convex_pieces(model);
    return model;
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot load model '" + path.string() + "': " + error.what());
  }
}

}  // namespace render
