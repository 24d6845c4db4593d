#!/usr/bin/env bash
# bladefit beside its peers, in one run: installs what that needs, builds the preset bench, measures, prints the table and
# writes it as JSON. Fails where an answer of bladefit is wrong.
#   tests/bench/run.sh [--json FILE] [--markdown]
# FILE is build/bench/peers.json unless it is given; --markdown prints the tables in the form of the README.
set -euo pipefail
json=build/bench/peers.json
form=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --json) json=$(realpath -m "${2:?--json needs a file}") && shift 2 ;;
    --markdown) form=(--markdown) && shift ;;
    *) sed -n '2,5s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
  esac
done
cd "$(dirname "$0")/../.."

# One thread for all: libraries that could take more are not asked to.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

./tools/install.sh --bench >&2
cmake --preset bench >/dev/null
cmake --build --preset bench --target peers_bench bench_instructions >&2
echo "counting instructions" >&2
./tests/bench/instructions.sh build/bench/tests/bench/bench_instructions >build/bench/instructions.json
build/bench/tests/bench/peers_bench --json "$json" --instructions build/bench/instructions.json "${form[@]}"
