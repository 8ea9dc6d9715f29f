#!/usr/bin/env bash
# make_clip.sh BUILD: the clip that the lab's webcam shows to the program, and the poses that `process` finds in it.
# Made outside, since the lab's machine would take long for it.
set -euo pipefail
skyshaft=$1/skyshaft
clip=$1/lab/clip
mkdir -p "$1/lab"
"$skyshaft" synth "$(dirname "$0")/clip.yaml" -o "$clip.mp4" --overwrite --quiet
"$skyshaft" process "$clip.mp4" -o "$1/lab/processed.mp4" --scene "$clip.scene.yaml" --camera "$clip.camera.yaml" \
  --poses "$clip.poses.csv" --preset ultrafast --overwrite --quiet
