#!/usr/bin/env bash
# Installs by apt what bladefit is built with and what its demo checks the answer with; with --tests also what its tests
# use, with --bench what its benchmarks use. Does nothing where all is there.
# Exit codes: 0 all is there; 2 wrong use; 3 packages are missing and cannot be installed from here: no root and no sudo,
# or no network. Then one line says what is in the way and what to type.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libeigen3-dev libmodbus-dev libserialport-dev libocct-data-exchange-dev
  libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libcpp-httplib-dev libssl-dev zlib1g-dev nodejs python3)
if [[ "${1:-}" == "--tests" ]]; then
  packages+=(libgtest-dev librapidcheck-dev libnlopt-dev mbpoll valgrind clang-format clang-tidy universal-ctags binutils git
    tmux dpkg-dev file)
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

# give_up WHY: the one line.
give_up() {
  echo "install.sh: $1; as root: apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 3
}

# A password is asked for only where somebody can type it.
sudo_works() {
  command -v sudo >/dev/null || return 1
  sudo -n true 2>/dev/null && return
  [[ -t 0 ]] || return 1
  echo "Asking sudo, to install ${missing[*]}"
  sudo true
}

command -v apt-get >/dev/null || give_up "packages are missing, and there is no apt-get here"
as_root=()
if [[ $EUID -ne 0 ]]; then
  sudo_works || give_up "packages are missing, and cannot be installed without root or sudo"
  as_root=(sudo)
fi

logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -q "$@" 2>&1 </dev/null; }

# progress: what apt-get install writes, in a line for every 20 packages. Says nothing until the first package is there.
progress() {
  local line kind size=""
  declare -A said=([Get]="fetched" [Unpacking]="unpacked" [Setting]="set up") count=()
  while read -r line; do
    kind=${line%%[: ]*}
    case $line in
      "Need to get"*) size=$line ;;
      "Get:"* | "Unpacking "* | "Setting up "*)
        [[ ${#count[@]} -gt 0 ]] || echo "Installing ${#missing[@]} packages and what they need: ${missing[*]}. $size"
        count[$kind]=$((${count[$kind]:-0} + 1))
        ((count[$kind] % 20)) || echo "  ${count[$kind]} ${said[$kind]}"
        ;;
    esac
  done
}

# Why there are no packages: an error of apt's own, else what kept it from the lists of packages.
reason() {
  {
    grep '^E: ' "$logs/install" | grep -v 'Unable to locate package'
    grep '^[EW]: ' "$logs/update"
    grep '^E: ' "$logs/install"
  } | sed -n '1s/^[EW]: \(Failed to fetch [^ ]* *\)\{0,1\}//p'
}

echo "Asking apt for ${#missing[@]} packages"
apt update >"$logs/update" || true # what is on lists from before may do
if ! apt install -y --no-install-recommends "${missing[@]}" | tee "$logs/install" | progress; then
  give_up "packages are missing, and could not be installed ($(reason || true))"
fi
