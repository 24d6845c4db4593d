// Debian's Chromium, and pages of it that note every request and every complaint.
import { chromium } from "playwright-core";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { kRoot } from "./session.mjs";

export const kShots = process.env.BLADEFIT_SHOTS ?? join(kRoot, "build/web-shots");
mkdirSync(kShots, { recursive: true });

export const openBrowser = () => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  // No graphics card is needed: the drawing is done by the processor.
  args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", ...(process.getuid() === 0 ? ["--no-sandbox"] : [])],
});

export async function openPage(browser, address, viewport = { width: 1280, height: 800 }) {
  const page = await browser.newPage({ viewport });
  const seen = { requests: [], complaints: [] };
  page.on("request", (request) => seen.requests.push(request.url()));
  page.on("console", (message) => { if (message.type() === "error" || message.type() === "warning") seen.complaints.push(message.text()); });
  page.on("pageerror", (error) => seen.complaints.push(error.message));
  await page.goto(address);
  return { page, seen };
}

export const shoot = (page, name, rest = {}) => page.screenshot({ path: join(kShots, `${name}.png`), ...rest });

export const pointsShown = (page) => page.evaluate(() => Number(document.body.dataset.points ?? 0));
export const waitForPoints = (page, least, timeout = 20000) =>
  page.waitForFunction((count) => Number(document.body.dataset.points ?? 0) >= count, least, { timeout });

export function quantile(numbers, share) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}
