#include "render/gl/shader_conditions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using render::gl::active_lines;
using render::gl::declared_uniforms;
using testing::ElementsAre;

TEST(ShaderConditions, OnlyBranchesThatAreTakenDeclareUniforms) {
  const char* const text = R"(#version 310 es
#define BOX 1
#define SPACING 2
uniform highp sampler2D depth;  // unfiltered
#ifdef BOX
uniform vec3 low;
#else
uniform vec3 nothing;
#endif
#ifndef BOX
uniform vec3 nothing_either;
#elif SPACING == 2 && !defined(FALLOFF)
uniform float growth;
#endif
#if defined(BOX) && (SPACING < 2 || defined(FALLOFF))
uniform float hidden;
#ifdef BOX
uniform float hidden_too;
#endif
#endif
uniform vec3 sh[9];
struct Map { float texel; };
uniform Map maps[2];
layout(std140) uniform Block {
  highp mat3 turn;
  highp vec3 weights[4];  // of bands
};
vec3 local = vec3(0.0);
)";
  EXPECT_THAT(declared_uniforms(text), ElementsAre("depth", "growth", "low", "maps", "sh", "turn", "weights"));
}

TEST(ShaderConditions, MacrosStandForOtherMacrosValues) {
  const char* const text = "#define A 1\n#define B (1 - A)\n#if B == 0 && A + B == 1\nuniform float there;\n#endif\n";
  EXPECT_THAT(declared_uniforms(text), ElementsAre("there"));
  EXPECT_THROW(active_lines("#define A B\n#define B A\n#if A\n#endif\n"), std::invalid_argument);
}

TEST(ShaderConditions, LinesKeepTheirNumbers) {
  EXPECT_EQ(active_lines("a\n#ifdef X\nb\n#else\nc\n#endif\nd\n"), "a\n\n\n\nc\n\nd\n");
  EXPECT_EQ(active_lines("#define X\n#undef X\n#ifdef X\nb\n#endif\n"), "#define X\n#undef X\n\n\n\n");
}

TEST(ShaderConditions, WhatCannotBeReadIsAnError) {
  EXPECT_THROW(active_lines("#if (1\n#endif\n"), std::invalid_argument);
  EXPECT_THROW(active_lines("#endif\n"), std::invalid_argument);
  EXPECT_THROW(active_lines("#else\n"), std::invalid_argument);
}

}  // namespace
