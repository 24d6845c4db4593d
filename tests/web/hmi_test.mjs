// What the HMIs of config/hmi show of live sessions, beside what the session writes: Node-RED and FUXA as npm has them, in
// Chromium. Needs the built command; tests/web/run.sh hmi prepares the rest.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, shoot } from "./browser.mjs";
import { folder, kRoot, kSource, machine, pointsWithDefect, removeFolder, session } from "./session.mjs";

const kPackages = join(kRoot, "build/web-tests/hmi/node_modules");
const kStart = 120000, kWait = 30000;  // [ms]
let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser.close(); removeFolder(); });

const freePort = () => new Promise((done) => {
  const server = createServer().listen(0, "127.0.0.1", () => {
    const { port } = server.address();
    server.close(() => done(port));
  });
});

// A program of Node that says a line when it is ready: { stop }.
function program(words, ready) {
  const child = spawn(process.execPath, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  return new Promise((done, failed) => {
    const late = setTimeout(() => failed(new Error(`${words[0]} is not ready: ${said}`)), kStart);
    const hear = (chunk) => {
      said += chunk;
      if (!ready.test(said)) return;
      clearTimeout(late);
      done({ stop: () => new Promise((gone) => { child.on("exit", gone); child.kill("SIGKILL"); }) });
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", (code) => failed(new Error(`${words[0]} ended with ${code}: ${said}`)));
  });
}

// The project of config/hmi, for a panel at another port.
function project(name, panelPort) {
  const text = readFileSync(join(kRoot, "config/hmi", name), "utf8");
  assert.match(text, /1503/);
  return text.replaceAll("1503", String(panelPort));
}

async function nodeRed(panelPort) {
  const home = join(folder, "node-red-home"), port = await freePort();
  mkdirSync(home, { recursive: true });
  writeFileSync(join(home, "flows.json"), project("node_red_flow.json", panelPort));
  writeFileSync(join(home, "package.json"), readFileSync(join(kPackages, "../package.json")));
  symlinkSync(kPackages, join(home, "node_modules"));
  const server = await program([join(kPackages, "node-red/red.js"), "-u", home, "-p", String(port), "flows.json"], /Started flows/);
  return { ...server, address: `http://127.0.0.1:${port}/dashboard/bladefit` };
}

async function fuxa(panelPort) {
  const home = join(folder, "fuxa-home"), port = await freePort(), address = `http://127.0.0.1:${port}`;
  mkdirSync(home, { recursive: true });
  const server = await program([join(kPackages, "@frangoteam/fuxa/main.js"), "--userDir", home, "--port", String(port)], /WebServer is running/);
  const taken = await fetch(`${address}/api/project`, { method: "POST", headers: { "Content-Type": "application/json" }, body: project("fuxa_project.json", panelPort) });
  assert.equal(taken.status, 200);
  return { ...server, address: `${address}/home` };
}

// The value that stands in the line after a label.
const shown = (page, label) => page.evaluate((wanted) => {
  const lines = document.body.innerText.split("\n").map((line) => line.trim()).filter(Boolean);
  return lines[lines.indexOf(wanted) + 1];
}, label);

async function waitFor(what, holds) {
  for (const end = Date.now() + kWait; Date.now() < end; await new Promise((done) => setTimeout(done, 200))) {
    if (await holds()) return;
  }
  assert.fail(`in ${kWait / 1000} s: ${what}`);
}

// A session over a blade with a defect, and a page of an HMI that shows points of it: { host, page, result }.
async function watched(t, name, start) {
  const cmm = await machine(pointsWithDefect(811, 6, 0.31), 100);
  t.after(() => cmm.stop());
  const host = await session(name, kSource(cmm.port), { words: ["--until-idle", "5"] });
  t.after(() => host.stop());
  const hmi = await start(host.panelPort);
  t.after(() => hmi.stop());
  const page = await browser.newPage({ viewport: { width: 1024, height: 768 } });
  t.after(() => page.close());
  await page.goto(hmi.address);
  await waitFor("points come in", async () => { const points = Number(await shown(page, "Points")); return points > 0 && points < 2000; });
  await shoot(page, `${name}-live`);
  return { host, page, result: () => JSON.parse(readFileSync(join(folder, name, "result.json"), "utf8")) };
}

// What the page must show of a result.
function expected(result) {
  const edge = result.points.filter((point) => point.region === "leading_edge");
  const out = (points) => points.filter((point) => point.state === "out").length;
  const worst = edge.reduce((most, point) => (Math.abs(point.distance) > Math.abs(most.distance) ? point : most));
  assert.ok(out(edge) > 0);
  return { verdict: result.verdict.state, points: result.points.length, edgeOut: out(edge), restOut: out(result.points) - out(edge), worst };
}

test("Node-RED shows a live session, its result, and that its host is gone", async (t) => {
  const { host, page, result } = await watched(t, "node-red", nodeRed);
  await waitFor("the end is told", async () => /ended/.test(await shown(page, "Session")));
  const end = expected(result());
  assert.equal(await shown(page, "Verdict"), end.verdict.replaceAll("_", " ").toUpperCase());
  assert.equal(Number(await shown(page, "Points")), end.points);
  assert.equal(await shown(page, "Out of tolerance"), `${end.edgeOut} leading edge, ${end.restOut} rest`);
  const place = await shown(page, "Worst place");
  assert.ok(place.includes(`${end.worst.distance > 0 ? "+" : "-"}${Math.abs(end.worst.distance).toFixed(3)} mm`), place);
  await shoot(page, "node-red-ended");
  await host.stop("SIGKILL");
  await waitFor("numbers are called old", async () => /old/.test(await page.evaluate(() => document.body.innerText)));
  await shoot(page, "node-red-lost");
});

test("FUXA shows a live session and its result", async (t) => {
  const { page, result } = await watched(t, "fuxa", fuxa);
  assert.equal(await shown(page, "Test: 12345.678"), "12345.678");
  await waitFor("the end is told", async () => (await shown(page, "Ended: 1")) === "1");
  const end = expected(result());
  const values = async () => [await shown(page, "Verdict"), await shown(page, "Points"), await shown(page, "Leading edge out"), await shown(page, "Rest of blade out"),
    await shown(page, "Worst at the edge, mm")].map(Number);
  const wanted = [["not_judged", "in_tolerance", "out_of_tolerance", "not_decided"].indexOf(end.verdict), end.points, end.edgeOut, end.restOut,
    Number(end.worst.distance.toFixed(3))];
  await waitFor(`the page shows ${wanted}`, async () => (await values()).join() === wanted.join());
  await shoot(page, "fuxa-ended");
});
