// What a point was judged, from its first verdict to the present one.
import { byId, fillTable, say } from "./dom";
import { kColours, kShortWords, kSigns, lookOf } from "./looks";
import type { Store } from "./store";
import { isEdge, type PastVerdict } from "./types";
import { clock, mm, signedMm } from "./words";

export class History {
  private sequence = 0;
  private change = "";

  constructor(private readonly store: Store, private readonly begun: () => number) {}

  // Of the point in a slot; -1: of none.
  async show(slot: number): Promise<void> {
    byId("point").hidden = slot < 0;
    if (slot < 0) { this.sequence = 0; return; }
    const sequence = this.store.sequence[slot], change = `${sequence} ${this.store.time[slot]}`;
    if (change === this.change && this.sequence === sequence) return;
    [this.sequence, this.change] = [sequence, change];
    const { ratio, kind } = this.store;
    say(byId("point-title"), `Point ${sequence}: ${isEdge(kind[slot]) ? "leading edge" : "rest"}, r/R ${ratio[slot].toFixed(3)}`);
    const answer = await fetch(`/api/history?sequence=${sequence}`).catch(() => null);
    if (!answer?.ok || this.sequence !== sequence) return;
    const { history } = (await answer.json()) as { history: PastVerdict[] };
    this.fill(history);
  }

  private fill(history: PastVerdict[]): void {
    const rows = history.map((verdict) => {
      const look = lookOf(verdict.kind), word = document.createElement("span");
      word.textContent = `${kSigns[look]} ${kShortWords[look]}`;
      word.style.color = kColours[look];
      return [clock(new Date(this.begun() + verdict.time_ms)), word, signedMm(verdict.distance), mm(verdict.uncertainty), `${verdict.revision}`];
    });
    fillTable(byId<HTMLTableElement>("point-table"), ["Time", "Verdict", "Distance", "± of pose", "Fit"], rows);
  }
}
