#!/bin/sh
# Makes the pictures of the guide: the design of the tutorial as `bladefit show` draws it, by Chromium.
# Usage: pictures.sh BLADEFIT, from the root of the repository.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" show tests/data/dtmb4119/design.igs --leading-edge u:0.4:0.6 -o "$work/blade.html"
flags="--headless --hide-scrollbars --window-size=900,620 --virtual-time-budget=8000 --user-data-dir=$work/profile"
[ "$(id -u)" -ne 0 ] || flags="$flags --no-sandbox"  # its sandbox does not start for the superuser
# shellcheck disable=SC2086
chromium $flags --enable-unsafe-swiftshader --screenshot="$work/blade.png" "file://$work/blade.html"
cp "$work/blade.png" tools/guide/blade.png
