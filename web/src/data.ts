/** The contract with `logs/report/contract.py`, version 1, and its columns unpacked. */

export type ArrayJson = (number | null)[] | { f32: string } | { u: number; t0: number; dt: number } | { column: number };
export type Point = [number, number, number]; // north, east, up [m]

export interface CheckJson { name: string; value: number | string | null; expected: number | string | null; ok: boolean | null }
export interface HeaderJson {
  title: string; ok: boolean | null; phase: string; failure: string; start_utc: string | null; duration_s: number;
  checks: CheckJson[]; facts: [string, string | number][]; loss: [string, number][];
}
export interface TrackJson {
  t: ArrayJson; n: ArrayJson; e: ArrayJson; u: ArrayJson;
  roll?: ArrayJson; pitch?: ArrayJson; yaw?: ArrayJson; error?: ArrayJson;
}
export type ObstacleJson = { label?: string } & (
  | { kind: "box"; low: Point; high: Point }
  | { kind: "cylinder"; base: Point; radius: number; height: number }
  | { kind: "sphere"; centre: Point; radius: number }
  | { kind: "prism"; polygon: [number, number][]; low: number; high: number }
  | { kind: "cells"; size: number; at: ArrayJson });
export interface PlanJson { t: number; points: ArrayJson; kind: string }
export interface MoverJson extends TrackJson { id: string; radius: number }
export interface SceneJson {
  obstacles: ObstacleJson[]; bounds: [Point, Point] | null; fence: [number, number][] | null;
  path: TrackJson; truth: TrackJson | null; reference: TrackJson | null;
  plans: PlanJson[]; movers: MoverJson[]; least: { t: number; at: Point; clearance: number } | null;
}
export interface SeriesJson { label: string; t: ArrayJson; v: ArrayJson; style?: string }
export interface PlotJson {
  id: string; section: string; title: string; unit: string; series: SeriesJson[];
  bounds?: { label: string; value: number }[]; note?: string;
}
export interface HistogramJson {
  id: string; section: string; title: string; unit: string; edges: number[]; counts: number[];
  marks?: { label: string; value: number }[]; note?: string;
}
export interface EventJson { t: number; kind: string; level: number; text: string }
export interface TableJson { section: string; title: string; columns: string[]; rows: unknown[][] }
export interface DataJson {
  version: number; header: HeaderJson; frame: string; scene: SceneJson; plots: PlotJson[]; histograms: HistogramJson[];
  events: EventJson[]; tables: TableJson[];
  /** In a file: what `column` counts, float32 sorted by byte. */
  columns?: { f32p: string }[];
}

/** A column that grows: live pages append to it. Reads go through `view()`. */
export class Column {
  private values: Float64Array | Float32Array;
  length: number;

  constructor(values: Float64Array | Float32Array = new Float64Array(0)) {
    this.values = values;
    this.length = values.length;
  }

  view(): Float64Array | Float32Array {
    return this.values.length === this.length ? this.values : this.values.subarray(0, this.length);
  }

  push(more: ArrayLike<number | null>): void {
    const needed = this.length + more.length;
    if (needed > this.values.length) {
      const grown = new Float64Array(Math.max(256, 2 * needed));
      grown.set(this.view());
      this.values = grown;
    }
    for (let i = 0; i < more.length; i++) this.values[this.length + i] = more[i] ?? NaN;
    this.length = needed;
  }

  /** Forget the oldest. */
  drop(count: number): void {
    this.values.copyWithin(0, count, this.length);
    this.length -= count;
  }

  at(index: number): number {
    return index < 0 || index >= this.length ? NaN : this.values[index];
  }
}

export function decode(array: ArrayJson | undefined | null): Column {
  if (!array) return new Column();
  if (Array.isArray(array)) return new Column(Float64Array.from(array, (v) => v ?? NaN));
  if ("f32" in array) return new Column(new Float32Array(bytes(array.f32).buffer));
  if ("column" in array) return new Column(shared(array.column));
  return new Column(Float64Array.from({ length: array.u }, (_, i) => array.t0 + i * array.dt));
}

let columns: { f32p: string }[] = [];
const unpacked = new Map<number, Float32Array>();

/** A column that several may share; unpacked when first wanted. */
function shared(index: number): Float32Array {
  let values = unpacked.get(index);
  if (!values) {
    const planes = bytes(columns[index].f32p), count = planes.length / 4;
    const sorted = new Uint8Array(planes.length);
    for (let plane = 0; plane < 4; plane++) for (let i = 0, from = plane * count; i < count; i++) sorted[4 * i + plane] = planes[from + i];
    unpacked.set(index, (values = new Float32Array(sorted.buffer)));
    columns[index].f32p = "";
  }
  return values;
}

/** Base64 to bytes; the browser's own decoder where it has one. */
export function bytes(base64: string): Uint8Array<ArrayBuffer> {
  const quick = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> }).fromBase64;
  if (quick) return quick.call(Uint8Array, base64);
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) out[i] = text.charCodeAt(i);
  return out;
}

/** What lies in the page: base64, gzip, JSON. */
export async function unpack(base64: string): Promise<DataJson> {
  const stream = new Blob([bytes(base64.trim())]).stream().pipeThrough(new DecompressionStream("gzip"));
  const data = JSON.parse(await new Response(stream).text()) as DataJson;
  columns = data.columns ?? [];
  return data;
}

/** The last index with `times[index] <= t`; -1 before the first. */
export function indexAt(times: Column, t: number): number {
  const view = times.view();
  let low = 0, high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (view[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** A track with its columns unpacked. */
export class Track {
  t: Column; n: Column; e: Column; u: Column;
  roll: Column; pitch: Column; yaw: Column; error: Column;

  constructor(json?: Partial<TrackJson> | null) {
    this.t = decode(json?.t);
    this.n = decode(json?.n);
    this.e = decode(json?.e);
    this.u = decode(json?.u);
    this.roll = decode(json?.roll);
    this.pitch = decode(json?.pitch);
    this.yaw = decode(json?.yaw);
    this.error = decode(json?.error);
  }

  get length(): number {
    return Math.min(this.t.length, this.n.length, this.e.length, this.u.length);
  }

  /** Position at a time, linear between samples, held beyond the ends; null when empty. */
  at(t: number): Point | null {
    const count = this.length;
    if (!count) return null;
    const i = Math.max(0, Math.min(count - 1, indexAt(this.t, t)));
    const j = Math.min(count - 1, i + 1);
    const span = this.t.at(j) - this.t.at(i);
    const f = span > 0 ? Math.max(0, Math.min(1, (t - this.t.at(i)) / span)) : 0;
    const mix = (c: Column) => c.at(i) + f * (c.at(j) - c.at(i));
    return [mix(this.n), mix(this.e), mix(this.u)];
  }

  /** A further column at a time: the sample before it; NaN when there is none. */
  value(column: Column, t: number): number {
    return column.length ? column.at(Math.max(0, Math.min(column.length - 1, indexAt(this.t, t)))) : NaN;
  }

  /** Rows of t, n, e, u and perhaps roll, pitch, yaw. */
  append(rows: (number | null)[][]): void {
    const order: Column[] = [this.t, this.n, this.e, this.u, this.roll, this.pitch, this.yaw];
    order.forEach((column, k) => {
      if (rows.length && rows[0].length > k) column.push(rows.map((row) => row[k]));
    });
  }
}
