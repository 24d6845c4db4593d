// How verdicts look: a colour that is told apart by people who see colours differently, and a shape that says the same.
import { actionOf, kAction, kPointState, stateOf } from "./types";

export const kColours = {
  in: "#3f7f6b", cut: "#b83c00", weld: "#0060a8", undecided: "#7a4f9e", pending: "#6b7280", rejected: "#6b7280",
  zone: "#f0c75e", blade: "#ccd6df", ink: "#14232e", selected: "#d0006f",
} as const;

export type Look = "in" | "cut" | "weld" | "undecided" | "pending" | "rejected";

// Within tolerance: from that of a point at its lower limit over 0 to that at its upper one.
export const kWithin = ["#5b9fd4", "#4f8f7c", "#d98a5c"] as const;

export const kSigns: Record<Look, string> = { in: "●", cut: "▲", weld: "▼", undecided: "◆", pending: "○", rejected: "×" };

export const kLookWords: Record<Look, string> = {
  in: "in tolerance", cut: "CUT, too much material", weld: "WELD, too little material", undecided: "undecided, or beyond the edge",
  pending: "waits for the fit", rejected: "left out",
};

export const kShortWords: Record<Look, string> = {
  in: "in", cut: "CUT", weld: "WELD", undecided: "undecided", pending: "waits", rejected: "left out",
};

export const kLooks: Look[] = ["in", "cut", "weld", "undecided", "pending", "rejected"];

export function lookOf(kind: number): Look {
  switch (stateOf(kind)) {
    case kPointState.in: return "in";
    case kPointState.out:
      if (actionOf(kind) === kAction.cut) return "cut";
      return actionOf(kind) === kAction.weld ? "weld" : "undecided";
    case kPointState.pending: return "pending";
    case kPointState.undecided: return "undecided";
    default: return "rejected";
  }
}

// The cells of the leading edge (blade_view.hpp, EdgeCell), in the order of their values.
export const kCellLooks: (Look | null)[] = [null, "in", "cut", "weld", "pending", "undecided", "undecided"];
