// One row a defect, the worst first; a click goes there.
import { byId, make, say } from "./dom";
import { kColours, kSigns } from "./looks";
import type { Defect, State } from "./types";
import { machine, mm } from "./words";

let shown = "";

const placeOf = (defect: Defect): string => {
  const [from, to] = [defect.from.toFixed(3), defect.to.toFixed(3)];
  return `r/R ${from === to ? from : `${from} to ${to}`}`;
};

function rowOf(defect: Defect, go: (sequence: number) => void): HTMLElement {
  const look = defect.distance >= 0 ? "cut" : "weld", action = defect.action === "none" ? "beyond the edge" : defect.action.toUpperCase();
  const what = make("strong", { textContent: `${kSigns[look]} ${action} ${mm(Math.abs(defect.distance))}` });
  what.style.color = kColours[look];
  const points = `${defect.points} point${defect.points === 1 ? "" : "s"}`;
  const rest = [defect.side || defect.region, points, ...(defect.points > 1 ? [`${defect.length.toFixed(1)} mm long`] : [])];
  const button = make("button", { type: "button", title: `Show point ${defect.sequence}` }, [
    make("span", { className: "line" }, [what, make("span", { textContent: placeOf(defect) })]),
    make("span", { className: "line small" }, [make("span", { textContent: rest.join(", ") }), make("span", { textContent: `x, y, z ${machine(defect.machine)}` })])]);
  button.addEventListener("click", () => go(defect.sequence));
  return make("li", {}, [button]);
}

export function showDefects(state: State, go: (sequence: number) => void): void {
  const { defects, defect_count: inAll } = state.blade;
  const text = JSON.stringify(defects);
  if (text === shown) return;
  shown = text;
  const note = inAll === 0 ? "none" : inAll > defects.length ? `the worst ${defects.length} of ${inAll}` : `${inAll}, the worst first`;
  say(byId("defects-note"), note);
  byId("defects").classList.toggle("none", defects.length === 0);
  byId("defect-list").replaceChildren(...defects.map((defect) => rowOf(defect, go)));
}
