# What is given to the program: scenes, specs, views of boards, lists of suns and skies. Sourced by equality.sh.

# NAME: lines of a scene file. A pergola and a plant in the sun, in what else is said.
variant() {
  {
    cat <<'END'
skyshaft: 1
objects:
  - { model: ../../data/models/pergola.glb, position: [0, 0, 0], heading_deg: 20 }
  - { model: ../../data/models/plant.glb, position: [0.6, 0.4, 0], scale: 1.2 }
real:
  - { plane: ground }
  - { box: { size: [1.5, 0.45, 0.42], position: [-2.2, 0.3, 0.21], heading_deg: 60 } }
view: { eye: [4, -5, 1.6], target: [0, 0, 1.1], vertical_fov_deg: 45 }
END
    printf '%s\n' "${@:2}"
  } >"work/variants/$1.yaml"
}

variants() {
  local place='place: { latitude: 43.5263, longitude: 5.4454 }' time='time: 2024-06-21T16:00:00Z'
  local air='medium: { visibility: 30, albedo: 0.95, phase: hg, g: 0.7, extent: { box: [[-3, -3, 0], [3, 3, 3]] } }'
  local disc='sun: { azimuth_deg: 300, elevation_deg: 25, illuminance_lux: 45000, color: [1, 0.86, 0.68], angular_radius_deg: 0.5 }'
  local name
  mkdir work/variants
  for name in preetham preetham:rescaled cie:3 cie:12 scattering reference none image:../sky.exr; do
    variant "sky-$(basename "${name//:/-}" .exr)" "$place" "$time" "sky: { model: '$name' }" "$air"
  done
  for name in light overcast night; do
    variant "clouds-$name" "$place" "$time" "sky: { model: perez, clouds: { preset: $name, seed: 3 } }" "$air"
  done
  variant dawn "$place" 'time: 2024-06-21T04:05:00Z' "$air"
  variant moonlight "$place" 'time: 2024-06-21T22:30:00Z' 'exposure: { ev100: -3 }' "$air"
  variant stars "$place" 'time: 2024-06-06T22:30:00Z' 'exposure: { ev100: -6 }' "$air"
  variant clear-air "$place" "$time" 'quality: { anti_alias: false }'
  variant small-map "$place" "$time" 'quality: { shadow_map_size: 64, shafts: march }' "$air"
  variant wide-sun "$disc" 'quality: { shafts: "march:sun=disc" }' "$air"
  variant wide-sun-clear "$disc" 'exposure: { white_luminance: 9000 }'
  variant rayleigh "$disc" 'medium: { extinction: 0.05, albedo: 0.9, phase: rayleigh }'
  variant cornette-shanks "$disc" 'medium: { extinction: 0.05, phase: cornette-shanks, g: -0.4, shaft_gain: 2, fog_gain: 0.5 }'
  variant falloff "$disc" 'medium: { visibility: 25, phase: hg, g: 0.65, height_falloff: { scale_height: 3, base: 0.5 } }'
  variant falloff-in-box "$disc" \
    'medium: { visibility: 25, height_falloff: { scale_height: 1 }, extent: { box: [[-3, -3, 0], [3, 3, 3]] } }'
}

# NAME BIT_DEPTH CAMERA
lens() {
  cat >"work/lens/$1.spec.yaml" <<END
skyshaft_synth: 1
size: [256, 192]
bit_depth: $2
fps: 4
frames: 4
samples: 4
noise: 0.5
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
camera: $3
path: { orbit: { center: [0, 0, 0.3], radius: 2, height: 1.2, from_deg: 180, to_deg: 190 } }
tags:
  family: tag36h11
  size: 0.5
  map:
    - { id: 3, position: [-0.5, 0, 0.01], flat: { top_edge_heading_deg: 0 } }
    - { id: 4, position: [0.5, 0, 0.01], flat: { top_edge_heading_deg: 0 } }
    - { id: 5, position: [0, 0.7, 0.01], flat: { top_edge_heading_deg: 0 } }
ground: { surface: plain, around: plain }
END
}
lens_clips() {
  mkdir work/lens
  lens pinhole 8 '{ fov_deg: 60 }'
  lens ten-bit 10 '{ fov_deg: 60 }'
  lens plumb-bob 8 '{ fx: 220, fy: 221, cx: 130, cy: 94, model: plumb-bob, distortion: [-0.25, 0.06, 0.001, -0.002, 0.01] }'
  lens rational 8 \
    '{ fx: 220, fy: 221, cx: 130, cy: 94, model: rational, distortion: [0.1, 0.02, 0.001, -0.001, 0.001, 0.35, 0.08, 0.01] }'
  lens fisheye 8 '{ fx: 150, fy: 150, cx: 127, cy: 97, model: fisheye, distortion: [-0.02, 0.01, -0.005, 0.001] }'
  cat >work/lens/things.yaml <<'END'
objects: [ { model: ../../data/models/bench.glb, position: [0, 0.2, 0], scale: 0.6 } ]
medium: { visibility: 20, phase: hg, g: 0.6 }
END
}

tag_map() { # a grid of 4 x 3 tags on the ground, indented by $1
  local id
  for id in {0..11}; do
    echo "$1- { id: $id, size: 0.16, position: [$(awk "BEGIN { print 0.24 * ($id % 4) - 0.36, \",\", 0.24 * int($id / 4) - 0.24 }"), 0], flat: { top_edge_heading_deg: 0 } }"
  done
}
# Pictures of the grid from above, near and far, tilted all ways, and the same grid as a board to calibrate with.
tag_views() {
  { printf 'skyshaft_tags: 1\nfamily: tag36h11\nmap:\n'; tag_map '  '; } >work/tag-map.yaml
  cat >work/tag-views.yaml <<END
skyshaft_synth: 1
size: [640, 480]
fps: 1
frames: 12
samples: 9
noise: 0.8
blur_px: 0.4
shutter_s: 0.0001
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
camera: { fx: 520, fy: 521, cx: 322, cy: 238, model: plumb-bob, distortion: [-0.2, 0.05, 0.001, -0.0005] }
path:
  keyframes:
    - { time: 0, position: [0, -0.05, 1.1], target: [0, 0, 0] }
    - { time: 1, position: [0.6, -0.5, 0.8], target: [0.1, 0, 0] }
    - { time: 2, position: [0.7, 0.3, 0.7], target: [0.05, 0.1, 0] }
    - { time: 3, position: [0.1, 0.8, 0.8], target: [0, 0.05, 0] }
    - { time: 4, position: [-0.6, 0.6, 0.9], target: [-0.15, 0.1, 0] }
    - { time: 5, position: [-0.8, -0.1, 0.7], target: [-0.2, 0, 0] }
    - { time: 6, position: [-0.4, -0.7, 0.8], target: [0.1, -0.1, 0] }
    - { time: 7, position: [0.1, -0.8, 0.9], target: [0.15, 0, 0] }
    - { time: 8, position: [0.3, -0.1, 0.8], target: [0.2, 0.1, 0] }
    - { time: 9, position: [-0.3, 0.2, 0.8], target: [-0.25, -0.1, 0] }
    - { time: 10, position: [0.5, 0.6, 1.2], target: [0.2, 0.2, 0] }
    - { time: 11, position: [-0.5, -0.5, 1.3], target: [-0.2, -0.2, 0] }
tags:
  family: tag36h11
  size: 0.16
  map:
$(tag_map '    ')
ground: { surface: plain, around: plain }
END
  attempt words/made/tag-views.txt 0 skyshaft synth work/tag-views.yaml -o work/tag-views_%02d.png
  mkdir work/tag-views
  local picture
  for picture in work/tag-views_??.png; do mv "$picture" "work/tag-views/${picture#work/tag-views_}"; done
}

# A pole with its shadow, and a tag beside it that a map has turned.
pole() {
  cat >work/pole.yaml <<'END'
skyshaft_synth: 1
size: [640, 480]
samples: 4
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T07:30:00Z
camera: { fov_deg: 62 }
path: { keyframes: [ { time: 0, position: [-0.6, -3.2, 2.6], target: [-0.1, 0.2, 0.1] } ] }
tags: { family: tag36h11, size: 0.4, map: [ { id: 3, position: [-0.3, -0.6, 0.004], flat: { top_edge_heading_deg: 20 } } ] }
boxes: [ { size: [0.06, 0.06, 1.2], position: [0.7, 0.3, 0.6], surface: concrete } ]
ground: { surface: plain, around: plain }
END
  cat >work/pole-map.yaml <<'END'
skyshaft_tags: 1
family: tag36h11
map: [ { id: 3, size: 0.4, position: [-0.3, -0.6, 0.004], flat: { top_edge_heading_deg: -17 } } ]
END
  attempt words/made/pole.txt 0 skyshaft synth work/pole.yaml -o work/pole_%d.png --frames 1
}

# Times and places where the sun breaks elsewhere; skies with the sun at the zenith, low and down.
batches() {
  local time latitude longitude elevation view turbidity
  echo utc,lat_deg,lon_deg,height_m >work/sun.csv
  for time in 2016-12-31T23:59:60Z 2024-02-29T12:00:00Z 2100-03-01T00:00:00Z 1900-01-01T00:00:00Z 2024-06-21T07:30:00Z; do
    for latitude in -90 -33.9 0 23.4 69.65 90; do
      for longitude in -180 5.4 179.999999; do echo "$time,$latitude,$longitude,120"; done
    done
  done >>work/sun.csv
  echo utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,turbidity,sun_elevation_deg,sun_azimuth_deg >work/sky.csv
  for elevation in -20 -6 -0.3 3 20 48 90; do
    for turbidity in 2 6; do
      for view in 0,90 90,0.5 90,25 200,60 275,10 90,-10; do echo ",,,$view,$turbidity,$elevation,90"; done
    done
  done >>work/sky.csv
  echo utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,epsilon,delta,sun_elevation_deg,sun_azimuth_deg >work/sky-conditions.csv
  for elevation in 5 30 70; do
    for view in 0,90 90,25 200,60 275,10; do
      for turbidity in 1.03,0.3 1.3,0.2 2.5,0.15 5,0.1 9,0.05; do echo ",,,$view,$turbidity,$elevation,90"; done
    done
  done >>work/sky-conditions.csv
}

# PICTURE FOLDER: the page as ten cameras of one focal length see it, turned about three axes and moved.
tilted_views() {
  local size view=0 turn
  mkdir -p "$2"
  size=$(ffprobe -v error -select_streams v -show_entries stream=width,height -of csv=p=0:s=x "$1")
  for turn in '0.02 0.01 0 0 0 1' '0.5 0 0.1 0 0 1' '-0.5 0.1 0 0.1 0 1' '0 0.5 -0.1 0 0.1 1' '0.1 -0.5 0 -0.1 0 1' \
    '0.4 0.4 0.2 0 -0.1 0.9' '-0.4 0.4 -0.2 0.1 0.1 0.9' '0.35 -0.45 0 -0.1 -0.1 1.2' '-0.3 -0.3 0.3 0 0 1.3' '0.3 0 1.5 0.1 0.1 1.1'; do
    ffmpeg -nostdin -v error -y -i "$1" -vf "format=gray,perspective=$(awk -v s="${size/x/ } $turn" 'BEGIN {
      split(s, v, " "); w = v[1]; h = v[2]; a = v[3]; b = v[4]; c = v[5]
      f = 1.2 * h; z = 1.35 * f * v[8]
      for (i = 0; i < 4; ++i) {
        x = (i % 2 - 0.5) * w; y = (int(i / 2) - 0.5) * h
        x1 = cos(c) * x - sin(c) * y; y1 = sin(c) * x + cos(c) * y
        y2 = cos(a) * y1; z2 = sin(a) * y1
        x3 = cos(b) * x1 + sin(b) * z2; z3 = cos(b) * z2 - sin(b) * x1
        printf "%s%.6f:%.6f", i ? ":" : "", w / 2 + f * (x3 + v[6] * w) / (z + z3), h / 2 + f * (y2 + v[7] * h) / (z + z3)
      } }'):interpolation=cubic:sense=destination" "$2/$(printf %02d $view).png"
    view=$((view + 1))
  done
}

make_inputs() {
  mkdir -p outputs/bench/scenes outputs/models
  attempt words/made/bench.txt 0 "$build/skyshaft-bench-scenes" outputs/bench/scenes
  attempt words/made/models.txt 0 "$build/skyshaft-models" outputs/models
  attempt words/made/sky.txt 0 skyshaft sky --sun 135,32 --projection latlong --size 128 -o work/sky.exr
  sed 's/^exposure:.*/&\nquality: { anti_alias: false, shadow_map_size: 1024 }/; s#\.\./models#../data/models#' \
    data/scenes/demo.yaml >work/demo-no-anti-alias.yaml
  variants
  lens_clips
  tag_views
  pole
  batches
}
