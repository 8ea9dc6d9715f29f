#!/usr/bin/env bash
# Speed and memory of the whole job on the demo clip: `end_to_end.sh BUILD_DIR`, called by `./dev bench`.
# Prints Markdown for docs/measurements/processing.md. Times are medians of $RUNS runs, taken alternately with the bare
# decode-and-encode of the same clip, so that both meet the same machine.
set -euo pipefail
build=$(realpath "$1")
runs=${RUNS:-3}
root=$(realpath "$(dirname "$0")/../..")
work=$build/bench
skyshaft=$build/skyshaft
mkdir -p "$work"
cd "$work"

[ -f clip.mp4 ] || "$skyshaft" --quiet synth "$root/data/synth/demo.yaml" -o clip.mp4 --overwrite

median() { sort -g | awk '{ v[NR] = $1 } END { print (NR % 2) ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }
seconds() { local t0 t1; t0=$(date +%s.%N); "$@" >&2; t1=$(date +%s.%N); awk "BEGIN { print $t1 - $t0 }"; }

process() { # IN OUT REPORT
  "$skyshaft" --quiet process "$1" -o "$2" --scene "$root/data/scenes/demo.yaml" --camera clip.camera.yaml \
    --report "$3" --overwrite
}

for ((i = 0; i < runs; ++i)); do
  seconds process clip.mp4 composite.mp4 report.json >>whole.$$
  seconds "$build/transcode_bench" clip.mp4 transcoded.mp4 >>bare.$$
done
whole=$(median <whole.$$)
bare=$(median <bare.$$)
rm -f whole.$$ bare.$$
frames=$(jq .frames.total report.json)

echo "machine: $(sed -nE 's/^model name\s*: //p' /proc/cpuinfo | head -1), $(nproc) cores; $(jq -r '.renderer' report.json)"
echo
echo "| | seconds | frames/s |"
echo "|---|---|---|"
awk -v f="$frames" -v w="$whole" -v b="$bare" 'BEGIN {
  printf "| process, %d frames | %.1f | %.1f |\n| decode and encode alone | %.1f | %.1f |\n| ratio | %.2f | |\n",
         f, w, f / w, b, f / b, w / b }'
echo
echo "| stage | median ms a frame |"
echo "|---|---|"
jq -r '.stages[] | "| \(.name) | \(.median_ms * 100 | round / 100) |"' report.json
jq -r '.passes[]? | "| \(.name) (pass) | \(.median_ms * 100 | round / 100) |"' report.json

# Peak memory must not grow with the length of the video.
for length in 300 3000; do
  loops=$(((length + frames - 1) / frames))
  ffmpeg -v error -y -stream_loop $((loops - 1)) -i clip.mp4 -c copy -frames:v "$length" "clip_$length.mp4"
  process "clip_$length.mp4" "composite_$length.mp4" "report_$length.json"
done
echo
echo "| frames | peak memory MiB |"
echo "|---|---|"
for length in 300 3000; do
  echo "| $length | $(jq '.peak_memory_mib | round' "report_$length.json") |"
done
