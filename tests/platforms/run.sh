#!/usr/bin/env bash
# The same bits everywhere: builds core and C interface for several processors, by GCC and Clang, runs one stream of points
# in every mode on each (emulated by QEMU where this machine is another), and compares the digests of all that was said.
#   tests/platforms/run.sh [NAME...]     x86-64 clang plain i386 armhf aarch64 cortex-m7; all without a name
# Not part of tests/run.sh: the compilers for other processors are large, and a run takes minutes.
# Closes with one line: "bladefit: N passed, N failed".
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

declare -A compilers=([x86-64]=g++ [clang]=clang++ [plain]=g++ [i386]=g++ [armhf]=arm-linux-gnueabihf-g++
  [aarch64]=aarch64-linux-gnu-g++ [cortex-m7]=arm-none-eabi-g++)
declare -A packages=([x86-64]=g++ [clang]=clang [plain]=g++ [i386]="lib32stdc++-12-dev libc6-dev-i386"
  [armhf]="g++-arm-linux-gnueabihf qemu-user" [aarch64]="g++-aarch64-linux-gnu qemu-user"
  [cortex-m7]="gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-system-arm")
declare -A flags=([i386]="-m32 -idirafter /usr/include/x86_64-linux-gnu" [cortex-m7]="-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16")
declare -A emulators=([armhf]="qemu-arm -L /usr/arm-linux-gnueabihf" [aarch64]="qemu-aarch64 -L /usr/aarch64-linux-gnu")

names=("$@")
[[ $# -gt 0 ]] || names=(x86-64 clang plain i386 armhf aarch64 cortex-m7)
folder=$PWD/build/platforms
data=$PWD/tests/data/dtmb4119
bladefit=${BLADEFIT:-$PWD/build/whole/bladefit}
[[ -x $bladefit ]] || { cmake --preset whole && cmake --build --preset whole --target bladefit_command; }
mkdir -p "$folder"
"$bladefit" compile "$data/design.igs" -o "$folder/design.bfd" >/dev/null
arguments=("$folder/design.bfd" "$data/points.csv" 0.4 0.6)

# built NAME: core and C interface by the preset core, and the program.
built() {
  local name=$1 there=$folder/$1 compiler=${compilers[$1]} system=() link=() start=() extra=() objects=()
  local c_compiler=${compiler/%++/cc}
  [[ $name == clang ]] && c_compiler=clang
  case $name in
    armhf | aarch64) system=(-DCMAKE_SYSTEM_NAME=Linux "-DCMAKE_SYSTEM_PROCESSOR=$name") ;;
    cortex-m7)
      system=(-DCMAKE_SYSTEM_NAME=Generic -DCMAKE_SYSTEM_PROCESSOR=arm -DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY)
      start=(cortex_m7_start)
      link=(--specs=rdimon.specs -T tests/platforms/cortex_m7.ld)
      ;;
    plain) extra=(tests/golden/digest_plain.cpp) ;;
  esac
  cmake --preset core -B "$there" "-DCMAKE_CXX_COMPILER=$compiler" "-DCMAKE_C_COMPILER=$c_compiler" "-DCMAKE_CXX_FLAGS=${flags[$name]:-}" \
    "-DCMAKE_C_FLAGS=${flags[$name]:-}" "${system[@]}" >"$there.log" 2>&1 &&
    cmake --build "$there" --target bladefit >>"$there.log" 2>&1 &&
    (
      set -x
      # shellcheck disable=SC2086
      for source in platform_digest "${start[@]}"; do
        $c_compiler ${flags[$name]:-} -std=gnu99 -O1 -I. -c "tests/platforms/$source.c" -o "$there/$source.o" || exit
        objects+=("$there/$source.o")
      done
      # shellcheck disable=SC2086
      $compiler ${flags[$name]:-} -std=c++20 -I. "${link[@]}" "${objects[@]}" "${extra[@]}" "$there/firmware_bridge/libbladefit.a" \
        "$there/core/libbladefit_core.a" -lm -o "$there/platform_digest"
    ) >>"$there.log" 2>&1
}

# digests NAME POINTS: what the program says there.
digests() {
  local list
  if [[ $1 == cortex-m7 ]]; then
    list=$(printf ',arg=%s' platform_digest "${arguments[@]}" "$2")
    timeout 600 qemu-system-arm -M mps2-an500 -nographic -monitor none -serial none \
      -semihosting-config "enable=on,target=native$list" -kernel "$folder/$1/platform_digest"
  else
    # shellcheck disable=SC2086
    ${emulators[$1]:-} "$folder/$1/platform_digest" "${arguments[@]}" "$2"
  fi
}

passed=0 failed=0 points=400 expected=""
for name in "${names[@]}"; do
  # shellcheck disable=SC2086
  command -v "${compilers[$name]}" >/dev/null && [[ $name != i386 ]] || apt-get -q install -y --no-install-recommends ${packages[$name]} >/dev/null
  said=""
  if ! built "$name"; then
    tail -5 "$folder/$name.log"
  elif ! said=$(digests "$name" $points); then
    echo "$said"
    said=""
  fi
  [[ -n $expected ]] || { expected=$said && echo "$said"; }
  if [[ -n $said && $said == "$expected" ]]; then
    echo "$name: the same bits"
    passed=$((passed + 1))
  else
    echo "$name: FAILED" && diff <(echo "$expected") <(echo "$said") || true
    failed=$((failed + 1))
  fi
done
echo "bladefit: $passed passed, $failed failed"
[[ $failed -eq 0 ]]
