#!/usr/bin/env bash
# Builds the preset core in a folder of its own, links a C99 program to it, and runs that: a controller needs nothing of
# this repository but core and firmware_bridge, and nothing else but Eigen and a compiler.
#   tests/core_only.sh
set -euo pipefail
cd "$(dirname "$0")/.."

scratch=$PWD/build/core_only
rm -rf "$scratch"

# What the rest of the house is built with cannot be found: to ask for it ends the configuration.
without=()
for package in PkgConfig Threads fmt tomlplusplus nlohmann_json CLI11 OpenCASCADE GTest rapidcheck NLopt; do
  without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done

# Neither can another part of the tree.
mkdir -p "$scratch/tree"
cp -r CMakeLists.txt CMakePresets.json core firmware_bridge "$scratch/tree"
rm -r "$scratch/tree/firmware_bridge/host"
cd "$scratch/tree"
cmake --preset core -B "$scratch/build" -DCMAKE_CXX_FLAGS_RELEASE="-O0 -DNDEBUG" "${without[@]}" >"$scratch/log" 2>&1 || { cat "$scratch/log" && exit 1; }
cmake --build "$scratch/build" --target bladefit >"$scratch/log" 2>&1 || { cat "$scratch/log" && exit 1; }
archives=("$scratch/build/firmware_bridge/libbladefit.a" "$scratch/build/core/libbladefit_core.a")

# The whole of the C interface is called, so that the linker has to find all that lies behind it.
cat >"$scratch/host.c" <<'END'
#include <stdio.h>
#include <string.h>

#include "firmware_bridge/bladefit_zones.h"

int main(void) {
  static const double design[64];
  static double memory[1024];
  const bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  bladefit_handle* handle = NULL;
  bladefit_point point;
  bladefit_verdict verdict;
  bladefit_fit_report report;
  bladefit_status pushed;
  bladefit_zone zone;
  uint32_t number;
  int refused = 0;
  memset(&point, 0, sizeof point);
  memset(&zone, 0, sizeof zone);
  if (bladefit_abi_version() != BLADEFIT_ABI_VERSION) return 1;
  if (bladefit_memory_required(&config, design, sizeof design) != 0) return 2;
  if (bladefit_design_check(design, sizeof design) != BLADEFIT_BAD_MAGIC) return 5;
  if (bladefit_init(memory, sizeof memory, design, sizeof design, &config, &handle) >= 0) return 3;
  refused += bladefit_push(handle, &point, &verdict) < 0;
  refused += bladefit_push_many(handle, &point, 1, &verdict, &pushed) < 0;
  refused += bladefit_next_revision(handle, &verdict) < 0;
  refused += bladefit_refine(handle, 1) < 0;
  refused += bladefit_conclude(handle) < 0;
  refused += bladefit_fit(handle, &report) < 0;
  refused += bladefit_verdict_of(handle, 1, &verdict) < 0;
  refused += bladefit_set_zones(handle, &zone, 1, NULL) < 0;
  refused += bladefit_zone_of(handle, 1, &number) < 0;
  refused += bladefit_reset(handle) < 0;
  printf("%s\n", bladefit_status_text(BLADEFIT_BAD_MAGIC));
  return refused == 10 ? 0 : 4;
}
END
"${CC:-cc}" -std=c99 -pedantic -Wall -Wextra -Werror -I. "$scratch/host.c" "${archives[@]}" -lm -o "$scratch/host"
"$scratch/host"

# Names that the archives leave to others, and libraries that the program loads.
names=$(nm --undefined-only --demangle "${archives[@]}" | awk '$1 == "U" { $1 = ""; print substr($0, 2) }' | sort -u)
if foreign=$(grep -E 'pthread|^fmt::|^modbus_|^sp_|std::thread|std::mutex' <<<"$names"); then
  echo "the core needs:"
  echo "$foreign"
  exit 1
fi
libraries=$(ldd "$scratch/host" | awk '{ print $1 }')
if foreign=$(grep -vE '^(linux-vdso|libc\.|libm\.|/lib.*/ld-)' <<<"$libraries"); then
  echo "a program with the core loads:"
  echo "$foreign"
  exit 1
fi
echo "the core stands alone: $(echo $libraries)"
