/** Histograms as SVG: bars, marks, and the share below as a thin line. */

import type { HistogramJson } from "./data";
import { h, svg } from "./dom";
import { number } from "./format";

const HEIGHT = 176, LEFT = 44, RIGHT = 46, TOP = 18, BOTTOM = 24;
const LETTER = 6; // about the width of one in a mark's label [px]

export class Histogram {
  readonly element: HTMLElement;
  private readonly holder = h("div.histogram-area");
  private readonly readout = h("span.readout");

  constructor(public json: HistogramJson) {
    this.element = h("figure.plot.histogram", { id: `plot-${json.id}`, "data-histogram": json.id },
      h("figcaption", h("span.plot-title", json.title), json.unit ? h("span.unit", json.unit) : null, this.readout),
      this.holder, json.note ? h("p.note", json.note) : null);
    new ResizeObserver(() => this.draw()).observe(this.holder);
    addEventListener("beforeprint", () => this.draw());
  }

  replace(json: HistogramJson): void {
    this.json = json;
    this.draw();
  }

  private draw(): void {
    const width = this.holder.clientWidth;
    if (!width) return;
    const { edges, counts } = this.json;
    const total = counts.reduce((a, b) => a + b, 0);
    this.readout.textContent = `${total.toLocaleString("en")} in all`;
    if (edges.length < 2) {
      this.holder.replaceChildren(h("p.note", "nothing to count"));
      return;
    }
    const low = edges[0], high = edges[edges.length - 1], most = Math.max(1, ...counts);
    const x = (v: number) => LEFT + ((v - low) / (high - low || 1)) * (width - LEFT - RIGHT);
    const y = (share: number) => TOP + (1 - share) * (HEIGHT - TOP - BOTTOM);
    const drawing = svg("svg", { width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}`, role: "img", "aria-label": `histogram of ${this.json.title}` });
    for (const share of niceTicks(most)) {
      drawing.append(svg("line", { x1: LEFT, x2: width - RIGHT, y1: y(share / most), y2: y(share / most), class: "grid" }),
        svg("text", { x: LEFT - 6, y: y(share / most) + 3.5, class: "tick end" }, number(share)));
    }
    for (const v of spread(low, high, Math.max(2, Math.floor((width - LEFT - RIGHT) / 80)))) {
      drawing.append(svg("text", { x: x(v), y: HEIGHT - 7, class: "tick middle" }, number(v, 3)));
    }
    let below = 0;
    const line = [`M${x(low)} ${y(0)}`];
    counts.forEach((count, k) => {
      below += count;
      const share = total ? below / total : 0;
      const from = x(edges[k]), to = x(edges[k + 1]);
      const bar = svg("rect", { x: from + 0.5, width: Math.max(1, to - from - 1), y: y(count / most), height: Math.max(count ? 1 : 0, y(0) - y(count / most)), class: "bar", rx: 1 });
      bar.append(svg("title", {}, `${number(edges[k])} to ${number(edges[k + 1])} ${this.json.unit}: ${count}, ${number(100 * share, 3)} % at or below`));
      drawing.append(bar);
      line.push(`L${to} ${y(share)}`);
    });
    drawing.append(svg("path", { d: line.join(""), class: "share" }),
      svg("text", { x: width - RIGHT + 4, y: y(1) + 3.5, class: "tick" }, "100 %"), svg("text", { x: width - RIGHT + 4, y: y(0.5) + 3.5, class: "tick" }, "50 %"));
    const rows: number[] = []; // how far each row of labels reaches
    for (const mark of [...(this.json.marks ?? [])].sort((a, b) => a.value - b.value)) {
      if (mark.value < low || mark.value > high) continue;
      const at = x(mark.value);
      const label = `${mark.label} ${number(mark.value, 3)}`;
      const long = LETTER * label.length, end = at + long > width - 4;
      const from = end ? at - 4 - long : at + 4;
      let row = rows.findIndex((reach) => reach < from - 6);
      if (row < 0) row = rows.length;
      rows[row] = from + long;
      drawing.append(svg("line", { x1: at, x2: at, y1: TOP - 4, y2: y(0), class: "mark" }),
        svg("text", { x: end ? at - 4 : at + 4, y: TOP - 6 + 13 * row, class: `mark-label${end ? " end" : ""}` }, label));
    }
    this.holder.replaceChildren(drawing);
    this.element.dataset.drawn = "true";
  }
}

function niceStep(span: number, count: number): number {
  const raw = span / count, power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((m) => m * power >= raw) ?? 10);
}

function niceTicks(most: number): number[] {
  const step = Math.max(1, niceStep(most, 3));
  return Array.from({ length: Math.floor(most / step) + 1 }, (_, k) => k * step);
}

function spread(low: number, high: number, count: number): number[] {
  const step = niceStep(high - low || 1, count);
  const out: number[] = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) out.push(Math.abs(v) < step * 1e-6 ? 0 : v);
  return out;
}
