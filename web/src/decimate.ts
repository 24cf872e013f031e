/** Columns cut to what a plot can show: the window in sight, and of each pixel column its least and greatest value. */

import { Column, indexAt } from "./data";

export interface Points { t: number[]; v: (number | null)[] }

/**
 * The samples in [low, high] and one on either side; of more than `4 * pixels` only the extremes of each pixel column,
 * in their order in time, so that no spike is lost. NaN becomes null, a gap.
 */
export function windowed(times: Column, values: Column, low: number, high: number, pixels: number): Points {
  const count = Math.min(times.length, values.length);
  const first = Math.max(0, indexAt(times, low));
  const last = Math.min(count - 1, indexAt(times, high) + 1);
  const t = times.view(), v = values.view();
  const out: Points = { t: [], v: [] };
  const put = (i: number) => {
    out.t.push(t[i]);
    out.v.push(Number.isNaN(v[i]) ? null : v[i]);
  };
  if (last < first) return out;
  if (last - first <= 4 * pixels) {
    for (let i = first; i <= last; i++) put(i);
    return out;
  }
  const scale = pixels / (high - low);
  let i = first;
  while (i <= last) {
    const column = Math.floor((t[i] - low) * scale);
    let least = -1, most = -1, gap = -1, end = i;
    for (; end <= last && Math.floor((t[end] - low) * scale) === column; end++) {
      if (Number.isNaN(v[end])) gap = end;
      else {
        if (least < 0 || v[end] < v[least]) least = end;
        if (most < 0 || v[end] > v[most]) most = end;
      }
    }
    for (const index of [...new Set([least, most, gap])].filter((k) => k >= 0).sort((a, b) => a - b)) put(index);
    i = end;
  }
  return out;
}

export type Aligned = [number[], ...(number | null | undefined)[][]];

/** Several series on one axis of times, as uPlot wants them; undefined where a series has no sample. */
export function align(series: Points[]): Aligned {
  if (!series.length) return [[]] as unknown as Aligned;
  if (series.length === 1) return [series[0].t, series[0].v];
  const same = series.every((s) => s.t.length === series[0].t.length && s.t.every((value, k) => value === series[0].t[k]));
  if (same) return [series[0].t, ...series.map((s) => s.v)];
  const times: number[] = [];
  const columns: (number | null | undefined)[][] = series.map(() => []);
  const next = series.map(() => 0);
  for (;;) {
    let t = Infinity;
    series.forEach((s, k) => {
      if (next[k] < s.t.length && s.t[next[k]] < t) t = s.t[next[k]];
    });
    if (t === Infinity) break;
    times.push(t);
    series.forEach((s, k) => {
      if (next[k] < s.t.length && s.t[next[k]] === t) columns[k].push(s.v[next[k]++]);
      else columns[k].push(undefined);
    });
  }
  return [times, ...columns];
}
