#!/usr/bin/env bash
# ffmpeg -colorspace bt709 writes the tag over samples that BT.601's matrix made.
#
# Version:    Debian 12, ffmpeg 7:5.1.9-0+deb12u1
# Good guess: encoding RGB with "-colorspace bt709" converts with the matrix that the file then claims.
# Seen:       pure red is stored as Y 81, Cb 90, Cr 240 (BT.601's; BT.709's are 63, 102, 240) in a stream tagged
#             bt709, and comes back from the same ffmpeg as 255, 24, 0. With "-vf scale=out_color_matrix=bt709" added:
#             63, 102, 240.
. "$(dirname "$0")/lib.sh"
fetch_ffmpeg
ffmpeg=(inside ffmpeg -nostdin -v error -y)
printf '\377\0\0%.0s' {1..4096} >"$work/red.rgb"
for way in tag scale; do
  filter=null
  [ $way = tag ] || filter=scale=out_color_matrix=bt709
  "${ffmpeg[@]}" -f rawvideo -s 64x64 -pix_fmt rgb24 -i "$work/red.rgb" -vf "$filter" -c:v libx264 -qp 1 \
    -pix_fmt yuv444p -colorspace bt709 -color_primaries bt709 -color_trc bt709 "$work/$way.mp4"
  "${ffmpeg[@]}" -i "$work/$way.mp4" -f rawvideo -pix_fmt yuv444p "$work/$way.yuv"
  echo "${way}_matrix $(inside ffprobe -v error -show_entries stream=color_space -of csv=p=0 "$work/$way.mp4")"
  for plane in 0 1 2; do echo "${way}_$plane $(od -An -tu1 -j $((plane * 4096)) -N1 "$work/$way.yuv")"; done
done | tee "$work/out"
"${ffmpeg[@]}" -i "$work/tag.mp4" -f rawvideo -pix_fmt rgb24 - | od -An -tu1 -N3 |
  awk '{ print "back_red", $1; print "back_green", $2; print "back_blue", $3 }' | tee -a "$work/out"
seen 'v["tag_matrix"] == "bt709" && v["tag_0"] == 81 && v["tag_1"] == 90 && v["tag_2"] == 240' "$work/out"
seen 'v["scale_matrix"] == "bt709" && v["scale_0"] == 63 && v["scale_1"] == 102 && v["scale_2"] == 240' "$work/out"
seen 'v["back_green"] > 20' "$work/out"
