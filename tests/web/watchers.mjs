// What a session loses while browsers watch: node watchers.mjs [WATCHERS]. Each watcher reads the events as a page does.
import { get } from "node:http";
import { gridPoints, kSource, machine, removeFolder, session } from "./session.mjs";

const kRate = 1000, kSeconds = 15;
const watchers = Number(process.argv[2] ?? 10);
const state = async (address) => (await fetch(`${address}api/state`)).json();

async function measure(count, round) {
  const cmm = await machine(gridPoints("200x100"), kRate);
  const host = await session(`watched-${round}`, kSource(cmm.port));
  let bytes = 0;
  const open = Array.from({ length: count }, () => get(`${host.address}api/events`, (answer) => answer.on("data", (chunk) => { bytes += chunk.length; })));
  await new Promise((done) => setTimeout(done, 1000 * kSeconds));
  const { counts, fit } = await state(host.address);
  open.forEach((request) => request.destroy());
  await host.stop();
  await cmm.stop();
  return `${count} watchers: ${counts.points} points in ${kSeconds} s, 99 % of pushes within ${fit.push_p99_us.toFixed(1)} us, ${(bytes / 1e6).toFixed(1)} MB sent`;
}

for (const [round, count] of [0, watchers, 0, watchers].entries()) console.log(await measure(count, round));
removeFolder();
