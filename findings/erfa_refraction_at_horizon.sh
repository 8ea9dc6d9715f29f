#!/usr/bin/env bash
# ERFA's refraction at the horizon is little more than a third of the almanac's.
#
# Version:    Debian 12, liberfa1 2.0.0-1+b1
# Good guess: given pressure, temperature and humidity, eraAtioq() refracts as almanacs do: about 0.48 degrees for a
#             sun whose geometric altitude is 0 (Saemundsson's formula: 0.483), so that sunsets come out to the
#             minute.
# Seen:       1013.25 hPa, 15 C: 0.180 degrees at altitude 0, and the same within 0.001 from -2 to 2 degrees; 0.171 at
#             4 (Saemundsson 0.189), 0.086 at 10 (0.090). Nothing fails or warns. A sunset computed with it comes
#             while the sun is still 0.3 degrees higher than where it really sets.
. "$(dirname "$0")/lib.sh"
fetch liberfa1=2.0.0-1+b1 liberfa-dev=2.0.0-1+b1
cat >"$work/sun.cpp" <<'CPP'
extern "C" {
#include <erfa.h>
}
#include <cmath>
#include <cstdio>
#include <initializer_list>
int main() {
  const double degree = M_PI / 180, latitude = 48 * degree;
  eraASTROM air;
  eraApio13(2456384.5, 0.969, 0.155, 0, latitude, 0, 0, 0, 1013.25, 15, 0.5, 0.55, &air);
  eraASTROM vacuum = air;
  vacuum.refa = vacuum.refb = 0;
  for (int altitude : {-2, 0, 2, 4, 10}) {  // on the meridian, to the south
    const double declination = altitude * degree + latitude - M_PI / 2;
    double azimuth, refracted, plain, hour, d, right_ascension;
    eraAtioq(air.eral, declination, &air, &azimuth, &refracted, &hour, &d, &right_ascension);
    eraAtioq(air.eral, declination, &vacuum, &azimuth, &plain, &hour, &d, &right_ascension);
    const double geometric = 90 - plain / degree;
    std::printf("erfa_%d %.5f\nsaemundsson_%d %.5f\n", altitude, (plain - refracted) / degree, altitude,
                1.02 / 60 / std::tan((geometric + 10.3 / (geometric + 5.11)) * degree));
  }
}
CPP
compile "$work/sun" "$work/sun.cpp" -lerfa
inside "$work/sun" | tee "$work/out"
seen '(v["erfa_0"] - 0.18)^2 < 1e-6 && (v["erfa_-2"] - v["erfa_2"])^2 < 1e-6 && v["saemundsson_0"] > 0.48' "$work/out"
seen '(v["erfa_4"] - 0.171)^2 < 1e-6 && (v["erfa_10"] - 0.086)^2 < 1e-6' "$work/out"
