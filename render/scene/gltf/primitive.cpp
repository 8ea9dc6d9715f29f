#include "render/scene/gltf/primitive.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "render/scene/gltf/accessor.h"
#include "render/scene/mesh_tools.h"

namespace render::gltf {
namespace {

enum Mode : std::size_t { Triangles = 4, TriangleStrip = 5, TriangleFan = 6 };

using Indices = std::vector<std::uint32_t>;

void add_triangle(Indices& out, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  // Strips join their parts with triangles that have no area.
  if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
}

Indices as_triangles(const Indices& in, std::size_t mode) {
  Indices out;
  out.reserve(mode == Triangles ? in.size() : in.size() * 3);
  if (mode == Triangles) {
    for (std::size_t i = 0; i + 2 < in.size(); i += 3) add_triangle(out, in[i], in[i + 1], in[i + 2]);
  } else if (mode == TriangleStrip) {
    for (std::size_t i = 0; i + 2 < in.size(); ++i) add_triangle(out, in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]);
  } else {
    for (std::size_t i = 1; i + 1 < in.size(); ++i) add_triangle(out, in[i], in[i + 1], in[0]);
  }
  return out;
}

std::vector<float> attribute(const Document& document, const Json& attributes, const std::string& name,
                             std::size_t components, std::size_t vertex_count, const std::string& where) {
  const auto accessor = optional_index(attributes, name.c_str(), document.size("accessors"), where);
  if (!accessor) return {};
  std::vector<float> values = read_floats(document, *accessor, components);
  if (values.size() != vertex_count * components) {
    throw std::runtime_error(where + ": " + name + " has " + std::to_string(values.size() / components) +
                             " elements, POSITION has " + std::to_string(vertex_count));
  }
  return values;
}

Mesh read_positions(const Document& document, const Json& attributes, const std::string& where) {
  const std::size_t accessor = index(attributes, "POSITION", document.size("accessors"), where);
  const std::vector<float> values = read_floats(document, accessor, 3);
  Mesh mesh;
  mesh.vertices.resize(values.size() / 3, Vertex{glm::vec3(0.0F), glm::vec3(0.0F), glm::vec4(0.0F), glm::vec2(0.0F)});
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const glm::vec3 position(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
      throw std::runtime_error(where + ": the position of vertex " + std::to_string(i) + " is not finite");
    }
    mesh.vertices[i].position = position;
  }
  return mesh;
}

Indices read_primitive_indices(const Document& document, const Json& primitive, std::size_t vertex_count,
                               const std::string& where) {
  const auto accessor = optional_index(primitive, "indices", document.size("accessors"), where);
  if (!accessor) {
    Indices in_order(vertex_count);
    std::iota(in_order.begin(), in_order.end(), 0U);
    return in_order;
  }
  Indices indices = read_indices(document, *accessor);
  for (const std::uint32_t i : indices) {
    if (i >= vertex_count) {
      throw std::runtime_error(where + ": index " + std::to_string(i) + " of " + std::to_string(vertex_count) +
                               " vertices");
    }
  }
  return indices;
}

void read_texture_coordinates(const Document& document, const Json& attributes, const MaterialSource& source,
                              const std::string& where, Mesh& mesh) {
  const std::string name = "TEXCOORD_" + std::to_string(source.uv_set);
  const std::vector<float> values = attribute(document, attributes, name, 2, mesh.vertices.size(), where);
  for (std::size_t i = 0; i * 2 < values.size(); ++i) {
    const glm::vec2 uv(source.texture_from_mesh * glm::vec3(values[2 * i], values[2 * i + 1], 1.0F));
    mesh.vertices[i].uv = std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : glm::vec2(0.0F);
  }
}

void read_normals_and_tangents(const Document& document, const Json& attributes, const std::string& where, Mesh& mesh) {
  const std::vector<float> normals = attribute(document, attributes, "NORMAL", 3, mesh.vertices.size(), where);
  const std::vector<float> tangents = attribute(document, attributes, "TANGENT", 4, mesh.vertices.size(), where);
  for (std::size_t i = 0; i * 3 < normals.size(); ++i) {
    mesh.vertices[i].normal = {normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]};
  }
  for (std::size_t i = 0; i * 4 < tangents.size(); ++i) {
    mesh.vertices[i].tangent = {tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2], tangents[4 * i + 3]};
  }
  if (normals.empty()) {
    make_flat_normals(mesh);
  } else {
    repair_normals(mesh);
  }
  // glTF: tangents without normals mean nothing.
  if (normals.empty() || tangents.empty()) {
    make_tangents(mesh);
  } else {
    repair_tangents(mesh);
  }
}

}  // namespace

std::optional<Mesh> read_primitive(const Document& document, const Json& primitive, const MaterialSource& source,
                                   const std::string& where) {
  const std::size_t mode = count_or(primitive, "mode", Triangles, where);
  if (mode > TriangleFan) {
    throw std::runtime_error(where + ": `mode` is " + std::to_string(mode) + ", accepted is 0 to 6");
  }
  if (mode < Triangles) {
    spdlog::warn("{} is points or lines; it is left out", where);
    return std::nullopt;
  }
  const Json* attributes = find(primitive, "attributes");
  if (!attributes || !find(*attributes, "POSITION")) {
    spdlog::warn("{} has no POSITION; it is left out", where);
    return std::nullopt;
  }
  Mesh mesh = read_positions(document, *attributes, where);
  mesh.indices = as_triangles(read_primitive_indices(document, primitive, mesh.vertices.size(), where), mode);
  if (mesh.indices.empty()) return std::nullopt;
  read_texture_coordinates(document, *attributes, source, where, mesh);
  read_normals_and_tangents(document, *attributes, where, mesh);
  return mesh;
}

}  // namespace render::gltf
