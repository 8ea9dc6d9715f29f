#!/usr/bin/env bash
# Shows that a change of the code changed no output.
#   equality.sh BUILD_DIR OUT_DIR         makes the outputs of every command and their hashes, OUT_DIR/hashes.txt
#   equality.sh --compare OUT_A OUT_B     lists what differs; status 1 if anything but words does
# Of videos the decoded frames are hashed, of reports all but times and memory. Whatever people read (help, `explain`,
# the reasons in reports) is in the group words/: its differences are listed, and allowed.
# Both folders are to be made on one machine: Mesa's software rasteriser and the encoders choose their code by the
# processor, and the last bits differ from one kind to another.
# Left out: `live`, which drops frames by the clock, and with it the render scale and the quick shadows that its
# governor alone sets; `doctor`, which tells of the machine; PDF boards, which carry the time of day.
set -uo pipefail
export LC_ALL=C
here=$(realpath "$(dirname "$0")")/equality

if [ "${1:-}" = --compare ] && [ $# -eq 3 ]; then exec "$here/compare.sh" "$2" "$3"; fi
if [ $# -ne 2 ]; then
  echo "usage: equality.sh BUILD_DIR OUT_DIR | equality.sh --compare OUT_A OUT_B" >&2
  exit 2
fi
[ -f "$1/skyshaft" ] || { echo "equality.sh: $1: no program skyshaft in it; build it first" >&2; exit 2; }
if [ -e "$2" ] && [ ! -f "$2/machine.txt" ] && [ -n "$(ls -A "$2")" ]; then
  echo "equality.sh: $2: not empty, and not made by this script; name another folder" >&2
  exit 2
fi
build=$(realpath "$1")
skyshaft() { "$build/skyshaft" --quiet "$@"; }
mkdir -p "$2"
# All paths are relative to the folder, so that none of its outside gets into an output.
cd "$2" || exit 1
rm -rf data outputs work hashes.txt
mkdir outputs work
cp -r "$here/../../../data" data
{
  sed -nE 's/^model name\s*: //p' /proc/cpuinfo | head -1
  nproc
  skyshaft doctor | grep -E '^ +used '
} >machine.txt

# --- running commands, a core's worth at a time; one that fails is named and the others go on

spawn() {
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
  "$@" &
}
# attempt NAME STATUS COMMAND...: standard output goes to the output NAME. 4: a calibration that rejects itself.
attempt() {
  local name=$1 allowed=$2 status=0
  shift 2
  mkdir -p "outputs/$(dirname "$name")" "work/$(dirname "$name")"
  "$@" >"outputs/$name" 2>"work/$name.err" || status=$?
  [ "$status" -eq 0 ] || [ "$status" -eq "$allowed" ] && return
  rm -f "outputs/$name"
  echo "$name: status $status: $(tail -n 2 "work/$name.err" | tr '\n' ' ')" | tee -a work/failed >&2
  return 1
}
# prints NAME COMMAND...: the output NAME is what the command prints.
prints() { attempt "$1" 0 "${@:2}"; }
# writes NAME COMMAND...: the command writes the output NAME itself; what it prints is words about that.
writes() {
  mkdir -p "outputs/$(dirname "$1")"
  attempt "words/printed/$1.txt" 0 "${@:2}"
}
frames() { prints "$1.framemd5" ffmpeg -nostdin -v error -i "work/$1.$2" -map 0:v -f framemd5 -; } # NAME EXTENSION

still() { # NAME SCENE SIZE ENDING [OPTION...]
  writes "$1.$4" skyshaft render --scene "$2" --size "$3" -o "outputs/$1.$4" "${@:5}"
}
composite() { # NAME EXTENSION CLIP SCENE [OPTION...]
  local name=$1 ending=$2
  mkdir -p "outputs/$(dirname "$name")" "work/$(dirname "$name")"
  writes "$name.poses.csv" skyshaft process "work/$3" -o "work/$name.$ending" --scene "$4" \
    --poses "outputs/$name.poses.csv" --report "work/$name.report.json" --overwrite "${@:5}" || return
  frames "$name" "$ending"
  prints "$name.report.json" jq 'del(.wall_s, .frames_per_second, .peak_memory_mib, .stages, .passes, .plan)' \
    "work/$name.report.json"
  prints "words/$name.plan.json" jq '{plan, stages: [.stages[].name], passes: [.passes[].name]}' "work/$name.report.json"
}

for part in inputs pictures tables; do . "$here/$part.sh"; done

make_inputs
spawn help_pages
spawn sun
spawn sky
spawn sky_pictures
spawn lenses
data_scenes
bench_scenes
light_and_air
spawn trade
boards
demo
wait
calibrations
spawn cameras_and_maps
wait
find outputs/words -empty -delete # most commands print nothing
(cd outputs && find . -type f -printf '%P\0' | sort -z | xargs -0 sha256sum) >hashes.txt
[ ! -s work/failed ] || { echo "equality.sh: not whole: what failed is in $PWD/work/failed" >&2; exit 1; }
