#!/usr/bin/env bash
# compare.sh OUT_A OUT_B: what equality.sh --compare does. Pictures and videos that differ are decoded, and by
# how much their samples differ is told: the largest difference and the root of the mean squared one, in steps of 8 or
# 16 bits, or in cd/m2 of EXR files, beside the largest value and the root mean square of A.
set -euo pipefail
export LC_ALL=C
a=$1 b=$2
for folder in "$a" "$b"; do
  [ -f "$folder/hashes.txt" ] || { echo "equality.sh: $folder: has no hashes.txt; make it with equality.sh" >&2; exit 2; }
done
cmp -s "$a/machine.txt" "$b/machine.txt" || echo "note: made on different machines, where the last bits may differ"

samples() { ffmpeg -nostdin -v error -i "$1" -map 0:v -f rawvideo "${@:2}" -; } # FILE [OPTION...]

# Numbers of two files side by side, a and b: how far apart they are. What is no number but the same is no difference.
far_apart() {
  awk 'function abs(x) { return x < 0 ? -x : x }
    NF != 2 { odd = 1; next }
    $1 == $2 { ++n; if ($1 ~ /^-?[0-9]/) { if (abs($1) > top) top = abs($1); own += $1 * $1 }; next }
    ($1 $2) ~ /n/ { ++n; ++unreal; next }
    { ++n; ++differ; d = abs($1 - $2); if (d > most) most = d; sum += d * d; if (abs($1) > top) top = abs($1); own += $1 * $1 }
    END {
      printf "max %.6g, RMS %.4g, in %d of %d samples (A: max %.6g, RMS %.4g)%s%s", most, sqrt(sum / n), differ, n, top,
             sqrt(own / n), unreal ? "; " unreal " of them finite in one only" : "", odd ? "; of another size" : "" }'
}
# Differing bytes only, as `cmp -l` lists them in octal.
bytes_apart() { # FILE_A FILE_B
  cmp -l <(samples "$1") <(samples "$2") 2>&1 | awk -v all="$(samples "$1" | wc -c)" '
    function decimal(o) { return int(o / 100) * 64 + int(o % 100 / 10) * 8 + o % 10 }
    !/^ *[0-9]+ +[0-7]+ +[0-7]+$/ { odd = "; of another size"; next }
    { d = decimal($2) - decimal($3); ++n; sum += d * d; if (d < 0) d = -d; if (d > most) most = d }
    END { printf "max %d, RMS %.4g of 255, in %d of %d samples%s", most, sqrt(sum / all), n, all, odd }'
}
# FILE_A FILE_B: by what their samples are stored in.
pictures_apart() {
  local format
  format=$(ffprobe -v error -select_streams v -show_entries stream=pix_fmt -of csv=p=0 "$1" </dev/null | tr -d ,)
  case $format in
    *f32le) paste -d ' ' <(samples "$1" | od -An -v -tf4 -w4) <(samples "$2" | od -An -v -tf4 -w4) | far_apart ;;
    *le | *be) paste -d ' ' <(samples "$1" | od -An -v -tu2 -w2) <(samples "$2" | od -An -v -tu2 -w2) | far_apart ;;
    *) bytes_apart "$1" "$2" ;;
  esac
}
lines_apart() { # FILE_A FILE_B
  { diff "$1" "$2" || true; } | awk '/^</ { if (!first) first = $0; ++gone } /^>/ { if (!new) new = $0; ++come }
    END { printf "%d lines in A, %d in B differ", gone, come
          if (first) printf "\n      %s", substr(first, 1, 150); if (new) printf "\n      %s", substr(new, 1, 150) }'
}
how_far_apart() { # NAME
  local video
  case $1 in
    *.framemd5)
      video=${1%.framemd5}
      video=$(cd "$a" && ls "work/$video".m[pk][4v] | head -1)
      printf '%d frames; ' "$({ diff "$a/outputs/$1" "$b/outputs/$1" || true; } | grep -c '^<')"
      pictures_apart "$a/$video" "$b/$video"
      ;;
    *.exr | *.png) pictures_apart "$a/outputs/$1" "$b/outputs/$1" ;;
    *.glb | *.hdr) printf 'other bytes' ;;
    *) lines_apart "$a/outputs/$1" "$b/outputs/$1" ;;
  esac
}

# NAME and how often it is there: in both with equal hashes it is one line, else it is told.
differences=$(mktemp)
trap 'rm -f "$differences"' EXIT
join -j 2 -a 1 -a 2 -e - -o 0,1.1,2.1 "$a/hashes.txt" "$b/hashes.txt" | awk '$2 != $3' >"$differences"
status=0
tell() { # lines "NAME HASH_A HASH_B"
  local name of_a of_b
  while read -r name of_a of_b; do
    if [ "$of_b" = - ]; then echo "  $name: in A only"; continue; fi
    if [ "$of_a" = - ]; then echo "  $name: in B only"; continue; fi
    echo "  $name: $(how_far_apart "$name")"
  done
}
if grep -q '^words/' "$differences"; then
  echo "words that differ, which is allowed:"
  grep '^words/' "$differences" | tell
fi
if grep -qv '^words/' "$differences"; then
  status=1
  echo "outputs that differ:"
  grep -v '^words/' "$differences" | tell
fi
echo "$(grep -vc '  words/' "$a/hashes.txt") outputs and $(grep -c '  words/' "$a/hashes.txt") pages of words in A;" \
  "$(grep -vc '^words/' "$differences" || true) outputs and $(grep -c '^words/' "$differences" || true) pages differ"
exit $status
