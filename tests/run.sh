#!/usr/bin/env bash
# Installs what is needed, builds, and runs every test. Closes with one line: "bladefit: N passed, N failed".
#   tests/run.sh            format, lint, and all tests in the preset whole: dev, built quickest from nothing
#   tests/run.sh PRESET     the tests of one preset only: dev, whole, release, asan-ubsan or tsan (each builds everything)
#   tests/run.sh lint       format and lint only; tests/lint.sh FOLDER lints one folder
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-all}" in
  all | lint | dev | whole | release | asan-ubsan | tsan) ;;
  *)
    sed -n '2,5s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac

passed=0
failed=0

# check NAME COMMAND...: counts one check by its exit code.
check() {
  local name=$1
  shift
  echo "== $name"
  if "$@"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
  fi
}

sources() { git ls-files --cached --others --exclude-standard '*.cpp' '*.hpp' '*.c' '*.h'; }

formatted() { sources | xargs clang-format --dry-run --Werror; }

# tests_of PRESET CTEST_ARGUMENTS...: builds a preset, runs its tests and adds up what ctest counted.
tests_of() {
  local preset=$1 log
  shift
  echo "== preset $preset: building"
  log="build/$preset/test.log"
  # The preset release has no tests of its own accord.
  cmake --preset "$preset" -DBUILD_TESTING=ON >"/tmp/bladefit-configure.$$" || { cat "/tmp/bladefit-configure.$$"; rm -f "/tmp/bladefit-configure.$$"; failed=$((failed + 1)); return; }
  rm -f "/tmp/bladefit-configure.$$"
  if ! cmake --build --preset "$preset"; then
    failed=$((failed + 1))
    echo "FAILED: preset $preset does not build"
    return
  fi
  echo "== preset $preset: testing"
  # One more than there are processors: sessions wait for their machine most of the time.
  ctest --preset "$preset" --parallel "$(($(nproc) + 1))" --output-on-failure "$@" | tee "$log" || true
  local total bad
  total=$(sed -n 's/.*tests passed, \([0-9]*\) tests failed out of \([0-9]*\)/\2/p' "$log")
  bad=$(sed -n 's/.*tests passed, \([0-9]*\) tests failed out of \([0-9]*\)/\1/p' "$log")
  if [[ -z "$total" || "$total" -eq 0 ]]; then
    failed=$((failed + 1))
    echo "FAILED: preset $preset ran no test"
    return
  fi
  passed=$((passed + total - bad))
  failed=$((failed + bad))
}

./tools/install.sh --tests
case "${1:-all}" in
  all)
    check "format (clang-format)" formatted
    check "lint (clang-tidy, house rules)" ./tests/lint.sh
    # Random tests draw the same cases in every run of these, so that a failure means a change; the other presets draw anew.
    export RC_PARAMS=${RC_PARAMS:-seed=1991}
    tests_of whole
    ;;
  lint)
    check "format (clang-format)" formatted
    check "lint (clang-tidy, house rules)" ./tests/lint.sh
    ;;
  *) tests_of "$1" ;;
esac
echo "bladefit: $passed passed, $failed failed"
[[ $failed -eq 0 ]]
