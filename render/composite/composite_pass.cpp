#include "render/composite/composite_pass.h"

#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include "render/composite/encode_variant.h"
#include "render/composite/picture_math.h"
#include "render/composite/planes.h"
#include "render/gl/buffer.h"
#include "render/gl/error.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"

namespace render {
namespace {

// Samples that one fragment of the encoding shader makes.
glm::ivec2 block_size(const PictureFormat& format) {
  return {format.bit_depth > 8 ? 2 : 4, format.chroma == Chroma::C420 ? 2 : 1};
}

void set_fixed_uniforms(const gl::Program& program, const PictureFormat& format) {
  const CodeTransform decode = rgb_from_code(format);
  const CodeTransform encode = code_from_rgb(format);
  const CodeLimits limits = code_limits(format);
  program.set("rgb_from_code", glm::mat3(decode.matrix));
  program.set("rgb_offset", glm::vec3(decode.offset));
  program.set("code_from_rgb", glm::mat3(encode.matrix));
  program.set("code_offset", glm::vec3(encode.offset));
  program.set("code_min", static_cast<float>(limits.min));
  program.set("code_max", static_cast<float>(limits.max));
  program.set("picture_last", glm::ivec2(format.width, format.height) - 1);
  program.set("chroma_last", plane_size(format, 1) - 1);
  if (program.has("picture_from_709")) program.set("picture_from_709", glm::mat3(bt2020_from_709()));
}

// Packed samples of the encoded picture on their way to the planes.
struct Staging {
  std::vector<std::uint8_t> bytes;

  // The attachment's texels [x, x + width) x [y, y + height), packed.
  const std::uint8_t* read(int attachment, int x, int y, int width, int height) {
    bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return bytes.data();
  }
};

}  // namespace

struct CompositePass::Impl {
  std::optional<PictureFormat> format;  // of the textures and targets
  std::array<gl::Texture, 3> planes;
  std::array<gl::Texture, 3> targets;
  gl::Framebuffer framebuffer;
  std::map<LayersVariant, gl::Program> programs;
  gl::VertexArray no_vertices;
  Staging staging;

  void set_format(const PictureFormat& wanted) {
    if (format == wanted) return;
    check_format(wanted);
    const GLenum sample_format = wanted.bit_depth > 8 ? GL_R16UI : GL_R8;
    for (int p = 0; p < 3; ++p) {
      const glm::ivec2 size = plane_size(wanted, p);
      planes[static_cast<std::size_t>(p)] =
          gl::Texture(sample_format, size.x, size.y, gl::Filter::Nearest, 1, "source plane");
    }
    const glm::ivec2 block = block_size(wanted);
    const glm::ivec2 blocks = (glm::ivec2(wanted.width, wanted.height) + block - 1) / block;
    for (gl::Texture& target : targets) {
      target = gl::Texture(GL_RGBA8, blocks.x, blocks.y, gl::Filter::Nearest, 1, "encoded");
    }
    if (wanted.chroma == Chroma::C422) {
      framebuffer = gl::Framebuffer({&targets[0], &targets[1]}, nullptr, "encoded");
    } else {
      framebuffer = gl::Framebuffer({&targets[0], &targets[1], &targets[2]}, nullptr, "encoded");
    }
    programs.clear();
    format = wanted;
  }

  const gl::Program& program(const LayersVariant& variant) {
    auto found = programs.find(variant);
    if (found == programs.end()) {
      gl::Defines defines = encode_defines(*format);
      variant.add_defines(defines);
      gl::Program made("lib/full_screen.vert", "composite/encode.frag", defines);
      set_fixed_uniforms(made, *format);
      found = programs.emplace(variant, std::move(made)).first;
    }
    return found->second;
  }

  // Rows of packed samples of one plane: texel rows of `attachment` become plane rows first_row, + row_step, ...
  // Straight into the plane where its rows allow it.
  void read_plane(const MutablePictureView& out, int plane, int attachment, const PixelRect& texels, int first_row,
                  int row_step) {
    const auto p = static_cast<std::size_t>(plane);
    const int x_bytes = texels.x * 4;
    const int row_bytes = plane_size(out.format, plane).x * sample_bytes(out.format);
    const int rows_there = (plane_size(out.format, plane).y - first_row + row_step - 1) / row_step;
    const int rows = std::min(texels.height, rows_there);
    std::uint8_t* first = out.plane[p] + first_row * out.stride_bytes[p] + x_bytes;
    const std::ptrdiff_t step = out.stride_bytes[p] * row_step;
    const bool fits = x_bytes + texels.width * 4 <= row_bytes;
    if (fits && step > 0 && step % 4 == 0) {
      glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
      glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(step / 4));
      glReadPixels(texels.x, texels.y, texels.width, rows, GL_RGBA, GL_UNSIGNED_BYTE, first);
      glPixelStorei(GL_PACK_ROW_LENGTH, 0);
      return;
    }
    const std::uint8_t* from = staging.read(attachment, texels.x, texels.y, texels.width, rows);
    const auto bytes = static_cast<std::size_t>(std::min(texels.width * 4, row_bytes - x_bytes));
    for (int y = 0; y < rows; ++y) std::memcpy(first + y * step, from + y * texels.width * 4, bytes);
  }

  // Texels that hold two bytes of Cb, then two of Cr.
  void read_chroma(const MutablePictureView& out, int attachment, const PixelRect& texels) {
    const glm::ivec2 size = plane_size(out.format, 1);
    const int row_bytes = size.x * sample_bytes(out.format);
    const int rows = std::min(texels.height, size.y - texels.y);
    const std::uint8_t* from = staging.read(attachment, texels.x, texels.y, texels.width, rows);
    for (int y = 0; y < rows; ++y) {
      std::uint8_t* cb = out.plane[1] + (texels.y + y) * out.stride_bytes[1] + texels.x * 2;
      std::uint8_t* cr = out.plane[2] + (texels.y + y) * out.stride_bytes[2] + texels.x * 2;
      // An odd number of 8-bit samples leaves half of the last texel outside.
      const int whole = std::min(texels.width, row_bytes / 2 - texels.x);
      for (int x = 0; x < whole; ++x, from += 4) {
        std::memcpy(cb + 2 * x, from, 2);
        std::memcpy(cr + 2 * x, from + 2, 2);
      }
      if (whole < texels.width) {
        cb[2 * whole] = from[0];
        cr[2 * whole] = from[2];
        from += 4 * (texels.width - whole);
      }
    }
  }
};

CompositePass::CompositePass() : impl_(std::make_unique<Impl>()) {}
CompositePass::~CompositePass() = default;

PixelRect CompositePass::region(const PictureFormat& format, const PixelRect& changed) {
  if (changed.empty()) return {};
  // A chroma sample's filter reaches one pixel to each side.
  const glm::ivec2 reach = 2 * chroma_shift(format.chroma);
  const glm::ivec2 block = block_size(format);
  const glm::ivec2 size(format.width, format.height);
  const glm::ivec2 from = glm::max(glm::ivec2(changed.x, changed.y) - reach, glm::ivec2(0)) / block * block;
  const glm::ivec2 reached = glm::ivec2(changed.x + changed.width, changed.y + changed.height) + reach;
  const glm::ivec2 to = glm::min((reached + block - 1) / block * block, size);
  if (to.x <= from.x || to.y <= from.y) return {};
  return {from.x, from.y, to.x - from.x, to.y - from.y};
}

void CompositePass::upload(const PictureView& in, const PixelRect& region) {
  impl_->set_format(in.format);
  // Upsampling chroma reads up to two samples beyond the block.
  constexpr int kReach = 8;
  const PixelRect wide{std::max(region.x - kReach, 0), std::max(region.y - kReach, 0), region.width + 2 * kReach,
                       region.height + 2 * kReach};
  const bool words = in.format.bit_depth > 8;
  for (int plane = 0; plane < 3; ++plane) {
    const auto p = static_cast<std::size_t>(plane);
    const PixelRect r = plane_rect(in.format, plane, wide);
    const std::uint8_t* first = in.plane[p] + r.y * in.stride_bytes[p] + r.x * sample_bytes(in.format);
    impl_->planes[p].upload(r.x, r.y, r.width, r.height, words ? GL_RED_INTEGER : GL_RED,
                            words ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, first, in.stride_bytes[p]);
  }
}

void CompositePass::draw(const CompositeLayers& layers, const PixelRect& region) {
  Impl& impl = *impl_;
  const gl::Program& program = impl.program(layers.variant());
  impl.framebuffer.bind();
  program.use();
  program.bind("source_y", impl.planes[0].handle());
  program.bind("source_cb", impl.planes[1].handle());
  program.bind("source_cr", impl.planes[2].handle());
  bind_layers(layers, program);
  const glm::ivec2 block = block_size(*impl.format);
  const glm::ivec2 from = glm::ivec2(region.x, region.y) / block;
  const glm::ivec2 to = (glm::ivec2(region.x + region.width, region.y + region.height) + block - 1) / block;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_SCISSOR_TEST);
  glScissor(from.x, from.y, to.x - from.x, to.y - from.y);
  gl::draw_full_screen(impl.no_vertices);
  glDisable(GL_SCISSOR_TEST);
  gl::check_errors("composite");
}

void CompositePass::read(const PictureView& in, const MutablePictureView& out, const PixelRect& region) {
  copy_around(in, out, region);
  Impl& impl = *impl_;
  const glm::ivec2 block = block_size(out.format);
  const glm::ivec2 from = glm::ivec2(region.x, region.y) / block;
  const glm::ivec2 to = (glm::ivec2(region.x + region.width, region.y + region.height) + block - 1) / block;
  const PixelRect texels{from.x, from.y, to.x - from.x, to.y - from.y};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, impl.framebuffer.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  switch (out.format.chroma) {
    case Chroma::C420:
      impl.read_plane(out, 0, 0, texels, region.y, 2);
      impl.read_plane(out, 0, 1, texels, region.y + 1, 2);
      impl.read_chroma(out, 2, texels);
      break;
    case Chroma::C422:
      impl.read_plane(out, 0, 0, texels, region.y, 1);
      impl.read_chroma(out, 1, texels);
      break;
    case Chroma::C444:
      for (int plane = 0; plane < 3; ++plane) impl.read_plane(out, plane, plane, texels, region.y, 1);
      break;
  }
  gl::check_errors("read back");
}

}  // namespace render
