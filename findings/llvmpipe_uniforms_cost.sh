#!/usr/bin/env bash
# On Mesa's llvmpipe reading uniforms costs several times what the same numbers cost as flat inputs.
#
# Version:    Debian 12, Mesa 22.3.6-1+deb12u2 (llvmpipe, LLVM 15)
# Good guess: a uniform is the cheapest input there is: one value for the whole draw, in a register or a cache.
# Seen:       ten vec4 summed over 1024x1024 pixels take 8 to 16 ms a pass as uniforms and 1 to 2 ms handed on by the
#             vertex shader as flat varyings (two cores, 256-bit vectors). Both draw the same picture.
. "$(dirname "$0")/lib.sh"
fetch_mesa
cat >"$work/uniforms.cpp" <<'CPP'
#include <algorithm>
#include <chrono>
#include <vector>

#include "surfaceless.h"
static std::string ten(const std::string& pattern) {  // the pattern ten times, # counted up
  std::string all;
  for (char digit = '0'; digit <= '9'; ++digit)
    for (char c : pattern) all += c == '#' ? digit : c;
  return all;
}
int main() {
  make_context();
  make_target(GL_RGBA8, 1024, 1024);
  const std::string head = "out vec4 o; void main() { vec4 s = vec4(0); ", tail = "o = s; }";
  const std::string vertex = whole_target;
  const GLuint programs[] = {linked(vertex, ten("uniform vec4 u#; ") + head + ten("s += u# * gl_FragCoord.x; ") + tail),
                             linked(ten("uniform vec4 u#; flat out vec4 w#; ") + "void main() { " + ten("w# = u#; ") +
                                        vertex.substr(vertex.find("gl_Position")),
                                    ten("flat in vec4 w#; ") + head + ten("s += w# * gl_FragCoord.x; ") + tail)};
  std::vector<unsigned char> pictures[2];
  for (int i = 0; i < 2; ++i) {
    glUseProgram(programs[i]);
    for (char digit = '0'; digit <= '9'; ++digit)
      glUniform4f(glGetUniformLocation(programs[i], (std::string("u") + digit).c_str()), 1e-5f * (digit - '0'), 2e-5f,
                  3e-5f, 1);
    double best = 1e9;
    for (int turn = 0; turn < 8; ++turn) {
      glFinish();
      const auto start = std::chrono::steady_clock::now();
      for (int pass = 0; pass < 5; ++pass) glDrawArrays(GL_TRIANGLES, 0, 3);
      glFinish();
      const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
      best = std::min(best, passed.count() / 5);
    }
    std::printf("%s_ms %.3f\n", i ? "flat" : "uniform", best);
    pictures[i].resize(4 * 1024 * 1024);
    glReadPixels(0, 0, 1024, 1024, GL_RGBA, GL_UNSIGNED_BYTE, pictures[i].data());
  }
  std::printf("same_picture %d\n", pictures[0] == pictures[1]);
}
CPP
compile "$work/uniforms" "$work/uniforms.cpp" -lEGL -lGLESv2
on_llvmpipe "$work/uniforms" | tee "$work/out"
seen 'v["renderer"] == "llvmpipe" && v["same_picture"] == 1 && v["uniform_ms"] > 2 * v["flat_ms"]' "$work/out"
