# What is drawn: stills and videos. Sourced by equality.sh.

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
  [ -f outputs/bench/scenes/room.yaml ] || return # the generator is missing or failed: named already
  for scene in outputs/bench/scenes/*.yaml; do
    name=$(basename "$scene" .yaml)
    spawn prints "words/explain/$name.txt" skyshaft explain --scene "$scene"
    for technique in $(techniques); do
      size=160x90
      case $technique-$name in
        reference-*) continue ;;
        # The finer models differ from the coarser in the number of triangles only: one technique draws them.
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
