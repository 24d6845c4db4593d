// Counts, tolerances, fit and link.
import { byId, make } from "./dom";
import type { State } from "./types";
import { count, duration, machine, mm } from "./words";

const kFitWords = (state: State): string => {
  const { fit } = state;
  return `${fit.status}${fit.fully ? "" : `, ${fit.determined} directions known`}${fit.improving ? ", improving" : ""}`;
};

function linkOf(state: State): string {
  if (state.link_down_s > 0 || state.alarms & 4) return `lost for ${duration(state.link_down_s)}`;
  if (state.ended) return "session ended";
  if (state.session === "idle") return "paused: no points are taken";
  return state.session === "connecting" ? "connecting" : "connected";
}

function nextOf(state: State): string | null {
  const { next } = state.blade;
  if (!next) return null;
  const why = ["", "the fit needs it", "leading edge not probed there", "not probed there"][next.reason] ?? "";
  return `r/R ${next.ratio.toFixed(2)}${next.side ? `, ${next.side}` : ""} (${why}); machine x, y, z ${machine(next.machine)}`;
}

type Figure = [name: string, value: string, wide?: boolean];

function figuresOf(state: State): Figure[] {
  const { counts, fit, tolerance } = state;
  const figures: Figure[] = [
    ["Points", counts.planned > 0 ? `${count(counts.points)} of ${count(counts.planned)}` : count(counts.points)],
    ["Leading edge out", `${count(counts.edge_out)} of ${count(counts.edge)}`],
    ["Rest out", count(counts.rest_out)],
    ["Left out", count(counts.rejected)],
    ["Tolerance edge", tolerance.edge === null ? "not judged" : mm(tolerance.edge)],
    ["Tolerance rest", tolerance.rest === null ? "not judged" : mm(tolerance.rest)],
    ["Smallest feasible", fit.smallest_feasible ? mm(fit.smallest_feasible) : "not sought"],
    ["RMS", mm(fit.rms)],
    ["RMS edge", mm(fit.edge_rms)],
    ["Fit", kFitWords(state)],
    ["Link", linkOf(state)],
    ["Machine", state.words.source, true],
  ];
  const next = nextOf(state);
  if (next) figures.push(["Probe next", next, true]);
  return figures;
}

// Elements that are there already get their new text alone.
export function showFigures(state: State, session: string): void {
  const box = byId("figures"), figures = [...figuresOf(state), ["Session", session, true] as Figure];
  if (box.childElementCount !== figures.length)
    box.replaceChildren(...figures.map(() => make("div", {}, [make("span", { className: "name" }), make("span", { className: "value" })])));
  figures.forEach(([name, value, wide], k) => {
    const [first, second] = box.children[k].children as unknown as HTMLElement[];
    box.children[k].classList.toggle("wide", wide === true);
    if (first.textContent !== name) first.textContent = name;
    if (second.textContent !== value) second.textContent = value;
  });
}
