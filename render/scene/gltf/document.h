#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/base/whole_file.h"
#include "render/scene/gltf/json.h"

namespace render::gltf {

// A glTF 2.0 file's JSON and its buffers' bytes, from .glb or .gltf (told apart by their first bytes); nothing of their
// meaning. Errors are std::runtime_error without the model file's name: load_gltf() puts it in front.
class Document {
 public:
  // Reads the file and all buffers, embedded, base64 or beside it. Throws when truncated, not glTF 2, or when it
  // requires an extension that is not supported.
  explicit Document(const std::filesystem::path& path);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const Json& root() const { return *root_; }
  // Number of elements of a root array such as "nodes"; element `index` of it.
  std::size_t size(const char* array_key) const;
  const Json& element(const char* array_key, std::size_t index) const;

  // The bytes of a buffer view, inside its buffer for certain, and its stride (0: tightly packed).
  std::span<const std::uint8_t> view(std::size_t buffer_view) const;
  std::size_t view_stride(std::size_t buffer_view) const;

  // The bytes that a `uri` names: a base64 data URI, or a file relative to the model's folder.
  Bytes resource(const std::string& uri, const std::string& where) const;

 private:
  void read_container(const Bytes& file);
  void check_extensions() const;
  void read_buffers();

  std::filesystem::path folder_;
  std::unique_ptr<Json> root_;
  Bytes binary_chunk_;
  std::vector<Bytes> buffers_;
};

}  // namespace render::gltf
