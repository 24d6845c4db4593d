// What a browser shows of live sessions. Needs the built command and Chromium; tests/web/run.sh prepares both.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { openBrowser, openPage, pointsShown, quantile, shoot, waitForPoints } from "./browser.mjs";
import { gridPoints, kSource, kToken, machine, pointsWithDefect, removeFolder, session } from "./session.mjs";

const kDefect = 811;
let browser;
before(async () => { browser = await openBrowser(); });
after(async () => { await browser.close(); removeFolder(); });

const text = (page, id) => page.locator(`#${id}`).innerText();

// Presses a command of the host, as a page with the token does.
async function tellHost(address, command) {
  const answer = await fetch(`${address}api/command`, { method: "POST", body: command, headers: { Authorization: `Bearer ${kToken}` } });
  assert.ok(answer.ok, await answer.text());
}

// What is to be the same after a reload.
const told = async (page) => [await pointsShown(page), ...(await Promise.all(["verdict", "figures", "defects"].map((id) => text(page, id))))];

// Every delay that the page notes from now on [ms].
const noteDelays = (page) => page.evaluate(() => {
  window.delays = [];
  new MutationObserver(() => window.delays.push(Number(document.body.dataset.drawn.split(" ")[1]))).observe(document.body, { attributeFilter: ["data-drawn"] });
});

// When a point was judged out first, by the host's clock [ms since 1970].
async function judgedOut(page, sequence) {
  return page.evaluate(async (wanted) => {
    const begun = await new Promise((done) => {
      const source = new EventSource("/api/events");
      source.addEventListener("hello", (event) => { source.close(); done(JSON.parse(event.data).begun); });
    });
    const { history } = await (await fetch(`/api/history?sequence=${wanted}`)).json();
    return { begun, first: begun + history.at(-1).time_ms };
  }, sequence);
}

test("points appear as they come, and a defect is flagged in under a second", async (t) => {
  const cmm = await machine(pointsWithDefect(kDefect, 6, 0.31), 200);
  t.after(() => cmm.stop());
  const host = await session("live", kSource(cmm.port));
  t.after(() => host.stop());
  // The machine waits for the page: a browser that has just begun takes its time.
  await tellHost(host.address, "stop");
  const { page, seen } = await openPage(browser, host.address);
  t.after(() => page.close());
  await page.evaluate(() => {
    new MutationObserver(() => {
      if (document.querySelector("#defect-list li")) window.flagged ??= Date.now();
    }).observe(document.querySelector("#defect-list"), { childList: true });
  });
  await waitForPoints(page, 1);
  await noteDelays(page);
  const ready = Date.now();
  await tellHost(host.address, "start");
  await page.waitForFunction(() => window.flagged, null, { timeout: 20000 });
  const { first } = await judgedOut(page, kDefect);
  assert.ok(first > ready, `the page came ${ready - first} ms after the defect`);
  await shoot(page, "live");
  const flagged = (await page.evaluate(() => window.flagged)) - first;
  await waitForPoints(page, 1900);
  const delays = await page.evaluate(() => window.delays);
  t.diagnostic(`defect listed ${flagged} ms after its first point was judged`);
  t.diagnostic(`verdict to mark, the oldest of each drawing: median ${quantile(delays, 0.5)} ms, 99 % ${quantile(delays, 0.99)} ms of ${delays.length}`);
  assert.ok(flagged < 1000, `flagged after ${flagged} ms`);
  assert.ok(delays.length > 10 && quantile(delays, 0.5) < 500);

  await shoot(page, "defect");

  const own = new URL(host.address).origin;
  assert.deepEqual(seen.requests.filter((url) => new URL(url).origin !== own), []);
  assert.deepEqual(seen.complaints, []);
});

test("a reload shows the same, a click what a point was judged, a view the other side", async (t) => {
  const host = await session("reload", `replay:${pointsWithDefect(kDefect, 6, 0.31)}`);
  t.after(() => host.stop());
  const { page, seen } = await openPage(browser, host.address);
  t.after(() => page.close());
  await page.waitForFunction(() => document.querySelector("#verdict-why").textContent.includes("ended"), null, { timeout: 20000 });
  await waitForPoints(page, 2000);
  assert.match(await text(page, "verdict"), /OUT OF TOLERANCE/);
  const first = await told(page);
  await page.reload();
  await waitForPoints(page, 2000);
  await page.waitForSelector("#defect-list li");
  assert.deepEqual(await told(page), first);

  await page.locator("#defect-list button").first().click();
  await page.waitForSelector("#point-table tbody tr");
  assert.match(await text(page, "point"), /Point 81\d: leading edge/);
  assert.match(await text(page, "point-table"), /CUT/);
  await page.waitForTimeout(500);
  await shoot(page, "point");
  for (const view of ["Pressure", "Suction", "Edge"]) {
    await page.getByRole("button", { name: view, exact: true }).click();
    await page.waitForTimeout(600);
    await shoot(page, `view-${view.toLowerCase()}`);
  }
  assert.deepEqual(seen.complaints, []);
});

test("a lost host is said at once, and one that comes again is followed", async (t) => {
  const cmm = await machine(pointsWithDefect(kDefect, 6, 0.31), 100);
  t.after(() => cmm.stop());
  const host = await session("again", kSource(cmm.port));
  t.after(() => host.stop());
  const { page } = await openPage(browser, host.address);
  t.after(() => page.close());
  await waitForPoints(page, 100);
  const run = await page.evaluate(() => document.body.dataset.run);
  const port = Number(new URL(host.address).port);
  await host.stop("SIGKILL");
  const killed = Date.now();
  await page.waitForFunction(() => document.querySelector("#trouble").textContent.includes("NO CONNECTION"), null, { timeout: 5000 });
  const said = Date.now() - killed;
  t.diagnostic(`a killed host is said after ${said} ms`);
  assert.ok(said < 2500);
  await shoot(page, "lost");
  const count = await pointsShown(page);
  const again = await session("again", kSource(cmm.port), { port });
  t.after(() => again.stop());
  await page.waitForFunction((old) => document.body.dataset.run !== old && document.querySelector("#trouble").hidden, run, { timeout: 20000 });
  await waitForPoints(page, count + 50);
});

test("a pause keeps the points that are shown, and no more", async (t) => {
  const cmm = await machine(pointsWithDefect(kDefect, 6, 0.31), 100);
  t.after(() => cmm.stop());
  const host = await session("pause", kSource(cmm.port));
  t.after(() => host.stop());
  const { page } = await openPage(browser, host.address);
  t.after(() => page.close());
  await waitForPoints(page, 50);
  const pause = page.getByRole("button", { name: "Pause", exact: true });
  await pause.click();
  const count = await pointsShown(page);
  await page.waitForFunction(() => /[1-9]\d* changes wait/.test(document.querySelector("#flow-note").textContent), null, { timeout: 10000 });
  assert.equal(await pointsShown(page), count);
  await pause.click();
  await waitForPoints(page, count + 20);
  assert.equal(await text(page, "flow-note"), "");
});

test("commands want the token", async (t) => {
  const cmm = await machine(pointsWithDefect(kDefect, 6, 0.31), 50);
  t.after(() => cmm.stop());
  const host = await session("token", kSource(cmm.port));
  t.after(() => host.stop());
  const { page } = await openPage(browser, host.address);
  t.after(() => page.close());
  const press = (name) => page.getByRole("button", { name, exact: true }).click();
  const unlock = async (token) => {
    await press("Unlock commands");
    await page.getByLabel("Token", { exact: true }).fill(token);
    await shoot(page, "unlock");
    await press("Unlock");
  };
  await waitForPoints(page, 20);
  await unlock("not the token of it");
  await page.waitForFunction(() => document.querySelector("#commands").textContent.includes("Refused: this is not the token"));
  await unlock(kToken);
  await press("Stop");
  await page.waitForFunction(() => document.querySelector("#figures").textContent.includes("paused"), null, { timeout: 5000 });
  await shoot(page, "stopped");
  await press("Start");
  await page.waitForFunction(() => !document.querySelector("#figures").textContent.includes("paused"), null, { timeout: 5000 });
  await press("Reset …");
  await shoot(page, "reset");
  await press("Cancel");
});

test("50,000 points stay fluid, and fit every size of screen", async (t) => {
  const host = await session("many", `replay:${gridPoints("500x100")}`);
  t.after(() => host.stop());
  const { page } = await openPage(browser, host.address);
  t.after(() => page.close());
  await waitForPoints(page, 50000, 120000);
  const opened = Date.now();
  await page.reload();
  await waitForPoints(page, 50000, 60000);
  t.diagnostic(`50,000 points are there ${Date.now() - opened} ms after the page was asked for`);
  const box = await page.locator("#canvas").boundingBox();
  await page.evaluate(() => {
    window.frames = [];
    const step = (at) => { window.frames.push(at); requestAnimationFrame(step); };
    requestAnimationFrame(step);
  });
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 320, box.y + 240, { steps: 90 });
  await page.mouse.up();
  const times = await page.evaluate(() => window.frames.slice(1).map((at, k) => at - window.frames[k]));
  t.diagnostic(`frames while turned, drawn by the processor: median ${quantile(times, 0.5).toFixed(1)} ms, 99 % ${quantile(times, 0.99).toFixed(1)} ms of ${times.length}`);
  assert.ok(quantile(times, 0.5) < 250, "turning is not fluid");
  for (const [name, width, height] of [["wide", 1920, 1080], ["desk", 1024, 768], ["tablet", 820, 1180], ["phone", 390, 844]]) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(700);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false, `${name} scrolls sideways`);
    await shoot(page, `size-${name}`, { fullPage: true });
  }
});

test("axe finds nothing serious", async (t) => {
  const host = await session("axe", `replay:${pointsWithDefect(kDefect, 6, 0.31)}`);
  t.after(() => host.stop());
  const { page } = await openPage(browser, host.address);
  t.after(() => page.close());
  await page.waitForSelector("#defect-list li");
  await page.locator("#defect-list button").first().click();
  await page.waitForSelector("#point-table tbody tr");
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  const { violations } = await page.evaluate(`${axe}; axe.run()`);
  const serious = violations.filter((found) => found.impact === "serious" || found.impact === "critical");
  assert.deepEqual(serious.map((found) => `${found.id}: ${found.nodes.map((node) => node.target).join(" ")}`), []);
});
