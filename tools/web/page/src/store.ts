// The points as they are now, each in the slot that the host gave it: arrays that go to the graphics card as they are.
import type { Design, Piece } from "./types";
import { isEdge } from "./types";

const kColumns = 13;
const kFirstRoom = 4096;

// Slots that changed since the marks were drawn last.
export interface Range { first: number; end: number }

export class Store {
  count = 0; // slots in use
  sequence = new Uint32Array(kFirstRoom);
  place = new Float32Array(3 * kFirstRoom); // about the middle of the design
  normal = new Float32Array(3 * kFirstRoom);
  distance = new Float32Array(kFirstRoom);
  tolerance = new Float32Array(kFirstRoom); // 0 = none
  kind = new Uint8Array(kFirstRoom);
  ratio = new Float32Array(kFirstRoom); // r/R
  revision = new Uint32Array(kFirstRoom);
  time = new Float64Array(kFirstRoom); // [ms] since the host's feed began
  newest = -1; // slot
  version = 0; // +1 with every piece
  private readonly slots = new Map<number, number>();
  private dirty: Range = { first: 0, end: 0 };

  constructor(private design: Design) {}

  get room(): number { return this.kind.length; }

  clear(design: Design): void {
    this.design = design;
    this.count = 0;
    this.newest = -1;
    this.slots.clear();
    ++this.version;
    this.dirty = { first: 0, end: 0 };
  }

  slotOf(sequence: number): number { return this.slots.get(sequence) ?? -1; }

  // What changed since it was asked last.
  takeDirty(): Range {
    const range = this.dirty;
    this.dirty = { first: 0, end: 0 };
    return range;
  }

  // Returns the time of the oldest verdict in it [ms].
  add(piece: Piece): number {
    let oldest = Infinity;
    ++this.version;
    for (let at = 0; at + kColumns <= piece.rows.length; at += kColumns) {
      this.addRow(piece.rows, at);
      oldest = Math.min(oldest, piece.rows[at + 12]);
    }
    return oldest;
  }

  private addRow(rows: number[], at: number): void {
    const slot = rows[at];
    if (slot >= this.room) this.grow(slot + 1);
    if (slot < this.count) this.slots.delete(this.sequence[slot]);
    this.count = Math.max(this.count, slot + 1);
    const sequence = rows[at + 1];
    this.sequence[slot] = sequence;
    this.slots.set(sequence, slot);
    for (let k = 0; k < 3; ++k) {
      this.place[3 * slot + k] = rows[at + 2 + k] - this.design.middle[k];
      this.normal[3 * slot + k] = rows[at + 5 + k];
    }
    this.distance[slot] = rows[at + 8];
    this.tolerance[slot] = rows[at + 9];
    this.kind[slot] = rows[at + 10];
    this.revision[slot] = rows[at + 11];
    this.time[slot] = rows[at + 12];
    this.ratio[slot] = this.radiusOf(rows, at + 2) / this.design.tip;
    if (this.newest < 0 || sequence >= this.sequence[this.newest]) this.newest = slot;
    const none = this.dirty.end === this.dirty.first;
    this.dirty = { first: none ? slot : Math.min(this.dirty.first, slot), end: none ? slot + 1 : Math.max(this.dirty.end, slot + 1) };
  }

  private radiusOf(rows: number[], at: number): number {
    const { point, direction } = this.design.axis;
    const arm = [0, 1, 2].map((k) => rows[at + k] - point[k]);
    const along = arm[0] * direction[0] + arm[1] * direction[1] + arm[2] * direction[2];
    return Math.hypot(...arm.map((part, k) => part - along * direction[k]));
  }

  private grow(least: number): void {
    let room = this.room;
    while (room < least) room *= 2;
    const grown = <T extends Float32Array | Float64Array | Uint32Array | Uint8Array>(old: T, size: number): T => {
      const made = new (old.constructor as new (length: number) => T)(size);
      made.set(old);
      return made;
    };
    for (const name of ["sequence", "distance", "tolerance", "kind", "ratio", "revision", "time"] as const)
      (this[name] as Float32Array) = grown(this[name] as Float32Array, room);
    this.place = grown(this.place, 3 * room);
    this.normal = grown(this.normal, 3 * room);
  }

  // Slots of the leading edge.
  *edge(): Generator<number> {
    for (let slot = 0; slot < this.count; ++slot) if (isEdge(this.kind[slot])) yield slot;
  }
}
