#include "render/composite/merge_pass.h"

#include <algorithm>
#include <cstring>

#include "render/composite/picture_math.h"
#include "render/gl/error.h"

namespace render {

const gl::Program& MergePass::program(const LayersVariant& variant, bool wide_gamut) {
  const std::pair key(variant, wide_gamut);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    gl::Defines defines;
    variant.add_defines(defines);
    if (wide_gamut) defines.push_back({"WIDE_GAMUT"});
    found = programs_.emplace(key, gl::Program("lib/full_screen.vert", "composite/merge.frag", defines)).first;
    if (wide_gamut) found->second.set("picture_from_709", glm::mat3(bt2020_from_709()));
  }
  return found->second;
}

void MergePass::draw(const CompositeLayers& layers, const PixelRect& region, bool wide_gamut) {
  const View& view = *layers.view;
  if (targets_[0].width() != view.width || targets_[0].height() != view.height) {
    for (gl::Texture& target : targets_) {
      target = gl::Texture(GL_RGBA8, view.width, view.height, gl::Filter::Nearest, 1, "merged layers");
    }
    framebuffer_ = gl::Framebuffer({&targets_[0], &targets_[1]}, nullptr, "merged layers");
  }
  CompositeLayers ideal = layers;
  ideal.lens = nullptr;
  const gl::Program& merge = program(ideal.variant(), wide_gamut);
  framebuffer_.bind();
  merge.use();
  bind_layers(ideal, merge);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  glScissor(region.x, region.y, region.width, region.height);
  gl::draw_full_screen(no_vertices_);
  glDisable(GL_SCISSOR_TEST);
  region_ = region;
  gl::check_errors("merge");
}

const MergedPicture& MergePass::read() {
  const int width = targets_[0].width();
  const int height = targets_[0].height();
  picture_.width = width;
  picture_.height = height;
  picture_.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), MergedPixel{});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    packed_[i].resize(static_cast<std::size_t>(region_.width) * static_cast<std::size_t>(region_.height) * 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    glReadPixels(region_.x, region_.y, region_.width, region_.height, GL_RGBA, GL_UNSIGNED_BYTE, packed_[i].data());
  }
  gl::check_errors("read merged layers");
  const std::uint8_t* keep = packed_[0].data();
  const std::uint8_t* add = packed_[1].data();
  for (int y = 0; y < region_.height; ++y) {
    MergedPixel* row = picture_.pixels.data() + std::ptrdiff_t{region_.y + y} * width + region_.x;
    for (int x = 0; x < region_.width; ++x, keep += 4, add += 4) {
      std::memcpy(row[x].keep.data(), keep, 4);
      std::memcpy(row[x].add.data(), add, 4);
    }
  }
  return picture_;
}

}  // namespace render
