// Programs, their uniforms, blocks and texture units, and textures of several layers, on a GL context.
#include "render/gl/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "render/gl/context.h"
#include "render/gl/error.h"
#include "render/gl/layered_texture.h"

namespace {

using render::gl::Buffer;
using render::gl::LayeredTexture;
using render::gl::Program;

const char* const kCompute = R"(#version 310 es
precision highp float;
precision highp sampler3D;
precision highp sampler2DArray;
layout(local_size_x = 1) in;
uniform sampler2DArray pictures;
uniform sampler3D volume;
uniform float layer;
uniform float unused;
layout(std140) uniform Scale {
  highp vec2 factor;
};
layout(std430, binding = 0) buffer Found {
  float found[];
};
void main() {
  found[0] = texture(pictures, vec3(0.5, 0.5, layer)).r * factor.x;
  found[1] = texture(volume, vec3(0.5)).r * factor.y;
}
)";

class Programs : public testing::Test {
 protected:
  void SetUp() override { context().make_current(); }
  static render::gl::Context& context() {
    static render::gl::Context instance;
    return instance;
  }
};

std::array<float, 2> run(const Program& program) {
  const std::array<float, 2> nothing{-1.0F, -1.0F};
  const Buffer found(sizeof nothing, nothing.data(), GL_DYNAMIC_READ);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, found.id());
  program.use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const void* mapped = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, sizeof nothing, GL_MAP_READ_BIT);
  std::array<float, 2> out{};
  std::copy_n(static_cast<const float*>(mapped), out.size(), out.begin());
  glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
  render::gl::check_errors("compute");
  return out;
}

TEST_F(Programs, ComputeReadsLayersVolumesAndBlocks) {
  const Program program("test", {kCompute, {"test"}});
  LayeredTexture pictures(LayeredTexture::Kind::Array, GL_R32F, 1, 1, 3);
  for (const float layer : {0.0F, 1.0F, 2.0F}) {
    const float value = 10.0F * layer + 1.0F;
    pictures.upload(static_cast<int>(layer), GL_RED, GL_FLOAT, &value);
  }
  LayeredTexture volume(LayeredTexture::Kind::Volume, GL_R16F, 1, 1, 2, render::gl::Filter::Linear);
  for (const int layer : {0, 1}) {
    const auto value = static_cast<float>(layer);
    volume.upload(layer, GL_RED, GL_FLOAT, &value);
  }
  program.bind("pictures", pictures.handle());
  program.bind("volume", volume.handle());
  const std::array<float, 4> factor{2.0F, 3.0F, 0.0F, 0.0F};
  const Buffer scale(sizeof factor, factor.data());
  program.bind_block("Scale", scale);
  program.set("layer", 2.0F);
  EXPECT_THAT(run(program), testing::ElementsAre(42.0F, 1.5F)) << "layer 2; half way between the volume's layers";
  program.set("layer", 1.0F);
  EXPECT_THAT(run(program), testing::ElementsAre(22.0F, 1.5F));
}

TEST_F(Programs, AUniformThatIsNotDeclaredIsAnError) {
  const Program program("test", {kCompute, {"test"}});
  EXPECT_TRUE(program.has("unused"));
  EXPECT_NO_THROW(program.set("unused", 1.0F)) << "declared, but nothing reads it";
  EXPECT_FALSE(program.has("misspelt"));
  EXPECT_THROW(program.set("misspelt", 1.0F), std::logic_error);
  EXPECT_THROW(program.bind("misspelt", {}), std::logic_error);
  EXPECT_THROW(program.bind_block("misspelt", Buffer()), std::logic_error);
}

TEST_F(Programs, ACompilersComplaintNamesTheShaderAndItsLine) {
  try {
    const Program program("broken",
                          {"#version 310 es\nlayout(local_size_x = 1) in;\nvoid main() { nonsense; }\n", {"broken"}});
    FAIL() << "nonsense compiled";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("broken:3"));
  }
}

TEST_F(Programs, LayersOfNoSizeAreRefused) {
  EXPECT_THROW(LayeredTexture(LayeredTexture::Kind::Array, GL_R8, 4, 4, 0), std::logic_error);
}

}  // namespace
