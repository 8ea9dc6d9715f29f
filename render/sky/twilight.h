#pragma once

namespace render {

// Illuminance in lux of level ground under a clear sky with the sun's centre at that geometric elevation (US Naval
// Observatory Circular 171, Janiczek & DeYoung 1987), sun and sky together. Below -18 degrees held at the value there:
// other light (moon, airglow, stars) takes over.
double twilight_illuminance_lux(double sun_elevation_rad);

}  // namespace render
