/** Numbers and times as people read them. */

/** About four significant digits, never an exponent where a person would not write one. */
export function number(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) return value.toExponential(2).replace("-", "−");
  const places = Number.isInteger(value) ? 0 : Math.max(0, Math.min(6, digits - 1 - Math.floor(Math.log10(size))));
  return value.toLocaleString("en", { maximumFractionDigits: places, useGrouping: size >= 1e5 }).replace("-", "−");
}

/** With a fixed number of places, so that a readout does not jump. */
export function fixed(value: number, places: number): string {
  return Number.isFinite(value) ? value.toFixed(places).replace("-", "−") : "–";
}

/** 75.25 s is 1:15.25. */
export function clock(seconds: number, places = 2): string {
  if (!Number.isFinite(seconds)) return "–";
  const sign = seconds < 0 ? "−" : "";
  const rounded = Math.abs(seconds).toFixed(places);
  const minutes = Math.floor(Number(rounded) / 60);
  const rest = (Number(rounded) - 60 * minutes).toFixed(places);
  return `${sign}${minutes}:${rest.padStart(places ? places + 3 : 2, "0")}`;
}

export function cell(value: unknown): string {
  if (typeof value === "number") return number(value, 6);
  if (value === true) return "yes";
  if (value === false) return "no";
  return value === null || value === undefined ? "–" : String(value);
}
