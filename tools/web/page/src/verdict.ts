// What is read from two metres away: the verdict, why, what to do, the worst place; and below it whatever is wrong.
import { byId, make, say } from "./dom";
import { kSigns } from "./looks";
import { kAlarm, kReasonPointsMissing, type State } from "./types";
import { duration, mm, signedMm } from "./words";

const kVerdictSigns: Record<string, string> = { in_tolerance: "✓", out_of_tolerance: "✕", not_decided: "?", not_judged: "–" };

// The worst place of a region; marked where it is beyond its tolerance.
function worstOf(name: string, sequence: number, distance: number | null, tolerance: number | null): HTMLElement {
  const known = sequence > 0 && distance !== null, out = known && tolerance !== null && Math.abs(distance) > tolerance;
  const sign = out ? `${distance > 0 ? kSigns.cut : kSigns.weld} ` : "";
  return make("div", { className: out ? "out" : "" }, [make("dt", { textContent: name }), make("dd", { textContent: known ? sign + signedMm(distance) : "–" })]);
}

function showWorst(state: State): void {
  const list = byId("worst"), { worst, tolerance } = state, text = JSON.stringify([worst, tolerance]);
  if (list.dataset.shown === text) return;
  list.dataset.shown = text;
  list.replaceChildren(worstOf("Worst at the leading edge", worst.edge_sequence, worst.edge, tolerance.edge), worstOf("Worst of the rest", worst.rest_sequence, worst.rest, tolerance.rest));
}

export function showVerdict(state: State): void {
  const header = byId("verdict");
  header.dataset.verdict = state.verdict;
  say(header.querySelector<HTMLElement>(".sign")!, kVerdictSigns[state.verdict] ?? "?");
  const [word, ...why] = state.words.verdict.split(": ");
  say(byId("verdict-word"), word);
  const reasons = why.join(": ");
  say(byId("verdict-why"), [reasons, state.ended ? "the session has ended: this is its result" : ""].filter(Boolean).join("; "));
  say(byId("verdict-advice"), state.words.advice ? `To do: ${state.words.advice}` : "");
  showWorst(state);
  document.title = `${kVerdictSigns[state.verdict] ?? "?"} ${word} · bladefit`;
}

// The reasons to worry, each with what to do.
function troublesOf(state: State): string[] {
  const troubles: string[] = [];
  const has = (alarm: number): boolean => (state.alarms & alarm) !== 0;
  const { words } = state;
  if (state.session === "FAULT") troubles.push("FAULT: see the machine's own screen and the host's messages");
  if (has(kAlarm.linkLost)) troubles.push(`LINK LOST for ${duration(state.link_down_s)}: ${words.source}${words.fault ? `: ${words.fault}` : "; check the cable and the machine"}`);
  if (has(kAlarm.dataGap) || (state.reasons & kReasonPointsMissing) !== 0)
    troubles.push(`POINTS MISSING${state.counts.lost > 0 ? `: ${state.counts.lost}` : ""}; ${words.loss || "probe them again"}`);
  if (has(kAlarm.infeasible)) {
    const least = state.fit.smallest_feasible;
    troubles.push(`NO POSE MEETS THE TOLERANCES${state.fit.support.length > 0 ? `: proven by points ${state.fit.support.join(", ")}` : ""}${least ? `; the least feasible is ${mm(least)}` : ""}`);
  }
  if (has(kAlarm.memoryFull)) troubles.push("MEMORY FULL: older points follow the fit no more; raise capacity in the session file");
  return troubles;
}

// `lost`: for how many seconds there has been no connection; null: there is one.
export function showTrouble(state: State | null, lost: number | null): void {
  const troubles = state ? troublesOf(state) : [];
  if (lost !== null) troubles.unshift(`NO CONNECTION to the host for ${duration(lost)}: what is shown is that old. Trying again; see that the session still runs`);
  const box = byId("trouble");
  box.hidden = troubles.length === 0;
  const lines = troubles.map((text) => make("p", { textContent: text }));
  if (box.textContent !== troubles.join("")) box.replaceChildren(...lines);
  document.body.classList.toggle("stale", lost !== null);
}
