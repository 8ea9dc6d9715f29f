#!/usr/bin/env bash
# `package_test.sh BUILD_DIR`: the .deb holds a program that runs and the data it is shipped with, and names what it
# needs; `cmake --install` puts the same into a prefix.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }

(cd "$work" && cpack -G DEB --config "$build/CPackConfig.cmake" >cpack.log) || { cat "$work/cpack.log"; fail "cpack"; }
deb=$(echo "$work"/skyshaft_*.deb)
depends=$(dpkg-deb -f "$deb" Depends)
for library in libavcodec libopencv-core libapriltag liberfa libyaml-cpp libegl1 libgl1-mesa-dri; do
  grep -q "$library" <<<"$depends" || fail "the package does not depend on $library: $depends"
done
dpkg-deb -x "$deb" "$work/root"
cmake --install "$build" --prefix "$work/prefix" >/dev/null

for prefix in "$work/root/usr" "$work/prefix"; do
  "$prefix/bin/skyshaft" --version | grep -q '^skyshaft [0-9]' || fail "$prefix: --version"
  "$prefix/bin/skyshaft" explain --scene "$prefix/share/skyshaft/scenes/demo.yaml" | grep -q shadow ||
    fail "$prefix: the shipped demo scene does not open"
  [ -s "$prefix/share/doc/skyshaft/copyright" ] || fail "$prefix: no licence"
done
