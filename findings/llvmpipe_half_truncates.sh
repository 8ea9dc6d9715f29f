#!/usr/bin/env bash
# Mesa's llvmpipe rounds what it stores in half floats towards zero.
#
# Version:    Debian 12, Mesa 22.3.6-1+deb12u2 (llvmpipe, LLVM 15)
# Good guess: drawing into RGBA16F stores the nearest half, as packHalf2x16() does and as 8-bit targets do.
# Seen:       1 + i/64 of a half's last place, for i = 0 to 63: RGBA16F rounds none of them up, up to 63/64;
#             packHalf2x16() in the same shader and an RGBA8 target (100 + i/64 of 255) both round 31 up. Sums of many
#             passes therefore come out dark by half a last place each.
. "$(dirname "$0")/lib.sh"
fetch_mesa
cat >"$work/half.cpp" <<'CPP'
#include <vector>

#include "surfaceless.h"
int main() {
  make_context();
  const std::string step = "out vec4 o; void main() { float i = floor(gl_FragCoord.x) / 64.; ";
  std::vector<float> read(4 * 64);
  const auto above = [&](const char* name, GLenum format, const std::string& value, float exact) {
    make_target(format, 64, 1);
    glUseProgram(linked(whole_target, step + "o = vec4(" + value + "); }"));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (format == GL_RGBA8) {
      std::vector<unsigned char> bytes(4 * 64);
      glReadPixels(0, 0, 64, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
      read.assign(bytes.begin(), bytes.end());
    } else {
      glReadPixels(0, 0, 64, 1, GL_RGBA, GL_FLOAT, read.data());
    }
    int up = 0;
    for (int i = 0; i < 64; ++i) up += read[static_cast<std::size_t>(4 * i)] > exact;
    std::printf("%s %d\n", name, up);
  };
  above("stored", GL_RGBA16F, "1. + i / 1024.", 1);
  above("packed", GL_RGBA32F, "unpackHalf2x16(packHalf2x16(vec2(1. + i / 1024.))).x", 1);
  above("bytes", GL_RGBA8, "(100. + i) / 255.", 100);
}
CPP
compile "$work/half" "$work/half.cpp" -lEGL -lGLESv2
on_llvmpipe "$work/half" | tee "$work/out"
seen 'v["renderer"] == "llvmpipe" && v["stored"] == 0' "$work/out"
seen 'v["packed"] >= 31 && v["packed"] <= 32 && v["bytes"] >= 31 && v["bytes"] <= 32' "$work/out"
