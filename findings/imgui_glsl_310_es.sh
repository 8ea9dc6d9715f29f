#!/usr/bin/env bash
# Dear ImGui's OpenGL 3 backend draws nothing with "#version 310 es", and its Init returns true.
#
# Versions:   Debian 12, libimgui-dev 1.86+ds-1+b1, Mesa 22.3.6-1+deb12u2 (llvmpipe, OpenGL ES 3.2)
# Good guess: ImGui_ImplOpenGL3_Init() takes the GLSL version of the program that it is put into, or returns false.
# Seen:       on an OpenGL ES context it returns true for "#version 300 es", "#version 310 es" and "#version 320 es".
#             The first draws a window; with the others the picture stays black: they get desktop GL's shader text,
#             which does not compile ("No precision specified"); only stderr says so.
. "$(dirname "$0")/lib.sh"
fetch_mesa
fetch libimgui-dev=1.86+ds-1+b1 libstb0=0.0~git20220908.8b5f1f3+ds-1 libstb-dev=0.0~git20220908.8b5f1f3+ds-1
cat >"$work/window.cpp" <<'CPP'
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <vector>

#include "surfaceless.h"
int main() {
  make_context();
  for (const char* version : {"#version 300 es", "#version 310 es", "#version 320 es"}) {
    const GLuint target = make_target(GL_RGBA8, 256, 256);
    ImGui::CreateContext();
    ImGui::GetIO().DisplaySize = ImVec2(256, 256);
    ImGui::GetIO().IniFilename = nullptr;
    const bool ready = ImGui_ImplOpenGL3_Init(version);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(ImVec2(10, 10));
    ImGui::SetNextWindowSize(ImVec2(200, 200));
    ImGui::Begin("window");
    ImGui::End();
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    std::vector<unsigned char> read(4 * 256 * 256);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glReadPixels(0, 0, 256, 256, GL_RGBA, GL_UNSIGNED_BYTE, read.data());
    const long bytes = static_cast<long>(read.size()) - std::count(read.begin(), read.end(), 0);
    std::printf("ready_%.3s %d\nbytes_%.3s %ld\n", version + 9, ready, version + 9, bytes);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
  }
}
CPP
compile "$work/window" "$work/window.cpp" -isystem "$root/usr/include/imgui" -limgui -l:libstb.so.0 -lEGL -lGLESv2 -ldl
on_llvmpipe "$work/window" 2>"$work/errors" | tee "$work/out"
echo "complaints $(grep -c 'No precision specified' "$work/errors")" | tee -a "$work/out"
seen 'v["ready_300"] == 1 && v["bytes_300"] > 100000' "$work/out"
seen 'v["ready_310"] == 1 && v["bytes_310"] == 0 && v["ready_320"] == 1 && v["bytes_320"] == 0' "$work/out"
seen 'v["complaints"] > 0' "$work/out"
