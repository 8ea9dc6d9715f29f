#!/usr/bin/env bash
# FFmpeg converts 4:2:0 to RGB in blocks of 2x2 pixels, whatever scaler is asked for.
#
# Version:    Debian 12, ffmpeg 7:5.1.9-0+deb12u1 (libswscale6)
# Good guess: flags=bicubic (the default), bilinear or lanczos say how chroma is brought to full resolution; a step of
#             colour comes out with a soft edge.
# Seen:       grey 4:2:0 with a step in Cr, to rgb24: red goes from 85 to 181 from one pixel to the next with each of
#             the three, and with full_chroma_int too: every chroma sample is repeated. Only with
#             full_chroma_int+accurate_rnd, or a planar output (gbrp), does the edge become a ramp.
. "$(dirname "$0")/lib.sh"
fetch_ffmpeg
python3 -c '
import sys
sys.stdout.buffer.write(bytes([128]) * (512 + 128) + (bytes([100]) * 8 + bytes([160]) * 8) * 8)' >"$work/step.yuv"
for flags in bicubic bilinear lanczos bicubic+full_chroma_int bicubic+full_chroma_int+accurate_rnd; do
  inside ffmpeg -nostdin -v error -f rawvideo -s 32x16 -pix_fmt yuv420p -i "$work/step.yuv" -vf "scale=flags=$flags" \
    -f rawvideo -pix_fmt rgb24 - |
    python3 -c 'import sys; print(sys.argv[1], len(set(sys.stdin.buffer.read()[4 * 96:5 * 96:3])))' "$flags"
done | tee "$work/out"  # how many values of red one row has: 2 is a step
seen 'v["bicubic"] == 2 && v["bilinear"] == 2 && v["lanczos"] == 2 && v["bicubic+full_chroma_int"] == 2' "$work/out"
seen 'v["bicubic+full_chroma_int+accurate_rnd"] > 5' "$work/out"
