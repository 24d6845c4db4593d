#!/usr/bin/env bash
# Builds the page of the web panel and packs it into a source: npm gets three.js, uPlot and Vite in the versions of the
# lock file, Vite makes a few files of them. Where that cannot be had, without a network for example, the source holds no
# page, one line says why, and the next build tries again.
#   tools/web/bundle.sh NODE FOLDER OUT.cpp
set -euo pipefail

node=$1 folder=$2 out=$3
here=$(dirname "$(readlink -f "$0")")
npm() { "$here/npm.sh" "$node" "$@"; }

# Modules are looked for beside the sources: these are built in a copy. What npm got before is kept while it is right.
mkdir -p "$folder"
rm -rf "$folder/src" "$folder/dist"
cp -r "$here"/page/. "$folder"
cd "$folder"

# Where a command is asked about as a whole the shell goes on after what fails in it: each step asks by itself.
packages() {
  cmp -s package-lock.json node_modules/.bladefit-lock && return
  npm ci --omit=dev --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-retry-mintimeout=1000 &&
    cp package-lock.json node_modules/.bladefit-lock
}
build() { packages && "$node" node_modules/vite/bin/vite.js build --logLevel warn && "$node" pack.mjs dist "$out"; }

log=$folder/bundle.log
if build >"$log" 2>&1; then exit 0; fi
if [[ -e node_modules/.bladefit-lock ]]; then
  # Everything was there: the sources are wrong.
  cat "$log" >&2
  exit 1
fi
echo "bladefit: built without the web panel, panel.http will be refused: $(grep -m1 -v '^ *$' "$log"); see $log" >&2
printf '#include "tools/web/page_files.hpp"\n\nstd::span<const bladefit::PageFile> bladefit::page_files() { return {}; }\n' >"$out"
touch -d @1 "$out"
