/** Values to colours, even in lightness on light ground and on dark: blue, teal, amber, red. */

const STOPS: [number, number, number][] = [[46, 110, 230], [22, 168, 178], [110, 190, 80], [240, 180, 40], [235, 105, 40], [214, 40, 57]];

/** sRGB 0..1 of a share 0..1. */
export function ramp(share: number): [number, number, number] {
  const place = Math.max(0, Math.min(1, share)) * (STOPS.length - 1);
  const i = Math.min(STOPS.length - 2, Math.floor(place)), f = place - i;
  return [0, 1, 2].map((k) => (STOPS[i][k] + f * (STOPS[i + 1][k] - STOPS[i][k])) / 255) as [number, number, number];
}

export const RAMP_CSS = `linear-gradient(90deg, ${STOPS.map((s) => `rgb(${s.join(",")})`).join(",")})`;

/** A round number at or above. */
export function roundUp(value: number): number {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((m) => m * power >= value * (1 - 1e-9)) ?? 10);
}
