// Writes a source that holds the files of a folder, compressed: node pack.mjs FOLDER OUT.cpp
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { extname } from "node:path";
import { constants, gzipSync } from "node:zlib";

const kTypes = { ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml" };
const [folder, out] = process.argv.slice(2);
const names = readdirSync(folder).sort();
let text = '#include "tools/web/page_files.hpp"\n\n#include <array>\n\nnamespace {\n\n';
let rows = "";
names.forEach((name, k) => {
  const bytes = gzipSync(readFileSync(`${folder}/${name}`), { level: constants.Z_BEST_COMPRESSION });
  text += `constexpr unsigned char kFile${k}[] = {${bytes.join(",").replace(/(.{120}),/g, "$1,\n")}};\n`;
  rows += `    bladefit::PageFile{"/${name}", "${kTypes[extname(name)]}", kFile${k}},\n`;
  if (name === "index.html") rows += `    bladefit::PageFile{"/", "${kTypes[".html"]}", kFile${k}},\n`;
});
text += `\nconstexpr auto kFiles = std::to_array<bladefit::PageFile>({\n${rows}});\n\n}  // namespace\n\n`;
writeFileSync(out, `${text}std::span<const bladefit::PageFile> bladefit::page_files() { return kFiles; }\n`);
