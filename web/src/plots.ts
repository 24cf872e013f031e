/** Plots over time: linked axes, one cursor, drawn when they come into sight. */

import uPlot from "uplot";
import { Column, decode, indexAt, type EventJson, type PlotJson } from "./data";
import { align, windowed } from "./decimate";
import { colour, h } from "./dom";
import { clock, fixed, number } from "./format";
import { timeGestures } from "./gestures";
import type { State } from "./state";

const HEIGHT = 176;
const ROUNDING = 2e-6; // of a value: what differs by less is the same
const LIVE_KEPT = 120_000; // samples a series keeps while live

interface Line { label: string; style: string; t: Column; v: Column; shown: boolean; value: HTMLElement }

export class TimePlot {
  readonly element: HTMLElement;
  drawn = false;
  private lines: Line[] | null = null;
  private plot: uPlot | null = null;
  private readonly holder = h("div.plot-area", { style: { height: `${HEIGHT}px` } });
  private readonly legend = h("div.legend");
  private readonly empty = h("p.no-samples", { hidden: true }, "no samples");
  private cursorLine = h("div.cursor-line");
  private dirty = true;
  visible = false;

  constructor(readonly json: PlotJson, private readonly state: State, private readonly events: () => EventJson[]) {
    this.element = h("figure.plot", { id: `plot-${json.id}`, "data-plot": json.id },
      h("figcaption", h("span.plot-title", json.title), json.unit ? h("span.unit", json.unit) : null, this.legend),
      h("div.plot-frame", this.holder, this.empty),
      json.note ? h("p.note", json.note) : null);
    json.series.forEach((series, k) => this.legend.append(this.chip(series.label, k)));
  }

  private chip(label: string, k: number): HTMLElement {
    const value = h("span.value", "");
    return h("button.chip", {
      type: "button", "aria-pressed": "true", title: `show or hide ${label}`,
      onclick: (event: Event) => {
        const line = this.unpacked()[k];
        line.shown = !line.shown;
        (event.currentTarget as HTMLElement).setAttribute("aria-pressed", String(line.shown));
        this.plot?.setSeries(k + 1, { show: line.shown });
      },
    }, h("span.swatch", { style: { background: `var(--s${k % 8})` } }), label, value);
  }

  /** Columns are unpacked when first wanted. */
  private unpacked(): Line[] {
    if (!this.lines) {
      const values = [...this.legend.querySelectorAll<HTMLElement>(".value")];
      this.lines = this.json.series.map((s, k) => ({
        label: s.label, style: s.style ?? "line", t: decode(s.t), v: decode(s.v), shown: true, value: values[k],
      }));
    }
    return this.lines;
  }

  append(more: Record<string, [number[], (number | null)[]]>): void {
    for (const [label, [t, v]] of Object.entries(more)) {
      const lines = this.unpacked();
      let line = lines.find((l) => l.label === label);
      if (!line) {
        this.json.series.push({ label, t: [], v: [] });
        const chip = this.chip(label, lines.length);
        this.legend.append(chip);
        line = { label, style: "line", t: new Column(), v: new Column(), shown: true, value: chip.querySelector(".value")! };
        lines.push(line);
        this.plot?.destroy();
        this.plot = null;
      }
      line.t.push(t);
      line.v.push(v);
      if (line.t.length > LIVE_KEPT) {
        line.t.drop(LIVE_KEPT / 4);
        line.v.drop(LIVE_KEPT / 4);
      }
    }
    this.dirty = true;
  }

  stale(): void {
    this.dirty = true;
  }

  /** Colours have changed: begin anew. */
  restyle(): void {
    this.plot?.destroy();
    this.plot = null;
    this.dirty = true;
  }

  /** Draw what is stale; `force` for print, where everything is in sight. */
  update(force = false): void {
    if (!this.dirty || !(this.visible || force)) return;
    const width = this.holder.clientWidth;
    if (!width) return;
    this.dirty = false;
    const [low, high] = this.state.range;
    const data = align(this.unpacked().map((line) => windowed(line.t, line.v, low, high, width))) as uPlot.AlignedData;
    if (!this.plot) this.create(width, data);
    else {
      if (this.plot.width !== width) this.plot.setSize({ width, height: HEIGHT });
      this.plot.setData(data, true);
    }
    this.empty.hidden = this.unpacked().some((line) => line.t.length > 0);
    this.drawn = true;
    this.element.dataset.drawn = "true";
  }

  moveCursor(): void {
    if (!this.plot) return;
    const x = this.plot.valToPos(this.state.cursor, "x");
    const inside = x >= 0 && x <= this.plot.over.clientWidth;
    this.cursorLine.style.transform = `translateX(${x}px)`;
    this.cursorLine.hidden = !inside;
    for (const line of this.unpacked()) {
      const text = number(valueAt(line, this.state.cursor));
      if (line.value.textContent !== text) line.value.textContent = text;
    }
  }

  private create(width: number, data: uPlot.AlignedData): void {
    const ink = colour("ink-2"), grid = colour("grid");
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    const { stepped } = uPlot.paths;
    this.plot = new uPlot({
      width,
      height: HEIGHT,
      padding: [8, 8, 0, 0],
      cursor: { show: false },
      legend: { show: false },
      scales: {
        x: { time: false, range: () => this.state.range },
        y: { range: (_, low, high) => this.spread(low, high) },
      },
      axes: [
        { ...axis, size: 26, gap: 7, space: 64, values: (_, splits, __, ___, step) => splits.map((s, k) => timeLabel(s, step, this.state.range) + (k || this.state.range[1] > 120 ? "" : " s")) },
        { ...axis, size: 54, gap: 4, space: 26, values: (_, splits, __, ___, step) => splits.map((s) => tickLabel(s, step)) },
      ],
      series: [{}, ...this.unpacked().map((line, k) => {
        const stroke = colour(`s${k % 8}`);
        const dots = line.style === "dots";
        return {
          label: line.label, stroke, width: dots ? 0 : 1.4, show: line.shown,
          paths: dots ? () => null : line.style === "step" ? stepped!({ align: 1 }) : undefined,
          points: dots ? { show: true, size: 4, fill: stroke, stroke, width: 0 } : { show: false },
        } as uPlot.Series;
      })],
      hooks: { drawAxes: [(u) => this.drawMarks(u)], draw: [(u) => { this.drawBounds(u); this.moveCursor(); }] },
    }, data, this.holder);
    this.cursorLine = h("div.cursor-line");
    this.plot.over.append(this.cursorLine);
    const { plot } = this;
    timeGestures(plot.over, this.state, (px) => plot.posToVal(px, "x"));
  }

  /** The y axis: the data in sight and every bound not far from them. */
  private spread(low: number | null, high: number | null): [number, number] {
    if (low === null || high === null || !Number.isFinite(low + high)) [low, high] = [0, 1];
    const span = high - low || Math.abs(high) || 1;
    const reach = 1.5 * Math.max(span, Math.abs(high), Math.abs(low));
    for (const { value } of this.json.bounds ?? []) {
      if (value > high && value - high <= reach) high = value;
      if (value < low && low - value <= reach) low = value;
    }
    const size = Math.max(Math.abs(high), Math.abs(low));
    if (high - low <= ROUNDING * size) [low, high] = [low - 0.05 * size, high + 0.05 * size]; // flat, but for float32
    const margin = 0.07 * (high - low || span);
    return [low >= 0 && low - margin < 0 ? Math.min(0, low) : low - margin, high + margin];
  }

  /** Phases and failures, behind the lines. */
  private drawMarks(u: uPlot): void {
    const { ctx } = u, { left, top, width, height } = u.bbox, ratio = devicePixelRatio;
    ctx.save();
    for (const event of this.events()) {
      const failure = event.level <= 3 || event.kind === "failsafe";
      if (!failure && event.kind !== "phase") continue;
      const x = Math.round(u.valToPos(event.t, "x", true));
      if (x < left || x > left + width) continue;
      ctx.strokeStyle = colour(failure ? "bad" : "line");
      ctx.lineWidth = ratio;
      ctx.setLineDash(failure ? [] : [3 * ratio, 3 * ratio]);
      ctx.beginPath();
      ctx.moveTo(x + 0.5, top);
      ctx.lineTo(x + 0.5, top + height);
      ctx.stroke();
    }
    ctx.restore();
  }

  private drawBounds(u: uPlot): void {
    const { ctx } = u, { left, top, width, height } = u.bbox, ratio = devicePixelRatio;
    ctx.save();
    ctx.font = `${10.5 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = "right";
    const labels: { y: number; left: number }[] = [];
    for (const bound of this.json.bounds ?? []) {
      const y = Math.round(u.valToPos(bound.value, "y", true));
      if (y < top || y > top + height) continue;
      ctx.strokeStyle = ctx.fillStyle = colour("warn");
      ctx.lineWidth = ratio;
      ctx.setLineDash([6 * ratio, 4 * ratio]);
      ctx.beginPath();
      ctx.moveTo(left, y + 0.5);
      ctx.lineTo(left + width, y + 0.5);
      ctx.stroke();
      const above = y - top > 14 * ratio;
      ctx.textBaseline = above ? "bottom" : "top";
      const beside = labels.filter((l) => Math.abs(l.y - y) < 13 * ratio).map((l) => l.left); // close ones stand beside one another
      const right = Math.min(left + width, ...beside) - 4 * ratio;
      ctx.fillText(bound.label, right, y + (above ? -2 : 3) * ratio);
      labels.push({ y, left: right - ctx.measureText(bound.label).width - 6 * ratio });
    }
    ctx.restore();
  }
}

/** The sample nearest to a moment; of a staircase the one before it. */
function valueAt(line: Line, t: number): number {
  const i = indexAt(line.t, t);
  if (line.style === "step" || i + 1 >= line.t.length) return line.v.at(i);
  return i < 0 || line.t.at(i + 1) - t < t - line.t.at(i) ? line.v.at(i + 1) : line.v.at(i);
}

/** Decimal places that a multiple of the step needs: 1 for 2.5. */
function places(step: number): number {
  for (let count = 0; count < 8; count++) {
    const scaled = step * 10 ** count;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-6 * scaled) return count;
  }
  return 8;
}

export function tickLabel(value: number, step: number): string {
  const size = Math.abs(value);
  if (size >= 1e5) return value.toExponential(Math.min(2, Math.max(0, Math.floor(Math.log10(size / step))))).replace("-", "−").replace("e+", "e");
  if (step < 1e-5) return value.toExponential(1).replace("-", "−");
  return fixed(value, places(step));
}

export function timeLabel(value: number, step: number, range: [number, number]): string {
  return range[1] > 120 ? clock(value, places(step)) : fixed(value, places(step));
}

/** All plots of the page: they learn here what is in sight. */
export class Plots {
  readonly all: TimePlot[] = [];
  private readonly sight: IntersectionObserver;
  private readonly size: ResizeObserver;

  constructor(state: State) {
    const of = (element: Element) => this.all.find((p) => p.element === element);
    this.sight = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        const plot = of(entry.target);
        if (!plot) continue;
        plot.visible = entry.isIntersecting;
        plot.update();
        plot.moveCursor();
      }
    }, { rootMargin: "120px 0px" });
    this.size = new ResizeObserver((entries) => {
      for (const entry of entries) {
        of(entry.target)?.stale();
        of(entry.target)?.update();
      }
    });
    state.on("range", () => this.redraw());
    state.on("cursor", () => this.all.forEach((p) => p.visible && p.moveCursor()));
    state.on("data", () => this.all.forEach((p) => p.update()));
    state.on("theme", () => this.all.forEach((p) => { p.restyle(); p.update(); }));
  }

  add(plot: TimePlot): void {
    this.all.push(plot);
    this.sight.observe(plot.element);
    this.size.observe(plot.element);
  }

  /** Everything anew at once, in the colours and the width of now: paper has no below the fold. */
  drawAll(): void {
    for (const plot of this.all) {
      plot.restyle();
      plot.update(true);
    }
  }

  redraw(): void {
    for (const plot of this.all) {
      plot.stale();
      plot.update();
    }
  }

  find(id: string): TimePlot | undefined {
    return this.all.find((p) => p.json.id === id);
  }
}
