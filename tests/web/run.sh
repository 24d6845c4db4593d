#!/usr/bin/env bash
# The web panel in a browser: sessions of the built command, watched by Debian's Chromium. Screenshots are kept in
# build/web-shots. Not part of tests/run.sh: Chromium is large, and a run takes minutes.
#   tests/web/run.sh [NAME]     all tests, or those whose name matches
#   tests/web/run.sh picture    the picture of the README
#   tests/web/run.sh watchers   what a session loses while ten browsers watch
# Closes with one line: "bladefit: N passed, N failed".
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

./tools/install.sh --tests
if ! command -v chromium >/dev/null; then apt-get -q install -y --no-install-recommends chromium fonts-dejavu-core; fi
export BLADEFIT=${BLADEFIT:-$PWD/build/whole/bladefit}
if [[ ! -x $BLADEFIT ]]; then
  cmake --preset whole
  cmake --build --preset whole --target bladefit_command
fi

# The packages, and a copy of the tests beside them.
folder=build/web-tests
mkdir -p "$folder"
cp tests/web/*.mjs tests/web/package*.json "$folder"
cmp -s "$folder/package-lock.json" "$folder/node_modules/.bladefit-lock" || {
  (cd "$folder" && ../../tools/web/npm.sh "$(command -v node)" ci --ignore-scripts --no-audit --no-fund --loglevel=error)
  cp "$folder/package-lock.json" "$folder/node_modules/.bladefit-lock"
}

if [[ ${1:-} == picture || ${1:-} == watchers ]]; then exec node "$folder/$1.mjs"; fi
log=build/web-tests.log
node --test --test-reporter=tap ${1:+--test-name-pattern="$1"} "$folder/page_test.mjs" | tee "$log" || true
passed=$(sed -n 's/^# pass //p' "$log") failed=$(sed -n 's/^# fail //p' "$log")
echo "bladefit: ${passed:-0} passed, ${failed:-1} failed"
[[ ${failed:-1} -eq 0 && ${passed:-0} -gt 0 ]]
