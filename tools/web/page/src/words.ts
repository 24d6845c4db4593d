// Numbers as they are read.

export function mm(value: number | null | undefined, digits = 3): string {
  return value === null || value === undefined || !Number.isFinite(value) ? "–" : `${value.toFixed(digits)} mm`;
}

export function signedMm(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(digits)} mm`;
}

export const count = (value: number): string => value.toLocaleString("en-US").replaceAll(",", "\u2009");

export function duration(seconds: number): string {
  const whole = Math.floor(seconds);
  if (whole < 60) return `${whole} s`;
  const minutes = Math.floor(whole / 60);
  return minutes < 60 ? `${minutes} min ${String(whole % 60).padStart(2, "0")} s` : `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
}

export const machine = (place: (number | null)[]): string => place.map((part) => (part === null ? "–" : part.toFixed(1))).join(", ");

export const clock = (time: Date): string => time.toLocaleTimeString("en-GB");
