#!/usr/bin/env bash
# Installs what bladefit is built with, by apt; with --tests also what its tests use, with --bench what its benchmarks use.
# Does nothing where all is there.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libeigen3-dev libmodbus-dev libserialport-dev libocct-data-exchange-dev
  libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libboost-dev)
if [[ "${1:-}" == "--tests" ]]; then
  packages+=(libgtest-dev librapidcheck-dev libnlopt-dev mbpoll python3 valgrind clang-format clang-tidy binutils git)
elif [[ "${1:-}" == "--bench" ]]; then
  packages+=(libgtest-dev librapidcheck-dev valgrind libsisl-dev libceres-dev libnlopt-dev libnlopt-cxx-dev
    coinor-libipopt-dev libnanoflann-dev)
elif [[ $# -gt 0 ]]; then
  echo "usage: tools/install.sh [--tests | --bench]" >&2
  exit 2
fi

missing=()
for package in "${packages[@]}"; do
  [[ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" == *"ok installed" ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
[[ $EUID -eq 0 ]] || as_root=(sudo)
echo "Installing ${#missing[@]} packages: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
