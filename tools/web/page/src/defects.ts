// One row a defect, the worst first; a click goes there.
import { byId, fillTable, make, say } from "./dom";
import { kColours, kSigns } from "./looks";
import type { Defect, State } from "./types";
import { machine, signedMm } from "./words";

let shown = "";

function actionCell(defect: Defect): HTMLElement {
  const look = defect.distance >= 0 ? "cut" : "weld";
  const cell = make("span", { textContent: `${kSigns[look]} ${defect.action.toUpperCase()}` });
  cell.style.color = kColours[look];
  return cell;
}

const ratios = (defect: Defect): string =>
  defect.from.toFixed(3) === defect.to.toFixed(3) ? defect.from.toFixed(3) : `${defect.from.toFixed(3)}–${defect.to.toFixed(3)}`;

function goButton(defect: Defect, go: (sequence: number) => void): HTMLElement {
  const button = make("button", { type: "button", textContent: ratios(defect), title: `Show point ${defect.sequence}` });
  button.addEventListener("click", () => go(defect.sequence));
  return button;
}

export function showDefects(state: State, go: (sequence: number) => void): void {
  const { defects, defect_count: inAll } = state.blade;
  const text = JSON.stringify(defects);
  if (text === shown) return;
  shown = text;
  say(byId("defects-note"), inAll === 0 ? "none" : inAll > defects.length ? `the worst ${defects.length} of ${inAll}` : `${inAll}`);
  byId("defects").classList.toggle("none", defects.length === 0);
  const rows = defects.map((defect) => [
    goButton(defect, go), actionCell(defect), signedMm(defect.distance, 2), `${defect.length.toFixed(0)} mm`,
    defect.side || defect.region, `${defect.points}`, machine(defect.machine)]);
  fillTable(byId<HTMLTableElement>("defect-table"), ["r/R", "Do", "Depth", "Length", "Side", "Points", "Machine x, y, z"], rows);
}
