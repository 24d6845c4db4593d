#!/usr/bin/env bash
# Counts instructions by callgrind: exact and repeatable, whatever else runs.
#   instructions.sh              prints the counts of this build as JSON
#   instructions.sh --check      compares them with instructions.json: fails where one differs by more than 5 %
#   instructions.sh --update     writes them to instructions.json
# A PROGRAM after these is counted instead of the one that the preset bench builds. The counts on file are of processors
# with AVX2: on others there are more.
set -euo pipefail
cd "$(dirname "$0")/../.."

on_file=tests/bench/instructions.json
action=print
case "${1:-}" in
  --check | --update) action=${1#--} && shift ;;
  -*) sed -n '2,7s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
esac

program=${1:-build/bench/tests/bench/bench_instructions}
if [[ $# -eq 0 ]]; then
  cmake --preset bench >/dev/null
  cmake --build --preset bench --target bench_instructions >&2
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Callgrind writes a file for each part, which says its NAME/DIVISOR and the total.
counted() {
  local part name parts total separator=
  valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file="$folder/out" "$program" >"$folder/log" 2>&1 ||
    { cat "$folder/log" >&2; return 1; }
  echo "{"
  for part in "$folder"/out.*; do
    IFS=/ read -r name parts < <(sed -n 's/^desc: Trigger: Client Request: //p' "$part")
    total=$(sed -n 's/^totals: *//p' "$part")
    printf '%s  "%s": %d' "$separator" "$name" $((total / parts))
    separator=$',\n'
  done
  printf '\n}\n'
}

# compared FILE COUNTS: a line for each count, and whether it is within 5 % of that on file.
compared() {
  awk -F'"|: |,' '
    /:/ && FNR == NR { filed[$2] = $4; next }
    /:/ {
      if (!($2 in filed)) { printf "%-32s %12d  not on file\n", $2, $4; bad = 1; next }
      change = 100 * ($4 - filed[$2]) / filed[$2]
      far = change > 5 || change < -5
      if (far) bad = 1
      printf "%-32s %12d  on file %12d  %+6.2f %%%s\n", $2, $4, filed[$2], change, far ? "  DIFFERS" : ""
      seen[$2] = 1
    }
    END {
      for (name in filed) if (!(name in seen)) { printf "%-32s was not counted\n", name; bad = 1 }
      exit bad
    }' "$1" "$2"
}

counted >"$folder/counts"
case $action in
  print) cat "$folder/counts" ;;
  update) cp "$folder/counts" "$on_file" && cat "$on_file" ;;
  check)
    compared "$on_file" "$folder/counts" || {
      echo "Instruction counts differ by more than 5 % from $on_file. Where that is meant: tests/bench/instructions.sh --update" >&2
      exit 1
    }
    ;;
esac
