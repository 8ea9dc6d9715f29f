#!/usr/bin/env bash
# tidy.sh BUILD <FILES: clang-tidy over the sources named on standard input, as many at a time as there are processors,
# with the compile commands of that build. Prints what it says of files with findings, names them, and then fails. With
# TIDY_SECONDS in the environment it begins no file after that many seconds, and names those left.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export build=$1 work end=$((EPOCHSECONDS + ${TIDY_SECONDS:-1000000}))

look_at() {
  if [ "$EPOCHSECONDS" -ge "$end" ]; then
    echo "$1" >>"$work/left"
    return 0
  fi
  local output
  output=$(clang-tidy -p "$build" --quiet "$1" 2>&1) && return 0
  { flock 9; printf '%s\n' "$output" >&2; echo "$1" >>"$work/failed"; } 9>"$work/lock"
}
export -f look_at

# shellcheck disable=SC2016 # the inner shell's
xargs -r -P "$(nproc)" -n 1 bash -c 'look_at "$1"' tidy
if [ -e "$work/left" ]; then
  echo "clang-tidy: no time for $(wc -l <"$work/left") files: $(paste -sd' ' "$work/left")" >&2
fi
if [ -e "$work/failed" ]; then
  echo "clang-tidy: findings in $(sort "$work/failed" | paste -sd' ')" >&2
  exit 1
fi
