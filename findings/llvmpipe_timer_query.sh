#!/usr/bin/env bash
# A GPU timer query on Mesa's llvmpipe misses a pass that draws into the framebuffer that is bound already.
#
# Version:    Debian 12, Mesa 22.3.6-1+deb12u2 (llvmpipe, LLVM 15)
# Good guess: GL_TIME_ELAPSED_EXT around one draw, with glFinish() before and after, is the time that the draw takes.
# Seen:       a pass of 0.1 to 1 s of wall time is reported as 1 to 6 % of that. If another framebuffer was bound when
#             the query began, and the draw's own is bound after that, the same pass is reported whole (98 % and
#             more). Time passes on llvmpipe by the wall clock, or change the framebuffer inside the query.
. "$(dirname "$0")/lib.sh"
fetch_mesa
cat >"$work/timer.cpp" <<'CPP'
#include <chrono>

#include "surfaceless.h"
template <typename F>
F entry(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}
int main() {
  make_context();
  const auto generate = entry<PFNGLGENQUERIESEXTPROC>("glGenQueriesEXT");
  const auto begin = entry<PFNGLBEGINQUERYEXTPROC>("glBeginQueryEXT");
  const auto end = entry<PFNGLENDQUERYEXTPROC>("glEndQueryEXT");
  const auto result = entry<PFNGLGETQUERYOBJECTUI64VEXTPROC>("glGetQueryObjectui64vEXT");
  const GLuint one = make_target(GL_RGBA8, 512, 512), other = make_target(GL_RGBA8, 512, 512);
  glUseProgram(linked(whole_target,
                      "out vec4 o; void main() { float s = 0.; for (int i = 0; i < 150; ++i) "
                      "s += sin(gl_FragCoord.x * .01 + float(i)); o = vec4(s); }"));
  const auto share = [&](GLuint before, GLuint during) {
    GLuint query = 0;
    generate(1, &query);
    glBindFramebuffer(GL_FRAMEBUFFER, before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    begin(GL_TIME_ELAPSED_EXT, query);
    glBindFramebuffer(GL_FRAMEBUFFER, during);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    end(GL_TIME_ELAPSED_EXT);
    glFinish();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    GLuint64 nanoseconds = 0;
    result(query, GL_QUERY_RESULT_EXT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-9 / wall.count();
  };
  share(one, one);
  std::printf("same_percent %.2f\nother_percent %.2f\n", 100 * share(one, one), 100 * share(other, one));
}
CPP
compile "$work/timer" "$work/timer.cpp" -lEGL -lGLESv2
on_llvmpipe "$work/timer" | tee "$work/out"
seen 'v["renderer"] == "llvmpipe" && v["same_percent"] < 25 && v["other_percent"] > 60' "$work/out"
