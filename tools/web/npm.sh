#!/usr/bin/env bash
# npm for the build of the page: the one that is installed, else its own package, of a fixed version and checked, kept in
# the user's cache. Debian's package of it brings hundreds of others.
#   tools/web/npm.sh NODE ARGUMENTS...
set -euo pipefail

node=$1
shift
if command -v npm >/dev/null; then exec npm "$@"; fi

version=10.9.4
sha512=OnUG836FwboQIbqtefDNlyR0gTHzIfwRfE3DuiNewBvnMnWEpB0VEXwBlFVgqpNzIgYo/MHh3d2Hel/pszapAA==
folder=${XDG_CACHE_HOME:-$HOME/.cache}/bladefit/npm-$version
if [[ ! -e $folder/bin/npm-cli.js ]]; then
  part=$(mktemp -d)
  trap 'rm -rf "$part"' EXIT
  "$node" --input-type=module - "$version" "$sha512" "$part/npm.tgz" <<'SCRIPT'
import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
const [version, sha512, file] = process.argv.slice(2);
const registry = (process.env.npm_config_registry ?? "https://registry.npmjs.org").replace(/\/$/, "");
const refuse = (why) => {
  console.error(`npm ${version} cannot be fetched from ${registry}: ${why}`);
  process.exit(1);
};
const answer = await fetch(`${registry}/npm/-/npm-${version}.tgz`).catch((error) => refuse(error.cause?.message ?? error.message));
if (!answer.ok) refuse(`it answered ${answer.status}`);
const bytes = Buffer.from(await answer.arrayBuffer());
if (createHash("sha512").update(bytes).digest("base64") !== sha512) refuse("it is not the file that is expected");
writeFileSync(file, bytes);
SCRIPT
  mkdir -p "$(dirname "$folder")"
  tar -xzf "$part/npm.tgz" -C "$part"
  mv "$part/package" "$folder"
fi
"$node" "$folder/bin/npm-cli.js" "$@"
