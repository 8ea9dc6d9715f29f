#include "app/window/window_gui.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace app {
namespace {

struct KeyPair {
  ImGuiKey_ gui;
  int glfw;
};

constexpr std::array kKeys{KeyPair{ImGuiKey_Tab, GLFW_KEY_TAB},
                           KeyPair{ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                           KeyPair{ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                           KeyPair{ImGuiKey_UpArrow, GLFW_KEY_UP},
                           KeyPair{ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                           KeyPair{ImGuiKey_Home, GLFW_KEY_HOME},
                           KeyPair{ImGuiKey_End, GLFW_KEY_END},
                           KeyPair{ImGuiKey_Delete, GLFW_KEY_DELETE},
                           KeyPair{ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                           KeyPair{ImGuiKey_Enter, GLFW_KEY_ENTER},
                           KeyPair{ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                           KeyPair{ImGuiKey_A, GLFW_KEY_A}};

void on_character(GLFWwindow* /*window*/, unsigned character) {
  ImGui::GetIO().AddInputCharacter(character);
}

void on_wheel(GLFWwindow* /*window*/, double /*x*/, double y) {
  ImGui::GetIO().MouseWheel += static_cast<float>(y);
}

ImVec2 cursor_of(GLFWwindow* window) {
  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(window, &x, &y);
  return {static_cast<float>(x), static_cast<float>(y)};
}

// What was pressed and let go between two frames counts as pressed in one, where the cursor was then.
std::array<std::optional<ImVec2>, 3> clicked{};
void on_button(GLFWwindow* window, int button, int action, int /*modifiers*/) {
  if (action == GLFW_PRESS && button >= 0 && button < 3) {
    clicked.at(static_cast<std::size_t>(button)) = cursor_of(window);
  }
}

}  // namespace

WindowGui::WindowGui(GLFWwindow* window)
    : window_(window), context_(ImGui::CreateContext()), program_("window/gui.vert", "window/gui.frag") {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  for (const KeyPair& key : kKeys) io.KeyMap[key.gui] = key.glfw;
  glfwSetCharCallback(window_, on_character);
  glfwSetScrollCallback(window_, on_wheel);
  glfwSetMouseButtonCallback(window_, on_button);
  make_font();
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  const auto attribute = [](GLuint index, GLint size, GLenum type, GLboolean normalized, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, type, normalized, sizeof(ImDrawVert), reinterpret_cast<const void*>(offset));
  };
  attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
  attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
  attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
  glBindVertexArray(0);
}

WindowGui::~WindowGui() {
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  ImGui::DestroyContext(context_);
}

void WindowGui::make_font() {
  unsigned char* coverage = nullptr;
  int width = 0;
  int height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverage, &width, &height);
  font_ = render::gl::Texture(GL_R8, width, height, render::gl::Filter::Linear, 1, "panel font");
  font_.upload(GL_RED, GL_UNSIGNED_BYTE, coverage);
}

bool WindowGui::wants_keyboard() {
  return ImGui::GetIO().WantTextInput;
}

void WindowGui::begin_frame(double seconds_since_last) {
  ImGuiIO& io = ImGui::GetIO();
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_, &width, &height);
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = static_cast<float>(std::max(seconds_since_last, 1e-4));
  io.MousePos = cursor_of(window_);
  for (int button = 0; button < 3; ++button) {
    std::optional<ImVec2>& was = clicked.at(static_cast<std::size_t>(button));
    io.MouseDown[button] = was || glfwGetMouseButton(window_, button) == GLFW_PRESS;
    if (was) io.MousePos = *was;
    was.reset();
  }
  for (const KeyPair& key : kKeys) io.KeysDown[key.glfw] = glfwGetKey(window_, key.glfw) == GLFW_PRESS;
  io.KeyCtrl = glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS;
  io.KeyShift = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
  ImGui::NewFrame();
}

void WindowGui::draw() {
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  const float scale = data.DisplaySize.x > 0.0F ? static_cast<float>(width) / data.DisplaySize.x : 1.0F;
  glViewport(0, 0, width, height);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("window_size", glm::vec2(data.DisplaySize.x, data.DisplaySize.y));
  program_.bind("font", font_.handle());
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    glBufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      glScissor(static_cast<int>(clip.x * scale), height - static_cast<int>(clip.w * scale),
                std::max(0, static_cast<int>((clip.z - clip.x) * scale)),
                std::max(0, static_cast<int>((clip.w - clip.y) * scale)));
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                     sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)));
    }
  }
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

}  // namespace app
