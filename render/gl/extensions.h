#pragma once

#include <EGL/egl.h>
#include <GLES3/gl31.h>

// GLES2/gl2ext.h declares the extension entry points' types and tokens.
#define GL_GLEXT_PROTOTYPES 0
#include <GLES2/gl2ext.h>

namespace render::gl {

// Optional entry points of the context that is current on this thread; null where it lacks them.
struct Extensions {
  PFNGLDEBUGMESSAGECALLBACKKHRPROC debug_message_callback = nullptr;
  PFNGLOBJECTLABELKHRPROC object_label = nullptr;
  PFNGLPUSHDEBUGGROUPKHRPROC push_debug_group = nullptr;
  PFNGLPOPDEBUGGROUPKHRPROC pop_debug_group = nullptr;
  PFNGLGENQUERIESEXTPROC gen_queries = nullptr;
  PFNGLDELETEQUERIESEXTPROC delete_queries = nullptr;
  PFNGLBEGINQUERYEXTPROC begin_query = nullptr;
  PFNGLENDQUERYEXTPROC end_query = nullptr;
  PFNGLGETQUERYOBJECTUI64VEXTPROC query_result_u64 = nullptr;
  bool software = false;                 // the renderer is a software rasteriser
  bool color_buffer_float = false;       // 32-bit float render targets
  bool color_buffer_half_float = false;  // 16-bit float render targets
  bool float_blend = false;              // blending in them
  bool float_linear = false;             // linear filtering of 32-bit float textures

  bool has_timer() const { return query_result_u64 != nullptr; }
  bool has_labels() const { return object_label != nullptr; }
};

// Of the context that is current on this thread; throws std::logic_error where none is.
const Extensions& extensions();

namespace detail {
Extensions load_extensions();                      // of the current context
void set_current_extensions(const Extensions* e);  // null: none is current
}  // namespace detail

}  // namespace render::gl
