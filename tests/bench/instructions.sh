#!/bin/sh
# Instructions a push, at 100 and at 2000 points, counted by callgrind: exact and repeatable, whatever else runs.
# usage: instructions.sh PUSH_INSTRUCTIONS (the program that the bench preset builds in tests/bench)
set -eu

program=${1:?usage: instructions.sh PUSH_INSTRUCTIONS}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Instructions inside Localizer::push over the first $1 points.
total() {
  valgrind --tool=callgrind --callgrind-out-file="$folder/out" --collect-atstart=no \
    --toggle-collect='bladefit::Localizer::push(bladefit::ProbePoint const&, bladefit::Verdict&)' \
    "$program" "$1" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
  sed -n 's/^\(summary\|totals\): *//p' "$folder/out" | head -n 1
}

# Mean over the 50 pushes that end at $1 points: one alone depends on which points its refresh meets.
at() {
  echo "$(( ($(total "$1") - $(total $(($1 - 50)))) / 50 ))"
}

early=$(at 100)
late=$(at 2000)
echo "instructions a push: $early at 100 points, $late at 2000 points"
