# What is computed and written as text: light, tags, boards, cameras, and the help. Sourced by equality.sh.

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

# FILE without its date, numbers to nine digits: with `--solve flatness` the sixteenth digit of the camera's numbers was
# seen to differ from one run to the next on a busy machine. Why is not known.
settled() {
  sed -E 's/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z/(date)/g' "$1" | awk '{
    line = ""
    while (match($0, /-?[0-9]+\.[0-9][0-9][0-9][0-9][0-9][0-9][0-9][0-9]+(e-?[0-9]+)?/)) {
      line = line substr($0, 1, RSTART - 1) sprintf("%.9g", substr($0, RSTART, RLENGTH))
      $0 = substr($0, RSTART + RLENGTH)
    }
    print line $0 }'
}
calibrated() { # NAME BOARD PICTURES FORMAT [OPTION...]
  local name=calibrate/$1
  attempt "$name.txt" 4 skyshaft calibrate "$3" --board "$2" -o "work/$name.yaml" --report "work/$name.html" --format "$4" \
    --accept --overwrite "${@:5}" || return
  prints "$name.yaml" settled "work/$name.yaml"
  prints "$name.html" settled "work/$name.html"
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

# What tells of a camera and of a place by the tag views and the pole that inputs.sh makes.
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
