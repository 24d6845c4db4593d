#!/usr/bin/env bash
# The web panel in a browser: sessions of the built command, watched by Debian's Chromium. Screenshots are kept in
# build/web-shots. Not part of tests/run.sh: Chromium is large, and a run takes minutes.
#   tests/web/run.sh [NAME]     all tests, or those whose name matches
#   tests/web/run.sh picture    the picture of the README
#   tests/web/run.sh watchers   what a session loses while ten browsers watch
#   tests/web/run.sh hmi        the HMIs of config/hmi: Node-RED and FUXA from npm, 500 MB of packages
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

# packages FOLDER WORD...: what npm brings into it, where that is not there yet; by `npm WORD...`.
packages() {
  local folder=$1 file=$1/package.json root=$PWD
  shift
  [[ -e $folder/package-lock.json && $1 == ci ]] && file=$folder/package-lock.json
  cmp -s "$file" "$folder/node_modules/.bladefit-packages" && return
  (cd "$folder" && "$root/tools/web/npm.sh" "$(command -v node)" "$@" --ignore-scripts --no-audit --no-fund --loglevel=error)
  cp "$file" "$folder/node_modules/.bladefit-packages"
}

# FUXA keeps its project in SQLite, whose binding is made here: ready ones come from another host than npm.
sqlite_binding() {
  local module=$folder/hmi/node_modules/sqlite3 headers
  [[ -e $module/build/Release/node_sqlite3.node ]] && return
  headers=$(dirname "$(dirname "$(readlink -f "$(command -v node)")")")
  apt-get -q install -y --no-install-recommends libsqlite3-dev make g++ python3
  [[ -e $headers/include/node/node_api.h ]] || apt-get -q install -y --no-install-recommends libnode-dev
  (cd "$module" && ../.bin/node-gyp rebuild --nodedir="$headers" --sqlite=/usr >build.log 2>&1) || { tail "$module/build.log"; exit 1; }
}

# The packages, and a copy of the tests beside them.
folder=build/web-tests
mkdir -p "$folder/hmi"
cp tests/web/*.mjs tests/web/package*.json "$folder"
packages "$folder" ci

if [[ ${1:-} == picture || ${1:-} == watchers ]]; then exec node "$folder/$1.mjs"; fi
log=build/web-tests.log tests=page_test.mjs
if [[ ${1:-} == hmi ]]; then
  cp tests/web/hmi/package.json "$folder/hmi/"
  packages "$folder/hmi" install --no-package-lock || { echo "bladefit: no HMIs are tested: npm did not bring them"; exit 77; }
  sqlite_binding
  tests=hmi_test.mjs
  shift
fi
node --test --test-reporter=tap ${1:+--test-name-pattern="$1"} "$folder/$tests" | tee "$log" || true
passed=$(sed -n 's/^# pass //p' "$log") failed=$(sed -n 's/^# fail //p' "$log")
echo "bladefit: ${passed:-0} passed, ${failed:-1} failed"
[[ ${failed:-1} -eq 0 && ${passed:-0} -gt 0 ]]
