#!/usr/bin/env bash
# Runs findings and says of each whether it still stands. Usage: run.sh [SCRIPT ...]; without arguments all of them.
# Downloads are kept from one script to the next. Exit status: 0 all stand, 1 one has changed, 2 one could not be tried.
cd "$(dirname "$0")" || exit 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export FINDINGS_DEBS=${FINDINGS_DEBS:-$scratch/debs}
log=$scratch/log
[ $# -gt 0 ] || set -- ./*_*.sh
worst=0
for script in "$@"; do
  script=$(basename "$script")
  bash "$script" >"$log" 2>&1
  status=$?
  case $status in 0) word=stands ;; 1) word=CHANGED ;; *) word='not tried' status=2 ;; esac
  printf '%-10s %-38s %s\n' "$word" "$script" "$(sed -n '2s/^# //p' "$script")"
  if [ $status -gt 0 ]; then tail -n 12 "$log" | cut -c 1-160 | sed 's/^/    /'; fi
  [ $worst = 1 ] || [ $status = 0 ] || worst=$status
done
exit $worst
