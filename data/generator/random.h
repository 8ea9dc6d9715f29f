#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace generator {

// Same numbers on every machine and standard library: the distributions of <random> differ between them.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(static_cast<double>(engine_()) * 0x1p-32);
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }
  glm::vec3 on_sphere() {
    const float z = uniform(-1.0F, 1.0F);
    const float a = uniform(0.0F, 6.2831853F);
    const float r = std::sqrt(std::max(0.0F, 1.0F - z * z));
    return {r * std::cos(a), r * std::sin(a), z};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace generator
