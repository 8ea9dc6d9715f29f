#!/usr/bin/env bash
# On Mesa's llvmpipe an int without a precision has 16 bits in a fragment shader.
#
# Version:    Debian 12, Mesa 22.3.6-1+deb12u2 (llvmpipe, LLVM 15)
# Good guess: a software rasteriser computes everything in 32 bits; mediump, GLSL ES's default for int and uint in
#             fragment shaders, is a hint for phones.
# Seen:       int k = int(50000.7); float(k * 3) is 32768 instead of 150000. uint b = floatBitsToUint(50000.7):
#             float(b >> 16u) is 20656 instead of 18243. With "precision highp int;" both are right. (GLSL ES allows
#             it; so a shader that packs floats into integers needs the line, also where no phone is meant.)
. "$(dirname "$0")/lib.sh"
fetch_mesa
cat >"$work/medium.cpp" <<'CPP'
#include "surfaceless.h"
int main() {
  make_context();
  for (const auto& [name, line] : {std::pair("default", ""), std::pair("highp", "precision highp int;\n")}) {
    make_target(GL_RGBA32F, 1, 1);
    const GLuint program =
        linked(whole_target, std::string(line) +
                                 "uniform float value; out vec4 o;\n"
                                 "void main() { uint b = floatBitsToUint(value); int k = int(value);\n"
                                 "  o = vec4(float(k * 3), float(b >> 16u), 0, 0); }");
    glUseProgram(program);
    glUniform1f(glGetUniformLocation(program, "value"), 50000.7f);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    float read[4];
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, read);
    std::printf("%s_triple %.0f\n%s_high_bits %.0f\n", name, read[0], name, read[1]);
  }
}
CPP
compile "$work/medium" "$work/medium.cpp" -lEGL -lGLESv2
on_llvmpipe "$work/medium" | tee "$work/out"
seen 'v["renderer"] == "llvmpipe" && v["highp_triple"] == 150000 && v["highp_high_bits"] == 18243' "$work/out"
seen 'v["default_triple"] != 150000 && v["default_high_bits"] != 18243' "$work/out"
