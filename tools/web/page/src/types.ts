// What the server sends; the keys are those of tools/web/state_json.cpp, feed_json.cpp and design_json.cpp.

export type Numbers = (number | null)[];

export interface Defect {
  sequence: number; from: number; to: number; length: number; distance: number; side: string; action: string; region: string;
  points: number; machine: Numbers;
}

export interface State {
  session: string; ended: boolean; verdict: string; reasons: number; alarms: number; heartbeat: number; link_down_s: number;
  words: { verdict: string; worst: string; advice: string; source: string; fault: string; loss: string; alarms: string };
  worst: { edge: number | null; edge_sequence: number; rest: number | null; rest_sequence: number };
  tolerance: { edge: number | null; rest: number | null };
  counts: { points: number; planned: number; edge: number; edge_out: number; rest_out: number; rejected: number; lost: number; last: number };
  fit: { status: string; determined: number; fully: boolean; rms: number | null; edge_rms: number | null; pose: Numbers;
    smallest_feasible: number | null; improving: boolean; support: number[]; push_p99_us: number | null };
  blade: { edge: number[]; edge_root: number; edge_tip: number; tip: number; defect_count: number; defects: Defect[];
    next: { reason: number; side: string; ratio: number; machine: Numbers } | null };
  commands: boolean;
}

export interface Grid { rows: number; columns: number; places: string; normals: string; inside: string }

export type Triple = [number, number, number];

export interface Design {
  name: string; middle: Triple; half_diagonal: number; axis: { point: Triple; direction: Triple }; tip: number; faces: Grid[]; zones: Grid[];
  edge_limits: EdgeLimits[];
}

// What is allowed at the leading edge between two r/R [mm]; null: not judged on that side.
export interface EdgeLimits { from: number; to: number; plus: number | null; minus: number | null }

export interface Piece { afresh: boolean; more: boolean; rows: number[] }

export interface PastVerdict {
  time_ms: number; distance: number; tolerance: number; uncertainty: number; revision: number; kind: number;
}

// Bits of State.alarms and State.reasons that the page itself reacts to (panel_map.hpp).
export const kAlarm = { edgeOut: 1, restOut: 2, linkLost: 4, dataGap: 8, memoryFull: 16, infeasible: 32 } as const;
export const kReasonPointsMissing = 8;

// A point's kind: state + 8 action + 32 region.
export const stateOf = (kind: number): number => kind & 7;
export const actionOf = (kind: number): number => (kind >> 3) & 3;
export const isEdge = (kind: number): boolean => kind >= 32;
export const kPointState = { pending: 0, in: 1, out: 2, rejected: 3, undecided: 4 } as const;
export const kAction = { none: 0, cut: 1, weld: 2 } as const;
