// The picture of the README: a session with three defects, as the page shows it.
import { openBrowser, openPage, waitForPoints } from "./browser.mjs";
import { join } from "node:path";
import { kRoot, kSource, machine, pointsWithDefects, removeFolder, session } from "./session.mjs";

const browser = await openBrowser();
const points = pointsWithDefects([[811, 6, 0.31], [1312, 4, -0.27], [1688, 2, 0.24]]);
const cmm = await machine(points, 400);
const host = await session("monday", kSource(cmm.port), { words: ["--until-idle", "3"] });
const { page } = await openPage(browser, host.address, { width: 1280, height: 800 });
await waitForPoints(page, 2000, 60000);
await page.waitForSelector("#defect-list li:nth-child(3)");
await page.waitForTimeout(1000);
await page.screenshot({ path: join(kRoot, "tools/web/panel.png") });
await browser.close();
await host.stop();
await cmm.stop();
removeFolder();
