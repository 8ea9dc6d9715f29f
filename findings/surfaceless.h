#pragma once
// An OpenGL ES 3.1 context of Mesa without a window or a display, and the few helpers that the GL scripts share.
// All of them end the program with status 2 where the context or a shader fails.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>

#include <cstdio>
#include <cstdlib>
#include <string>

inline void demand(bool fine, const char* what) {
  if (fine) return;
  std::fprintf(stderr, "could not be tried: %s\n", what);
  std::exit(2);
}

inline void make_context() {
  const auto display_of =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  demand(display_of != nullptr, "EGL without platforms");
  const EGLDisplay display = display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  demand(eglInitialize(display, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_ES_API), "eglInitialize");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
  EGLConfig config{};
  EGLint count = 0;
  demand(eglChooseConfig(display, wanted, &config, 1, &count) && count == 1, "eglChooseConfig");
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  demand(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), "eglMakeCurrent");
  std::printf("renderer %s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
}

inline GLuint compiled(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint fine = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  demand(fine != 0, "a shader does not compile");
  return shader;
}

inline const char* const whole_target =
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3. : -1., gl_VertexID == 2 ? 3. : -1., 0, 1); }";

// Both without their first line (#version).
inline GLuint linked(const std::string& vertex, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, "#version 310 es\n" + vertex));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, "#version 310 es\nprecision highp float;\n" + fragment));
  glLinkProgram(program);
  GLint fine = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &fine);
  demand(fine != 0, "a program does not link");
  return program;
}

// A texture of this format as the bound framebuffer, cleared, with a viewport of its size. Returns the framebuffer.
inline GLuint make_target(GLenum format, int width, int height) {
  GLuint texture = 0, framebuffer = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  demand(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "the format cannot be drawn into");
  glViewport(0, 0, width, height);
  glClear(GL_COLOR_BUFFER_BIT);
  return framebuffer;
}
