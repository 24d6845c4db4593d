#!/usr/bin/env bash
# fuzz/run.sh [SECONDS [SEED]]: the readers of outside input under the address and undefined-behaviour sanitizers, with
# changed inputs for so long, 600 s without a number. An input that breaks something is left in build/asan-ubsan.
# Exit codes: 0 everything holds, 1 something is broken or does not build.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-600}
seed=${2:-$RANDOM}
cmake --preset asan-ubsan >/dev/null
cmake --build --preset asan-ubsan --target fuzz_readers
echo "seed $seed"
cd build/asan-ubsan
export LSAN_OPTIONS="suppressions=$OLDPWD/tests/leak_suppressions.txt:print_suppressions=0"
export UBSAN_OPTIONS=abort_on_error=1  # so that the input is left behind here too
exec tests/fuzz/fuzz_readers "$OLDPWD/tests/fuzz/corpus" --seconds "$seconds" --seed "$seed"
