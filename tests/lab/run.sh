#!/usr/bin/env bash
# run.sh BUILD [FILTER]: inside the lab, every live test or those that googletest's FILTER names. Those of vivid mostly
# wait, so they run beside the others.
set -uo pipefail
tests=$1/lab_live
preloaded=$PWD/$1/tests/lab/liblab_firmware_node.so # see its source
[ ! -e "$preloaded" ] || export LD_PRELOAD=$preloaded
if [ $# -gt 1 ]; then exec "$tests" --gtest_filter="$2"; fi

"$tests" --gtest_brief=1 --gtest_filter='Vivid*' >/tmp/vivid.log 2>&1 &
vivid=$!
status=0
"$tests" --gtest_brief=1 --gtest_filter='-Vivid*' || status=$?
wait "$vivid" || status=$?
cat /tmp/vivid.log
exit "$status"
