// Medium, sun and view of a frame, for all shaders of the shafts (render/shafts/medium_block.h).
#ifndef MEDIUM_BLOCK
#define MEDIUM_BLOCK
layout(std140) uniform MediumBlock {
  highp mat3 local_ray_from_px;     // render/scene/view.h
  highp vec3 sun_direction;         // local frame
  highp float near_m;               // View::kNearM
  highp vec3 sun_scattered;         // illuminance * albedo * gain of the shafts, pre-exposed
  highp float extinction;           // 1/m; of a medium that thins out, at its base
  highp vec3 box_low_in_local;      // of a bounded medium
  highp float log_extinction;       // of one that thins out: of the extinction at the eye
  highp vec3 box_high_in_local;
  highp float scale_height_m;
  highp vec3 sky_scatter_sh[9];     // sky radiance * phase moments * albedo * gain of the fog, pre-exposed
  highp float phase_g;
  highp int phase_kind;             // shaders/lib/medium.glsl
};
#endif
