#!/usr/bin/env bash
# skipped.sh LOG: one line for each test that skipped itself in CTest's log of a run, with its reason.
set -euo pipefail
[ -e "$1" ] || exit 0
awk '
  /: Skipped$/ { waiting = 1; why = ""; next }
  /^\[  SKIPPED \] .* \([0-9]+ ms\)$/ { print $4 (why == "" ? "" : ": " why); waiting = 0; why = ""; next }
  waiting && NF { why = why (why == "" ? "" : " ") $0 }
' "$1"
