#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/synth/raycast.h"
#include "ar/output/sink.h"

namespace app::synth {

// Sensor and camera electronics: highlights rolled off, shot and read noise, BT.709 transfer, matrix and limited range.
class Film {
 public:
  explicit Film(const Spec& spec);
  // Y'CbCr 4:2:0, chroma sited left, 8 or 10 bits as `out` says. Equal seeds and frames give equal noise.
  void develop(const LinearFrame& light, int frame, const ar::OutputFrame& out) const;

 private:
  float noise(std::uint32_t bits) const { return normal_[bits >> 20U]; }

  std::uint32_t seed_;
  float read_sigma_ = 0.0F;    // of linear light
  float shot_sigma_ = 0.0F;    // of linear light 1
  std::vector<float> normal_;  // 4096 values of equal probability of a standard normal
};

// The renderer's own highlight shoulder (shaders/lib/shoulder.glsl), clipped at 1: its inverse recovers the scene.
glm::vec3 roll_off(const glm::vec3& linear);
// BT.709's opto-electronic transfer function of [0, 1].
float bt709_encode(float linear);

}  // namespace app::synth
