// The events of the host, and whether they still come.
import type { Piece, State } from "./types";

const kSilence_ms = 2500; // the host says something every second
const kRetry_ms = 700;

export interface Listener {
  hello(run: string, begun: number): void;
  state(state: State): void;
  points(piece: Piece): void;
  // `since`: when it was lost; null: it is there.
  connection(since: number | null): void;
}

export class Stream {
  private source: EventSource | null = null;
  private last = "";
  private heard = performance.now();
  private lostSince: number | null = null;

  constructor(private readonly listener: Listener) {
    this.open();
    setInterval(() => this.look(), 250);
  }

  private open(): void {
    this.source?.close();
    this.heard = performance.now();
    const source = new EventSource(`/api/events?from=${encodeURIComponent(this.last)}`);
    this.source = source;
    const on = (name: string, take: (data: never) => void): void =>
      source.addEventListener(name, (event) => {
        this.hear();
        take(JSON.parse((event as MessageEvent<string>).data) as never);
        this.last = (event as MessageEvent<string>).lastEventId || this.last;
      });
    on("hello", (data: { run: string; begun: number }) => this.listener.hello(data.run, data.begun));
    on("state", (data: State) => this.listener.state(data));
    on("points", (data: Piece) => this.listener.points(data));
    source.onerror = () => {
      this.lose();
      source.close();
      setTimeout(() => { if (this.source === source) this.open(); }, kRetry_ms);
    };
  }

  private hear(): void {
    this.heard = performance.now();
    if (this.lostSince === null) return;
    this.lostSince = null;
    this.listener.connection(null);
  }

  private lose(): void {
    this.lostSince ??= Date.now();
    this.listener.connection(this.lostSince);
  }

  private look(): void {
    if (this.lostSince !== null) return this.listener.connection(this.lostSince);
    if (performance.now() - this.heard < kSilence_ms) return;
    this.lose();
    this.open();
  }
}
