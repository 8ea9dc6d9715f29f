#!/usr/bin/env bash
# Measures the table that --max-error and --target-ms choose by, on the standard scenes:
#   tests/bench/measure_shaft_table.sh BUILD_FOLDER > data/shaft_table.csv
# On an idle machine: it takes some minutes, and its times are only worth what else the machine did.
set -euo pipefail
build=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$build/skyshaft-bench-scenes" "$scratch" >&2
for scene in gate-66k forest-66k room; do
  "$build/skyshaft" trade --scene "$scratch/$scene.yaml" -o "$scratch/$scene" --size "${SIZE:-640x360}" --frames "${FRAMES:-5}" >&2
done
cat "$scratch"/*/trade.csv | awk 'NR == 1 || !/^scene,/'
