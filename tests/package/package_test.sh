#!/usr/bin/env bash
# Installs what was built into a folder of its own and uses it from there, as a controller and an operator do: the host
# that README.md shows is compiled by pkg-config, by CMake and with the archive, and run; cpack makes both packages.
#   tests/package/package_test.sh BUILD
set -euo pipefail
build=$(readlink -f "$1")
cd "$(dirname "$0")/../.."
root=$PWD
data=$root/tests/data/dtmb4119
scratch=$build/package_test
prefix=$scratch/prefix
rm -rf "$scratch"
mkdir -p "$scratch"

fail() {
  echo "package: $*" >&2
  exit 1
}

# quietly COMMAND...: what it writes is shown only where it fails.
quietly() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" && fail "$* fails"; }; }

quietly cmake --install "$build" --prefix "$prefix"
library=$(find "$prefix" -name 'libbladefit.so')
libraries=$(dirname "$library")

# The library: its names, what it loads, what it is called.
foreign=$(nm --dynamic --defined-only --format=just-symbols "$library" | grep -v '^bladefit_' || true)
[[ -z $foreign ]] || fail "libbladefit.so exports $foreign"
diff <(nm --dynamic --defined-only --format=just-symbols "$library" | sort) \
  <(grep -ho '\bbladefit_[a-z_]*(' "$prefix"/include/bladefit{,_zones}.h | grep -vE 'bladefit_(config|point|verdict|fit_report)\(' | tr -d '(' | sort -u) ||
  fail "libbladefit.so and its headers name other calls"
needed=$(readelf --dynamic "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -vE '^(libc|libm)\.so' || true)
[[ -z $needed ]] || fail "libbladefit.so loads $needed"
version=$(sed -n 's/^#define BLADEFIT_ABI_VERSION \([0-9]*\).*/\1/p' "$prefix/include/bladefit.h")
[[ $(readelf --dynamic "$library") == *"soname: [libbladefit.so.$version]"* ]] || fail "libbladefit.so does not name version $version"

# The host of the README.
mkdir "$scratch/host"
cd "$scratch/host"
sed -n '/^```c$/,/^```$/p' "$root/README.md" | sed '1d;$d' >host.c
[[ $(wc -l <host.c) -le 60 ]] || fail "the host of the README has over 60 lines"
strict=(-std=c99 -pedantic -Wall -Wextra -Werror)
export PKG_CONFIG_PATH=$libraries/pkgconfig
quietly cc "${strict[@]}" host.c $(pkg-config --cflags --libs bladefit) -Wl,-rpath,"$libraries" -o by_pkg_config
quietly cc "${strict[@]}" host.c $(pkg-config --cflags bladefit) "$libraries/libbladefit.a" -lm -o by_archive
cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(host LANGUAGES C)
set(CMAKE_C_STANDARD 99)
find_package(bladefit 0.1 REQUIRED)
add_executable(by_cmake host.c)
target_link_libraries(by_cmake bladefit::bladefit)
add_executable(by_cmake_static host.c)
target_link_libraries(by_cmake_static bladefit::static)
END
quietly cmake -S . -B build -DCMAKE_PREFIX_PATH="$prefix"
quietly cmake --build build

# Points of the blade, with a defect of 0.4 mm at points 811 and 812.
quietly "$prefix/bin/bladefit" compile "$data/design.igs" -o blade.bfd
awk -F, 'NR > 1 { d = NR == 812 || NR == 813 ? 0.4 : 0; printf "%.6f %.6f %.6f\n", $1 - d * $4, $2 - d * $5, $3 - d * $6 }' \
  "$data/points.csv" >points.txt
for host in ./by_pkg_config ./by_archive build/by_cmake build/by_cmake_static; do
  "$host" blade.bfd <points.txt >said || fail "$host ends with $?"
  grep -q '^2000 points, fit converged' said || fail "$host says: $(tail -1 said)"
  out=$(sed -n 's/^end point \([0-9]*\): .*, \(.*\)$/\1 \2/p' said)
  [[ $(grep -cE '^(811|812) cut$' <<<"$out") -eq 2 ]] || fail "$host does not flag the defect: $out"
  [[ $(wc -l <<<"$out") -eq $(sed -n 's/.*leading edge \([0-9]*\) out.*/\1/p' said) ]] || fail "$host counts otherwise: $(cat said)"
done
status=0
./by_pkg_config "$data/points.csv" </dev/null 2>said || status=$?
[[ $status -eq 2 && $(cat said) == "host: "* ]] || fail "a design that is none ends with $status: $(cat said)"

# The command, from where it is installed: the CAD module was found, the pages are there.
[[ $(readelf --dynamic "$prefix/bin/bladefit" | grep -c "$build") -eq 0 ]] || fail "the installed command looks into the build folder"
for command in $("$prefix/bin/bladefit" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  [[ $command == help || $command == completion || -s $prefix/share/man/man1/bladefit-$command.1 ]] || fail "bladefit-$command.1 is missing"
done
for file in share/man/man1/bladefit.1 share/bash-completion/completions/bladefit share/zsh/vendor-completions/_bladefit \
  share/bladefit/session.toml share/bladefit/devices/modbus_tcp.toml lib/systemd/system/bladefit@.service; do
  [[ -s $prefix/$file ]] || fail "$file is missing"
done
grep -q "^ExecStart=/.*/bin/bladefit run " "$prefix/lib/systemd/system/bladefit@.service" || fail "the service names no command"

# The packages.
cd "$scratch"
quietly cpack --config "$build/CPackConfig.cmake" -B "$scratch/packages"
plugin=$(ls "$scratch"/packages/libbladefit_*.deb)
tools=$(ls "$scratch"/packages/bladefit_*.deb)
[[ $(stat -c %s "$plugin") -lt 5000000 ]] || fail "the package of the library has $(stat -c %s "$plugin") bytes"
[[ $(dpkg-deb --field "$plugin" Depends) =~ ^libc6 ]] || fail "the package of the library needs nothing?"
[[ ! $(dpkg-deb --field "$plugin" Depends) =~ occt ]] || fail "the package of the library needs OpenCASCADE"
grep '\./usr/include/bladefit.h$' <<<"$(dpkg-deb --contents "$plugin")" >/dev/null || fail "the package of the library has no header"
grep '\./usr/bin/bladefit$' <<<"$(dpkg-deb --contents "$tools")" >/dev/null || fail "the package of the tools has no command"
echo "installed and used: host by pkg-config, CMake and archive; packages of $(stat -c %s "$plugin") and $(stat -c %s "$tools") bytes"
