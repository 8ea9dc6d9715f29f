#!/usr/bin/env bash
# A fractional quad_decimate other than 1.5 makes libapriltag blind.
#
# Version:    Debian 12, libapriltag3 3.3.0-1+b1
# Good guess: quad_decimate is a float, a factor of resolution: 1.25 or 2.5 lies between its neighbours in speed and
#             accuracy.
# Seen:       of 20 tags of 60 to 80 px, 1, 1.5, 2, 3 and 4 find all 20; 1.25, 1.75, 2.5 and 3.5 find none, and no
#             message says so.
. "$(dirname "$0")/lib.sh"
fetch libapriltag3=3.3.0-1+b1 libapriltag-dev=3.3.0-1+b1
cat >"$work/decimate.cpp" <<'CPP'
#include <apriltag/tag36h11.h>

#include <cstdio>

#include "drawn_tag.h"
int main() {
  apriltag_family_t* family = tag36h11_create();
  for (float decimate : {1.f, 1.25f, 1.5f, 1.75f, 2.f, 2.5f, 3.f, 3.5f, 4.f}) {
    apriltag_detector_t* detector = apriltag_detector_create();
    apriltag_detector_add_family(detector, family);
    detector->quad_decimate = decimate;
    int found = 0;
    for (unsigned id = 0; id < 20; ++id) {
      auto grey = draw(family, id, random_tag(id), 1);
      image_u8_t picture = wrap(grey);
      zarray_t* detections = apriltag_detector_detect(detector, &picture);
      found += zarray_size(detections) == 1;
      apriltag_detections_destroy(detections);
    }
    std::printf("%g %d\n", decimate, found);
    apriltag_detector_destroy(detector);
  }
}
CPP
compile "$work/decimate" "$work/decimate.cpp" -lapriltag -lapriltag-utils
inside "$work/decimate" | tee "$work/out"
seen 'v["1"] == 20 && v["1.5"] == 20 && v["2"] == 20 && v["3"] == 20 && v["4"] == 20' "$work/out"
seen 'v["1.25"] == 0 && v["1.75"] == 0 && v["2.5"] == 0 && v["3.5"] == 0' "$work/out"
