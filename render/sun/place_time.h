#pragma once

#include <chrono>

namespace render {

// An instant in UTC. Leap seconds are not representable: 23:59:60 is read as the next second.
using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

// A point on the WGS 84 ellipsoid.
struct Place {
  double latitude_rad = 0.0;   // geodetic, north positive, [-pi/2, pi/2]
  double longitude_rad = 0.0;  // east positive, any turn
  double height_m = 0.0;       // above the ellipsoid
};

}  // namespace render
