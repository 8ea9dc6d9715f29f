#pragma once

#include <chrono>
#include <string>

#include "ar/place/place.h"

namespace ar {

// Where gpsd, the daemon that watches GPS receivers, says that we are: its first fix of two or three dimensions (height
// 0 without the third). `address` is "HOST:PORT", or empty for the local daemon at its usual port, 2947. Throws
// std::runtime_error that says what to do where nobody answers there, or no fix comes in time.
GeoPosition position_from_gpsd(const std::string& address, std::chrono::milliseconds patience);

}  // namespace ar
