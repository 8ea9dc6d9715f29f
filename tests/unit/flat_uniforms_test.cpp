// The rewriting of two shaders' texts by which uniforms reach fragments as flat varyings. That what is drawn stays the
// same is the GL tests' to show.
#include "render/gl/flat_uniforms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using render::gl::FragmentUniform;
using render::gl::hand_on_uniforms;
using render::gl::StageTexts;
using testing::HasSubstr;
using testing::Not;

const char* const kVertex = R"(#version 310 es
uniform vec2 half_size_px;
void main() {
  gl_Position = vec4(1.0 / half_size_px, 0.0, 1.0);
}
)";
const char* const kFragment = R"(#version 310 es
precision highp float;
uniform highp sampler2D depth;
uniform vec2 half_size_px;
#ifdef BOX
uniform vec3 low;  // metres
#endif
uniform highp mat3 turn;
uniform vec3 sh[9];
uniform int kind;
out vec4 color;
void main() {}
)";

TEST(FlatUniforms, AreHandedOnByTheVertexShader) {
  const StageTexts texts =
      hand_on_uniforms({kVertex, kFragment}, {{"low", GL_FLOAT_VEC3}, {"turn", GL_FLOAT_MAT3}, {"kind", GL_INT}}, 8);
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 0) flat in highp vec3 low;  // metres"));
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 1) flat in highp mat3 turn;"));
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 4) flat in highp int kind;"));
  EXPECT_THAT(texts.fragment, HasSubstr("uniform highp sampler2D depth;"));
  EXPECT_THAT(texts.vertex, HasSubstr("uniform highp vec3 low;\nlayout(location = 0) flat out highp vec3 handed_0;"));
  EXPECT_THAT(texts.vertex, HasSubstr("  handed_4 = kind;\n  handed_0 = low;\n  handed_1 = turn;\n}"));
  EXPECT_THAT(texts.vertex, HasSubstr("void draw() {\n  gl_Position"));
}

TEST(FlatUniforms, OfTheVertexShaderTooAreDeclaredOnce) {
  const StageTexts texts = hand_on_uniforms({kVertex, kFragment}, {{"half_size_px", GL_FLOAT_VEC2}}, 8);
  EXPECT_EQ(texts.vertex.find("uniform", texts.vertex.find("uniform") + 1), std::string::npos) << texts.vertex;
  EXPECT_THAT(texts.vertex, HasSubstr("  handed_0 = half_size_px;"));
}

TEST(FlatUniforms, TakeTheirWholeArraysRoom) {
  const std::vector<FragmentUniform> uniforms{{"kind", GL_INT}, {"sh", GL_FLOAT_VEC3}};
  const StageTexts texts = hand_on_uniforms({kVertex, kFragment}, uniforms, 10);
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 0) flat in highp vec3 sh[9];"));
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 9) flat in highp int kind;"));
  EXPECT_THAT(texts.vertex,
              HasSubstr("uniform highp vec3 sh[9];\nlayout(location = 0) flat out highp vec3 handed_0[9];"));
}

TEST(FlatUniforms, BeyondTheRoomAndSamplersStayAsTheyAre) {
  const StageTexts texts =
      hand_on_uniforms({kVertex, kFragment},
                       {{"kind", GL_INT}, {"sh", GL_FLOAT_VEC3}, {"depth", GL_SAMPLER_2D}, {"low", GL_FLOAT_VEC3}}, 1);
  EXPECT_THAT(texts.fragment, HasSubstr("flat in highp vec3 low;"));  // fuller than the int
  EXPECT_THAT(texts.fragment, HasSubstr("uniform int kind;"));
  EXPECT_THAT(texts.fragment, HasSubstr("uniform vec3 sh[9];"));
  EXPECT_THAT(texts.fragment, HasSubstr("uniform highp sampler2D depth;"));
  EXPECT_THAT(texts.vertex, Not(HasSubstr("kind")));
}

const char* const kWithBlock = R"(#version 310 es
layout(std140) uniform Block {
  highp vec3 low;  // metres
  highp float unread;
  highp vec3 sh[9];
};
uniform int kind;
void main() {}
)";

TEST(FlatUniforms, MembersOfABlockAreReadByTheVertexShaderAlone) {
  const StageTexts texts =
      hand_on_uniforms({kVertex, kWithBlock}, {{"kind", GL_INT}, {"low", GL_FLOAT_VEC3}, {"sh", GL_FLOAT_VEC3}}, 10);
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 0) flat in highp vec3 low;  // metres"));
  EXPECT_THAT(texts.fragment, HasSubstr("layout(location = 1) flat in highp vec3 sh[9];"));
  EXPECT_THAT(texts.fragment, HasSubstr("uniform int kind;")) << "members of the block come first";
  EXPECT_THAT(texts.fragment, Not(HasSubstr("std140")));
  EXPECT_THAT(texts.fragment, HasSubstr("\nhighp float unread;")) << "a name that may stand in code without effect";
  EXPECT_THAT(texts.vertex, HasSubstr("layout(std140) uniform Block {"));
  EXPECT_THAT(texts.vertex, HasSubstr("  handed_0 = low;"));
  EXPECT_THROW(hand_on_uniforms({kVertex, kWithBlock}, {{"sh", GL_FLOAT_VEC3}}, 8), std::runtime_error);
}

TEST(FlatUniforms, WithoutBlocksMembersArePlain) {
  EXPECT_THAT(render::gl::without_blocks(kWithBlock), HasSubstr("\n\nuniform highp vec3 low;  // metres\n"));
  EXPECT_THAT(render::gl::without_blocks(kWithBlock), Not(HasSubstr("std140")));
}

}  // namespace
