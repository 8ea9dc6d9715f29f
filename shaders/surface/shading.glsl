// Light that a virtual surface sends to the eye: sun (GGX + Lambert), sky (spherical harmonics for
// the dull part, a prefiltered cube for the mirrored one), emission. glTF 2.0's
// metallic-roughness material, appendix B.
#include "shadow/shadow_maps.glsl"
#ifdef TRANSLUCENT
#include "shadow/translucent.glsl"
#endif
#include "lib/sh9.glsl"
#include "lib/brdf.glsl"

uniform vec3 sun_direction_in_local;
uniform vec3 sun_illuminance;       // pre-exposed
uniform vec3 sky_irradiance_sh[9];  // pre-exposed, cosine-convolved
uniform mediump samplerCube sky_mirror;  // what surfaces mirror, roughness rising evenly from level to level
uniform float sky_mirror_unit;           // pre-exposed luminance of its 1.0
uniform float sky_mirror_last_level;
uniform float white_luminance;      // of level white paper in this light, pre-exposed

uniform vec4 base_color;
uniform float metallic;
uniform float roughness;
uniform vec3 emissive;
#ifdef BASE_COLOR_TEXTURE
uniform sampler2D base_color_texture;
#endif
#ifdef METALLIC_ROUGHNESS_TEXTURE
uniform sampler2D metallic_roughness_texture;
#endif
#ifdef NORMAL_TEXTURE
uniform sampler2D normal_texture;
uniform float normal_scale;
#endif
#ifdef OCCLUSION_TEXTURE
uniform sampler2D occlusion_texture;
uniform float occlusion_strength;
#endif
#ifdef EMISSIVE_TEXTURE
uniform sampler2D emissive_texture;
#endif

in vec3 v_position;
in vec3 v_normal;
in vec4 v_tangent;
in vec2 v_uv;

const float kPi = 3.14159265;

// Part of the light on a leaf that comes out at its other side; leaves let a quarter to a third of it through
// (Woolley 1971, "Reflectance and transmittance of light by leaves").
const float kThinTransmission = 0.3;

// On the side that is seen.
vec3 surface_normal() {
  return normalize(v_normal) * (gl_FrontFacing ? 1.0 : -1.0);
}

vec3 shading_normal() {
#ifdef NORMAL_TEXTURE
  vec3 t = normalize(v_tangent.xyz);
  vec3 b = cross(normalize(v_normal), t) * v_tangent.w;
  vec3 m = (texture(normal_texture, v_uv).xyz * 2.0 - 1.0) * vec3(normal_scale, normal_scale, 1.0);
  float side = gl_FrontFacing ? 1.0 : -1.0;
  return normalize(side * (m.x * t + m.y * b) + m.z * surface_normal());
#else
  return surface_normal();
#endif
}

// rgb: pre-exposed, at most 4096; a: opacity, 0 to 1.
vec4 shade() {
  vec4 base = base_color;
#ifdef BASE_COLOR_TEXTURE
  base *= texture(base_color_texture, v_uv);
#endif
  float metal = metallic;
  float rough = roughness;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  vec2 mr = texture(metallic_roughness_texture, v_uv).bg;
  metal *= mr.x;
  rough *= mr.y;
#endif
  rough = clamp(rough, 0.06, 1.0);  // no highlight smaller than the sun's own disc
  float occlusion = 1.0;
#ifdef OCCLUSION_TEXTURE
  occlusion += occlusion_strength * (texture(occlusion_texture, v_uv).r - 1.0);
#endif

  vec3 to_eye = normalize(-v_position);
  vec3 n = shading_normal();
  float n_v = max(dot(n, to_eye), 1e-3);
  float n_s = dot(n, sun_direction_in_local);

  vec3 facet = normalize(cross(dFdx(v_position), dFdy(v_position)));
  if (dot(facet, to_eye) < 0.0) facet = -facet;
  float facing = dot(facet, sun_direction_in_local);
  vec3 sunny_facet = facing < 0.0 ? -facet : facet;
  float front = max(n_s, 0.0);
#ifdef THIN
  float back = max(-n_s, 0.0);
#else
  float back = 0.0;
  if (facing <= 0.0) front = 0.0;  // the triangle itself is in the way
#endif
  vec3 sun = vec3(0.0);
  if (front + back > 0.0) {
    sun = sun_illuminance * (visibility_at_surface(kVirtual, v_position, sunny_facet) *
                             visibility_at_surface(kReal, v_position, sunny_facet));
#ifdef TRANSLUCENT
    sun *= light_through_translucent(v_position);
#endif
  }

  vec3 f0 = mix(vec3(0.04), base.rgb, metal);
  vec3 diffuse_albedo = base.rgb * (1.0 - metal) / kPi;
  vec3 half_way = normalize(to_eye + sun_direction_in_local);
  float a = rough * rough;
  vec3 fresnel = schlick_fresnel(f0, max(dot(to_eye, half_way), 0.0));
  vec3 specular = fresnel * (ggx_distribution(max(dot(n, half_way), 0.0), a) * smith_visibility(front, n_v, a));
  vec3 sky = max(sh9(sky_irradiance_sh, n), vec3(0.0));
  vec3 light = sun * front * ((1.0 - fresnel) * diffuse_albedo + specular);
#ifdef THIN
  vec3 sky_behind = max(sh9(sky_irradiance_sh, -n), vec3(0.0));
  light *= 1.0 - kThinTransmission;
  light += kThinTransmission * diffuse_albedo * sun * back;
  sky = mix(sky, sky_behind, kThinTransmission);
#endif
  vec3 mirrored = reflect(-to_eye, n);
  vec3 reflected = textureLod(sky_mirror, mirrored, rough * sky_mirror_last_level).rgb * sky_mirror_unit;
  light += occlusion * (diffuse_albedo * sky + environment_brdf(f0, rough, n_v) * reflected);

  vec3 glow = emissive;
#ifdef EMISSIVE_TEXTURE
  glow *= texture(emissive_texture, v_uv).rgb;
#endif
  light += glow * white_luminance;
  return vec4(min(light, vec3(4096.0)), base.a);
}
