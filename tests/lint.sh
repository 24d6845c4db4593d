#!/usr/bin/env bash
# clang-tidy over the product, with the checks of .clang-tidy; without arguments also the house rules.
#   tests/lint.sh               everything, beginning with tests/house/house_rules.py
#   tests/lint.sh FOLDER...     the files in these folders, for example core drivers/serial
# Nearly all the time goes into the headers of Eigen, CLI11 and OpenCASCADE, so the files of a folder are read as one unit
# that includes them all. Files whose private names clash with those of others are put into a unit of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

units=$(mktemp -d)
trap 'rm -rf "$units"' EXIT
flags=(-std=c++20 "-I$PWD" -DEIGEN_MPL2_ONLY -DFMT_SHARED -DBLADEFIT_TEST_DATA='"tests/data"' -DBLADEFIT_VERSION='"0"')
flags+=(-isystem /usr/include/eigen3 -isystem /usr/include/modbus -isystem /usr/include/opencascade)
flags+=(-isystem /usr/include/coin -DHAVE_CSTDDEF)  # Ipopt's, for tests/bench

# unit_of FILE...: one source that includes the files; prints its name.
unit_of() {
  local unit
  unit=$(mktemp "$units/XXXXXX.cpp")
  printf "#include \"$PWD/%s\"\n" "$@" >"$unit"
  echo "$unit"
}

# clashing FILE...: those of the files that do not compile together with the ones before them.
clashing() {
  g++ "${flags[@]}" -fsyntax-only -w "$(unit_of "$@")" 2>&1 | sed -n "s|^$PWD/\([^:]*\.cpp\):[0-9:]* error: .*|\1|p" | sort -u
}

# Bodies of templates that nobody calls, nearly all of them Eigen's, are not parsed.
tidy() { clang-tidy --quiet --config-file=.clang-tidy "$(unit_of "$@")" -- "${flags[@]}" -fdelayed-template-parsing 2>/dev/null; }

lint() {
  local apart together report code=0 bad=0
  report=$(tidy "$@") || code=$?
  if [[ $code -eq 0 ]]; then
    [[ -z $report ]] || echo "$report"
    return
  fi
  # Names that clash are errors, and clang-tidy does not survive some of them.
  if [[ $code -lt 128 && $report != *clang-diagnostic-error* ]]; then
    echo "$report"
    return 1
  fi
  mapfile -t apart < <(clashing "$@")
  if [[ ${#apart[@]} -eq 0 || ${#apart[@]} -eq $# ]]; then
    echo "lint: clang-tidy ends with $code over $*"
    echo "$report"
    return 1
  fi
  mapfile -t together < <(printf '%s\n' "$@" | grep -vxF "$(printf '%s\n' "${apart[@]}")")
  lint "${together[@]}" || bad=1
  lint "${apart[@]}" || bad=1
  return $bad
}

# tools/design has OpenCASCADE's headers, the rest of tools has those of CLI11: they are kept apart.
sources_of() {
  local sources=(git ls-files --cached --others --exclude-standard "$1/*.cpp")
  if [[ $1 == tools ]]; then "${sources[@]}" | grep -v '^tools/design/'; else "${sources[@]}"; fi
}

bad=0
if [[ $# -eq 0 ]]; then
  tests/house/house_rules.py || bad=1
  printf '%s\n' tools core tools/design firmware_bridge drivers config | xargs -P "$(nproc)" -n 1 "$0" || bad=1
  exit $bad
fi
for folder in "$@"; do
  mapfile -t files < <(sources_of "$folder")
  lint "${files[@]}" || bad=1
done
exit $bad
