// Sessions of the command for a browser to watch: a simulated machine or a recording, and `bladefit run` with a web panel.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const kRoot = process.env.BLADEFIT_ROOT ?? process.cwd();
export const kCommand = process.env.BLADEFIT ?? join(kRoot, "build/whole/bladefit");
export const kToken = "a token of nobody else".replaceAll(" ", "-");
const kDesign = join(kRoot, "tests/data/dtmb4119/design.igs");
const kPoints = join(kRoot, "tests/data/dtmb4119/points.csv");

export const folder = mkdtempSync(join(tmpdir(), "bladefit-web-"));
export const removeFolder = () => rmSync(folder, { recursive: true, force: true });

export function bladefit(...words) {
  const done = spawnSync(kCommand, words, { encoding: "utf8" });
  if (done.status > 1) throw new Error(`bladefit ${words[0]}: ${done.stderr}`);
  return done.stdout;
}

let compiled = "";
export function design() {
  if (!compiled) {
    compiled = join(folder, "blade.bfd");
    bladefit("compile", kDesign, "-o", compiled);
  }
  return compiled;
}

// The recorded points with defects, each from a point on (counted from 1), so many points long; depth > 0: excess material.
export function pointsWithDefects(defects) {
  const path = join(folder, "points.csv");
  const lines = readFileSync(kPoints, "utf8").trimEnd().split("\n").map((line, n) => {
    const cells = line.split(","), defect = defects.find(([first, count]) => n >= first && n < first + count);
    if (!defect) return line;
    return [...[0, 1, 2].map((k) => (Number(cells[k]) - defect[2] * Number(cells[k + 3])).toFixed(6)), ...cells.slice(3)].join(",");
  });
  writeFileSync(path, `${lines.join("\n")}\n`);
  return path;
}

export const pointsWithDefect = (first, count, depth) => pointsWithDefects([[first, count, depth]]);

// A grid all over the blade, in another pose.
export function gridPoints(grid) {
  const path = join(folder, `grid-${grid}.csv`);
  bladefit("sample", design(), "-o", path, "--grid", grid, "--window", "0.02:0.98", "--pose", "0.5,0.3,0.2,0.01,-0.02,0.005");
  return path;
}

// Starts a process and waits for a line that matches; gives the match. What it writes goes to a file.
function started(words, pattern) {
  const child = spawn(kCommand, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  const match = new Promise((done, failed) => {
    const hear = (chunk) => {
      said += chunk;
      const found = pattern.exec(said);
      if (found) done(found);
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", (code) => failed(new Error(`bladefit ${words[0]} ended with ${code}: ${said}`)));
  });
  return { child, match };
}

async function end(child, signal) {
  if (child.exitCode !== null || child.signalCode !== null) return;
  const gone = new Promise((done) => child.on("exit", done));
  child.kill(signal);
  await gone;
}

// A simulated machine: { port, stop }.
export async function machine(points, rate) {
  const { child, match } = started(["simulate", "--design", kDesign, "--points", points, "--transport", "modbus-tcp", "--port", "0", "--rate", String(rate)], /127\.0\.0\.1:(\d+)/);
  return { port: Number((await match)[1]), stop: () => end(child, "SIGTERM") };
}

// A session with a web panel and a Modbus panel: { address, panelPort, stop }. `port` 0: any.
export async function session(name, source, { port = 0, linger = 600, words = ["--until-idle", "60"] } = {}) {
  const token = join(folder, "token.txt"), config = join(folder, `${name}.toml`);
  writeFileSync(token, `${kToken}\n`);
  writeFileSync(config, `[panel]\nport = 0\nhttp = "127.0.0.1:${port}"\nhttp_token_file = "token.txt"\nlinger = ${linger}\n`);
  const { child, match } = started(["run", "--config", config, "--design", design(), "--source", source, "--leading-edge", "u:0.4:0.6", "--tolerance", "0.15",
    "--rest-tolerance", "0.5", "--session", name, "--headless", ...words], /panel at 127\.0\.0\.1:(\d+)[^]*web panel at (http:\S+)/);
  const [, panelPort, address] = await match;
  return { address, panelPort: Number(panelPort), stop: (signal = "SIGTERM") => end(child, signal) };
}

export const kSource = (port) => `modbus-tcp://127.0.0.1:${port}`;
