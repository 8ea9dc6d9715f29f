#!/usr/bin/env bash
# Without refine_edges libapriltag's corners are shifted, by an amount that grows with quad_decimate.
#
# Version:    Debian 12, libapriltag3 3.3.0-1+b1
# Good guess: apriltag.h says that at quad_decimate 1 the setting has no effect; and without it corners are noisier,
#             not displaced.
# Seen:       mean offset in x and y / RMS distance from the drawn corner, over 60 tags of 60 to 80 px:
#               decimate 1, off: -0.07 px / 0.12    decimate 1, on: 0.00 / 0.05
#               decimate 2, off: -0.16 px / 0.31    decimate 2, on: 0.00 / 0.06
#             So it is not ignored at 1, and what it removes is a shift towards the picture's origin. The drawn
#             corners are counted from the picture's edge (first pixel's centre 0.5): that is libapriltag's own count.
. "$(dirname "$0")/lib.sh"
fetch libapriltag3=3.3.0-1+b1 libapriltag-dev=3.3.0-1+b1
cat >"$work/refine.cpp" <<'CPP'
#include <apriltag/tag36h11.h>

#include <cstdio>

#include "drawn_tag.h"
int main() {
  apriltag_family_t* family = tag36h11_create();
  for (int decimate : {1, 2})
    for (bool refine : {false, true}) {
      apriltag_detector_t* detector = apriltag_detector_create();
      apriltag_detector_add_family(detector, family);
      detector->quad_decimate = static_cast<float>(decimate);
      detector->refine_edges = refine;
      double x = 0, y = 0, square = 0;
      int corners = 0;
      for (unsigned id = 0; id < 60; ++id) {
        auto grey = draw(family, id, random_tag(id), 2);
        image_u8_t picture = wrap(grey);
        zarray_t* detections = apriltag_detector_detect(detector, &picture);
        if (zarray_size(detections) == 1) {
          apriltag_detection_t* tag;
          zarray_get(detections, 0, &tag);
          const auto drawn = random_tag(id).corners();
          for (int i = 0; i < 4; ++i) {  // p[0] is the tag's bottom left, and on from there counter-clockwise
            const double dx = tag->p[i][0] - drawn[3 - i][0], dy = tag->p[i][1] - drawn[3 - i][1];
            x += dx, y += dy, square += dx * dx + dy * dy, ++corners;
          }
        }
        apriltag_detections_destroy(detections);
      }
      const char* name = refine ? "on" : "off";
      std::printf("mean_x_%d_%s %.4f\nmean_y_%d_%s %.4f\nrms_%d_%s %.4f\nfound_%d_%s %d\n", decimate, name, x / corners,
                  decimate, name, y / corners, decimate, name, std::sqrt(square / corners), decimate, name,
                  corners / 4);
      apriltag_detector_destroy(detector);
    }
}
CPP
compile "$work/refine" "$work/refine.cpp" -lapriltag -lapriltag-utils
inside "$work/refine" | tee "$work/out"
seen 'v["found_1_off"] == 60 && v["found_1_on"] == 60 && v["found_2_off"] == 60 && v["found_2_on"] == 60' "$work/out"
seen 'v["mean_x_1_off"] < -0.03 && v["mean_y_1_off"] < -0.03 && v["rms_1_off"] > 1.5 * v["rms_1_on"]' "$work/out"
seen 'v["mean_x_2_off"] < -0.1 && v["mean_y_2_off"] < -0.1 && v["rms_2_off"] > 3 * v["rms_2_on"]' "$work/out"
seen 'v["mean_x_2_on"]^2 < 1e-4 && v["mean_y_2_on"]^2 < 1e-4' "$work/out"
