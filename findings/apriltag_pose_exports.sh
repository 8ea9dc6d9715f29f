#!/usr/bin/env bash
# Debian's libapriltag declares the pose function that returns both planar solutions, and does not export it.
#
# Version:    Debian 12, libapriltag3 and libapriltag-dev 3.3.0-1+b1
# Good guess: what apriltag_pose.h declares can be linked: estimate_tag_pose(), which keeps the better of two poses,
#             and estimate_tag_pose_orthogonal_iteration(), which returns both with their errors.
# Seen:       a program that calls the first links. One that calls the second, or estimate_pose_for_tag_homography(),
#             does not ("undefined reference"), and neither of the two libraries of the package has them.
. "$(dirname "$0")/lib.sh"
fetch libapriltag3=3.3.0-1+b1 libapriltag-dev=3.3.0-1+b1
cat >"$work/pose.cpp" <<'CPP'
extern "C" {
#include <apriltag/apriltag_pose.h>
}
int main(int count, char**) {
  apriltag_detection_info_t info{};
  apriltag_pose_t first{}, second{};
  double error[2];
  if (count < 9) return 0;  // it is the link that is tried
#if CALL == 1
  *error = estimate_tag_pose(&info, &first);
#elif CALL == 2
  estimate_tag_pose_orthogonal_iteration(&info, error, &first, error + 1, &second, 50);
#else
  estimate_pose_for_tag_homography(&info, &first);
#endif
}
CPP
for call in 1 2 3; do
  links=1
  (compile "$work/pose" "$work/pose.cpp" -DCALL=$call -lapriltag -lapriltag-utils) 2>"$work/errors" || links=0
  echo "links_$call $links"
  echo "undefined_$call $(grep -c 'undefined reference' "$work/errors" || true)"
done | tee "$work/out"
seen 'v["links_1"] == 1' "$work/out"
seen 'v["links_2"] == 0 && v["undefined_2"] >= 1 && v["links_3"] == 0 && v["undefined_3"] >= 1' "$work/out"
