#!/usr/bin/env bash
# Holds the digests of all verdicts, reports and revisions (digest.cpp) to those on file, to the last bit.
#   digest.sh              compares; prints the lines that differ
#   digest.sh --update     writes what this build gives to digest.txt
# Two PROGRAMs after these, with the wide registers of the processor and without, stand for those that the preset release
# builds. Both must give the same lines.
set -euo pipefail
cd "$(dirname "$0")/../.."

on_file=tests/golden/digest.txt
update=false
case "${1:-}" in
  --update) update=true && shift ;;
  -*) sed -n '2,6s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
esac

programs=("${@:-}")
if [[ $# -eq 0 ]]; then
  cmake --preset release -DBUILD_TESTING=ON >/dev/null
  cmake --build --preset release --target golden_digest golden_digest_plain >&2
  programs=(build/release/tests/golden/golden_digest build/release/tests/golden/golden_digest_plain)
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${programs[0]}" >"$folder/wide" &
"${programs[1]}" >"$folder/plain"
wait $!

if ! diff "$folder/wide" "$folder/plain"; then
  echo "The wide registers give other digests (<) than the plain code (>)." >&2
  exit 1
fi
if $update; then
  cp "$folder/wide" "$on_file"
elif ! diff "$on_file" "$folder/wide"; then
  echo "Verdicts, reports or revisions differ from those on file (<). Where that is meant: tests/golden/digest.sh --update" >&2
  exit 1
fi
echo "$(wc -l <"$on_file") digests are those on file, with the wide registers and without."
