#!/usr/bin/env bash
# FFmpeg's zscale turns HLG into a 1000 cd/m2 display's light, not into the scene's.
#
# Version:    Debian 12, ffmpeg 7:5.1.9-0+deb12u1 with libzimg2 3.0.4+ds1-1
# Good guess: "zscale=tin=arib-std-b67:t=linear" applies HLG's inverse OETF alone: 0.75 of the signal is 0.265 of the
#             scene's range, full signal is 1, and 0.5 of it is 1/12.
# Seen:       0.75 gives 2.03 and 1 gives 10: the light of a display with a peak of 1000 cd/m2, its system gamma of
#             1.2 included, in units of 100 cd/m2 (npl's default). 0.5 gives 0.507, a twentieth of the full signal,
#             not a twelfth.
. "$(dirname "$0")/lib.sh"
fetch_ffmpeg
fetch libzimg2=3.0.4+ds1-1
for signal in 0.5 0.75 1; do
  python3 -c 'import struct, sys; sys.stdout.buffer.write(struct.pack("<H", round(float(sys.argv[1]) * 65535)) * 768)' \
    $signal >"$work/grey"
  chain=zscale=tin=arib-std-b67:pin=bt2020:min=gbr:rin=full:t=linear:p=bt2020:m=gbr:r=full,format=gbrpf32le
  inside ffmpeg -nostdin -v error -y -f rawvideo -s 16x16 -pix_fmt gbrp16le -i "$work/grey" -vf $chain \
    -f rawvideo "$work/light"
  echo "$signal $(od -An -tf4 -N4 "$work/light")"
done | tee "$work/out"
seen '(v["0.75"] - 2.03)^2 < 0.0004 && (v["1"] - 10)^2 < 0.0001' "$work/out"
seen '(v["0.5"] - 0.507)^2 < 0.0001' "$work/out"
