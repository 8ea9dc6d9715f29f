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
here=$(realpath "$(dirname "$0")")

if [ "${1:-}" = --compare ] && [ $# -eq 3 ]; then exec "$here/equality_compare.sh" "$2" "$3"; fi
if [ $# -ne 2 ]; then
  echo "usage: equality.sh BUILD_DIR OUT_DIR | equality.sh --compare OUT_A OUT_B" >&2
  exit 2
fi
for program in skyshaft skyshaft-bench-scenes skyshaft-models; do
  [ -f "$1/$program" ] || { echo "equality.sh: $1: no program $program in it; build it first" >&2; exit 2; }
done
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
cp -r "$here/../../data" data
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

. "$here/equality_inputs.sh"

# --- words: help, and what would run

help_pages() {
  local command part
  prints words/help/skyshaft.txt skyshaft --help
  for command in $(skyshaft --help | sed -nE '/^Subcommands:/,/^[^ S]/ s/^  ([a-z]+) .*/\1/p'); do
    prints "words/help/$command.txt" skyshaft "$command" --help
    for part in $(skyshaft "$command" --help | sed -nE '/^Subcommands:/,/^[^ S]/ s/^  ([a-z]+) .*/\1/p'); do
      prints "words/help/$command-$part.txt" skyshaft "$command" "$part" --help
    done
  done
}

# --- stills

data_scenes() {
  local scene name where
  for scene in data/scenes/*.yaml; do
    name=$(basename "$scene" .yaml)
    where=()
    grep -qE '^(place|sun):' "$scene" || where=(--at 43.5263,5.4454 --time 2024-06-21T15:00:00Z)
    spawn prints "words/explain/$name.txt" skyshaft explain --scene "$scene" "${where[@]}"
    grep -q '^view:' "$scene" || continue
    spawn still "scenes/$name" "$scene" 240x135 exr "${where[@]}"
    spawn still "scenes/$name" "$scene" 240x135 png "${where[@]}"
  done
}

# Every technique with its standard settings, then those settings that choose other code.
bench_settings=(march:steps=64,sun=disc march:steps=64,spacing=depth march:steps=64,spacing=growing,near_share=0.4
  march:steps=64,divisor=2 interleaved:steps=32,divisor=1 bilateral:divisor=2,radius=2 bilateral:sun=disc
  epipolar:sun=disc epipolar:line_px=1,tolerance=0,divisor=2 minmax:divisor=2 minmax:line_px=1,tolerance=0
  minmax:line_px=0.25,sample_px=2,tolerance=0.01 closed-form:divisor=1)
techniques() {
  skyshaft render --scene data/scenes/haze.yaml -o work/none.png --shafts unknown 2>&1 |
    sed -nE 's/.*accepted: //p' | tr -d ' ' | tr ',' '\n'
}
bench_scenes() {
  local scene name technique setting size
  for scene in outputs/bench/scenes/*.yaml; do
    name=$(basename "$scene" .yaml)
    spawn prints "words/explain/$name.txt" skyshaft explain --scene "$scene"
    for technique in $(techniques); do
      size=160x90
      case $technique-$name in
        reference-*) continue ;;
        # Two thirds of a second each for the shadow maps alone: the finer two are drawn by one technique.
        *-forest-188k | *-gate-188k) [ "$technique" = minmax ] || continue ;;
        march-forest-*) size=96x54 ;;
      esac
      spawn still "bench/$name/$technique" "$scene" "$size" exr --shafts "$technique"
    done
  done
  for name in gate-66k room; do
    scene=outputs/bench/scenes/$name.yaml
    for setting in "${bench_settings[@]}"; do
      spawn still "bench/$name/${setting//[:,]/_}" "$scene" 160x90 exr --shafts "$setting"
    done
    for setting in open none traced; do
      spawn still "bench/$name/reference_sky=$setting" "$scene" 24x14 exr --shafts "reference:sky=$setting,max_error=0.02"
    done
    spawn still "bench/$name/max-error" "$scene" 160x90 png --max-error 0.01
    spawn still "bench/$name/target-ms" "$scene" 160x90 png --target-ms 30
  done
  spawn still bench/forest-66k/reference outputs/bench/scenes/forest-66k.yaml 16x9 exr --shafts reference:sky=open,max_error=0.02
}

# One small scene under many skies and in many airs.
light_and_air() {
  local scene name
  for scene in work/variants/*.yaml; do
    name=$(basename "$scene" .yaml)
    spawn still "variants/$name" "$scene" 128x72 exr
    spawn prints "words/explain/variant-$name.txt" skyshaft explain --scene "$scene"
  done
}

# Without the columns of times, and without what is best for its time.
trade() {
  writes trade/truth.exr skyshaft trade --scene outputs/bench/scenes/room.yaml -o work/trade --size 64x36 --frames 1 \
    --setting march:steps=64 --setting minmax --overwrite || return
  cp work/trade/*.exr outputs/trade/
  prints trade/errors.csv sed -E '1d; s/^(.*",)([^,]*,){3}/\1/; s/,[01],([a-z]*)$/,\1/' work/trade/trade.csv
}

# --- video

demo() {
  mkdir -p work/demo outputs/demo
  writes demo/clip.truth.csv skyshaft synth data/synth/demo.yaml -o work/demo/clip.mp4 --frames 40 --overwrite || return
  cp work/demo/clip.{truth.csv,corners.csv,camera.yaml,scene.yaml} outputs/demo/
  frames demo/clip mp4
  local demo=(--camera work/demo/clip.camera.yaml)
  composite demo/composite mp4 demo/clip.mp4 data/scenes/demo.yaml "${demo[@]}" --frames 0:40
  spawn writes demo/contact.png skyshaft contact work/demo/clip.mp4 work/demo/composite.mp4 -o outputs/demo/contact.png --width 320
  spawn composite demo/no-anti-alias mkv demo/clip.mp4 work/demo-no-anti-alias.yaml "${demo[@]}" --frames 10:16 --codec ffv1
  spawn composite demo/march mkv demo/clip.mp4 data/scenes/demo.yaml "${demo[@]}" --frames :3 --codec ffv1 --shafts march:steps=64
  spawn composite demo/night mkv demo/clip.mp4 data/scenes/demo.yaml "${demo[@]}" --frames :3 --codec ffv1 --time 2024-06-21T22:30:00Z
  spawn composite demo/field-of-view mkv demo/clip.mp4 data/scenes/demo.yaml --fov 64 --frames 30: --codec ffv1
  prints detect/demo.csv skyshaft detect work/demo/clip.mp4 --camera work/demo/clip.camera.yaml --size 0.5
  ffmpeg -nostdin -v error -i work/demo/clip.mp4 -vf 'select=not(mod(n\,13))' -vsync 0 work/demo/frame_%02d.png
  spawn prints detect/frames.csv skyshaft detect work/demo/frame_%02d.png
  spawn prints detect/frames.json skyshaft detect work/demo/frame_%02d.png --format json
  spawn prints detect/poses.json skyshaft detect work/demo/frame_%02d.png --fov 64 --size 0.5 --format json --decimate 1
  ffmpeg -nostdin -v error -i work/demo/clip.mp4 -frames:v 4 -vf scale=640:360 -c:v ffv1 work/demo/small.mkv
  spawn composite demo/small mkv demo/small.mkv data/scenes/demo.yaml "${demo[@]}" --scale-camera --codec ffv1 --at 43.5263,5.4454
}

# Each lens model and a clip of 10 bits, made and composited: what each pixel goes through.
lenses() {
  local spec name
  for spec in work/lens/*.spec.yaml; do
    name=lens/$(basename "$spec" .spec.yaml)
    writes "$name.truth.csv" skyshaft synth "$spec" -o "work/$name.mkv" --overwrite || continue
    cp "work/$name".{truth.csv,corners.csv,camera.yaml,scene.yaml} outputs/lens/
    frames "$name" mkv
    cat work/lens/things.yaml >>"work/$name.scene.yaml"
    composite "$name-composite" mkv "$name.mkv" "work/$name.scene.yaml" --camera "work/$name.camera.yaml" --codec ffv1
  done
}

# --- tables

sun() {
  local at=(--at 48.8584,2.2945,35) tier
  local year=("${at[@]}" --time 2024-01-01T04:30:00Z --until 2024-12-31T00:00:00Z --step 31h)
  for tier in precise psa daily; do
    prints "sun/year-$tier.csv" skyshaft sun "${year[@]}" --tier "$tier" --format csv
    prints "sun/batch-$tier.csv" skyshaft sun --batch work/sun.csv --tier "$tier"
    prints "sun/table-$tier.txt" skyshaft sun "${at[@]}" --time 2024-06-21T00:00:00Z --until 2024-06-22T00:00:00Z --tier "$tier"
    prints "sun/day-$tier.json" skyshaft sun "${at[@]}" --time 2024-06-21T07:30:00Z --tier "$tier" --format json
  done
  prints sun/air.csv skyshaft sun "${year[@]}" --pressure 850 --temperature -20 --turbidity 5 --format csv
  writes sun/day.svg skyshaft sun "${at[@]}" --time 2024-06-21T07:30:00Z --diagram outputs/sun/day.svg --overwrite
  writes sun/year.svg skyshaft sun "${at[@]}" --time 2024-06-21T07:30:00Z --diagram outputs/sun/year.svg --year --overwrite
  local format
  for format in csv json text; do
    prints "sun/average.$format" skyshaft sun "${at[@]}" --time 2024-06-21T03:00:00Z --until 2024-06-21T21:00:00Z \
      --step 3h --average --plane 180,30 --resolution 30 --format "$format"
  done
}
sky() {
  local model name format space
  for model in perez preetham preetham:rescaled cie:{1..15} scattering reference none image:work/sky.exr; do
    name=${model//[:\/]/-}
    prints "sky/batch-$name.csv" skyshaft sky --model "$model" --batch work/sky.csv
  done
  for model in perez scattering reference image:work/sky.exr; do
    name=${model//[:\/]/-}
    prints "sky/sun-$name.json" skyshaft sky --model "$model" --sun 135,32 --direction 135,33 --direction 0,60 --format json
  done
  prints sky/batch-original.csv skyshaft sky --bins original --batch work/sky-conditions.csv
  prints sky/batch-conditions.csv skyshaft sky --batch work/sky-conditions.csv
  prints sky/irradiance.csv skyshaft sky --sun 90,20 --irradiance 600,120 --direction 90,40 --format csv
  prints sky/condition.csv skyshaft sky --sun 90,20 --condition 1.3,0.3 --direction 90,40 --format csv
  for format in csv json text; do
    prints "sky/night.$format" skyshaft sky --at 48.8584,2.2945 --time 2024-06-21T22:30:00Z --direction 180,45 --format "$format"
    prints "sky/day.$format" skyshaft sky --at 48.8584,2.2945 --time 2024-06-21T07:30:00Z --direction 180,45 --format "$format"
  done
  for space in xyz yxy rgb; do
    prints "sky/space-$space.csv" skyshaft sky --sun 90,20 --direction 90,40 --space "$space" --format csv
  done
}
sky_pictures() {
  local tessellation projection clouds
  for tessellation in dome5728 dome144 geodesic; do
    prints "sky/patches-$tessellation.csv" skyshaft sky --sun 135,32 --patches "$tessellation"
  done
  for projection in fisheye latlong cube; do
    writes "sky/$projection.exr" skyshaft sky --sun 135,32 --projection "$projection" --size 64 -o "outputs/sky/$projection.exr"
  done
  for clouds in clear light cloudy overcast night; do
    writes "sky/$clouds.png" skyshaft sky --sun 135,32 --clouds "$clouds" --size 128 -o "outputs/sky/$clouds.png"
  done
  writes sky/seed.hdr skyshaft sky --sun 135,32 --clouds light --seed 7 --no-sun --size 64 -o outputs/sky/seed.hdr
  writes sky/exposure.png skyshaft sky --sun 270,4 --model preetham --exposure 0.0001 --size 64 -o outputs/sky/exposure.png
}

# --- tags, boards, cameras

dated() { sed -E 's/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z/(date)/g' "$1"; }
calibrated() { # NAME BOARD PICTURES FORMAT [OPTION...]
  local name=calibrate/$1
  attempt "$name.txt" 4 skyshaft calibrate "$3" --board "$2" -o "work/$name.yaml" --report "work/$name.html" --format "$4" \
    --accept --overwrite "${@:5}" || return
  prints "$name.yaml" dated "work/$name.yaml"
  prints "$name.html" dated "work/$name.html"
}
boards() {
  local board name
  for board in chessboard:9x6:25mm charuco:7x9:25mm:18mm:DICT_5X5_100 aprilgrid:5x6:30mm:0.3 \
    aprilgrid:3x3:40mm:0.4:tag25h9 tag:7:160mm; do
    name=${board//:/-}
    writes "board/$name.svg" skyshaft board "$board" -o "outputs/board/$name.svg" --overwrite
    writes "board/$name.png" skyshaft board "$board" -o "outputs/board/$name.png" --dpi 72 --overwrite
    spawn prints "board/$name.check.txt" skyshaft board "outputs/board/$name.yaml" --check "outputs/board/$name.png"
  done
  spawn prints detect/tag25h9.csv skyshaft detect outputs/board/aprilgrid-3x3-40mm-0.4-tag25h9.png --family tag25h9
}
calibrations() {
  local board name
  writes calibrate/views.csv cp work/tag-views_%02d.truth.csv outputs/calibrate/views.csv
  spawn calibrated tag-map work/tag-map.yaml work/tag-views opencv
  spawn calibrated tag-map-flatness work/tag-map.yaml work/tag-views ros --lens plumb-bob-4 --solve flatness
  for board in chessboard:9x6:25mm charuco:7x9:25mm:18mm:DICT_5X5_100 aprilgrid:5x6:30mm:0.3; do
    name=${board//:/-}
    tilted_views "outputs/board/$name.png" "work/views-$name"
    spawn calibrated "$name" "$board" "work/views-$name" kalibr --lens plumb-bob-4
  done
}

# What tells of a camera and of a place by the tag views and the pole that equality_inputs.sh makes.
cameras_and_maps() {
  local camera=work/tag-views_%02d.camera.yaml format
  for format in opencv ros kalibr; do
    writes "camera/$format.yaml" skyshaft camera convert work/lens/fisheye.camera.yaml -o "outputs/camera/$format.yaml" --format "$format"
  done
  prints camera/show.txt skyshaft camera show work/lens/rational.camera.yaml
  writes camera/scaled.yaml skyshaft camera scale "$camera" --size 1280x960 -o outputs/camera/scaled.yaml
  writes camera/crop.yaml skyshaft camera crop "$camera" --rect 20,10,600,400 -o outputs/camera/crop.yaml
  writes camera/straight.png skyshaft camera undistort work/lens/fisheye.camera.yaml work/tag-views/00.png -o outputs/camera/straight.png
  writes map/tags.yaml skyshaft map work/tag-views --camera "$camera" --size 160mm --origin 0 --flat -o outputs/map/tags.yaml
  prints map/compass.txt skyshaft north outputs/map/tags.yaml --tag 3 --compass 90 --declination 1.5
  prints map/shadow.txt skyshaft north work/pole-map.yaml --photo work/pole_0.png --camera work/pole_%d.camera.yaml \
    --base 410,250 --tip 300,200 --at 48.86,2.29 --time 2024-06-21T07:30:00Z
}

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
(cd outputs && find . -type f -printf '%P\0' | sort -z | xargs -0 sha256sum) >hashes.txt
[ ! -s work/failed ] || { echo "equality.sh: failed, see $PWD/work/failed" >&2; exit 1; }
