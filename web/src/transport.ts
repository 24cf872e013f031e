/** Play, pause, speed, and the strip of the whole flight: phases, events, what the plots show, the cursor. */

import type { EventJson } from "./data";
import { colour, h, icon } from "./dom";
import { clock } from "./format";
import { SPEEDS, type State } from "./state";

const STRIP = 46, PAD = 5; // [px]; the handle is whole at both ends

/** Phases as spans of time: "a -> b (why)" begins b. */
export function phaseSpans(events: EventJson[], end: number): { name: string; from: number; to: number }[] {
  const spans: { name: string; from: number; to: number }[] = [];
  for (const event of events) {
    if (event.kind !== "phase") continue;
    const name = phaseName(event.text);
    if (spans.length && spans[spans.length - 1].to > event.t) spans[spans.length - 1].to = event.t;
    spans.push({ name, from: event.t, to: Math.max(end, event.t) });
  }
  return spans;
}

export function phaseName(text: string): string {
  return (text.split(/->|→/).pop() ?? text).replace(/\(.*$/, "").trim() || text;
}

export class Transport {
  readonly element: HTMLElement;
  private readonly canvas = h<HTMLCanvasElement>("canvas.strip", { "aria-hidden": "true" });
  private readonly time = h("output.time");
  private readonly playButton: HTMLButtonElement;
  private readonly slider: HTMLInputElement;

  constructor(private readonly state: State, private readonly events: () => EventJson[]) {
    this.playButton = h<HTMLButtonElement>("button.round", {
      type: "button", title: "play or pause (space)", "aria-label": "play", onclick: () => state.setPlaying(!state.playing),
    }, icon("play"));
    const speed = h<HTMLSelectElement>("select", {
      title: "speed of playing ([ and ])", "aria-label": "speed", onchange: () => state.setSpeed(Number(speed.value)),
    }, SPEEDS.map((s) => h("option", { value: String(s), selected: s === 1 }, `${s}×`)));
    this.slider = h<HTMLInputElement>("input.visually-hidden", {
      type: "range", min: "0", max: "1000", step: "1", "aria-label": "moment of the flight",
      oninput: () => state.setCursor(this.fromFraction(Number(this.slider.value) / 1000)),
    });
    const strip = h("div.strip-holder", this.canvas, this.slider);
    this.element = h("div.transport",
      h("div.transport-row",
        h("button.round", { type: "button", title: "to the start (home)", "aria-label": "to the start", onclick: () => state.setCursor(state.full[0]) }, icon("start")),
        this.playButton, this.time, speed),
      strip);
    this.listen(strip);
    new ResizeObserver(() => this.draw()).observe(strip);
    state.on(["cursor", "range", "theme", "data", "play"], () => {
      speed.value = String(state.speed);
      this.draw();
    });
    addEventListener("beforeprint", () => this.draw());
  }

  private fromFraction(fraction: number): number {
    const [low, high] = this.state.full;
    return low + Math.max(0, Math.min(1, fraction)) * (high - low);
  }

  private listen(strip: HTMLElement): void {
    const move = (event: PointerEvent) => {
      const box = strip.getBoundingClientRect();
      this.state.setCursor(this.fromFraction((event.clientX - box.left - PAD) / (box.width - 2 * PAD)));
      this.state.reveal();
    };
    let down = false;
    strip.addEventListener("pointerdown", (event) => {
      down = true;
      strip.setPointerCapture(event.pointerId);
      move(event);
    });
    strip.addEventListener("pointermove", (event) => down && move(event));
    const up = () => (down = false);
    strip.addEventListener("pointerup", up);
    strip.addEventListener("pointercancel", up);
    strip.addEventListener("dblclick", () => this.state.resetRange());
  }

  private draw(): void {
    const { state, canvas } = this;
    const [low, high] = state.full;
    const spans = phaseSpans(this.events(), high);
    const phase = [...spans].reverse().find((s) => s.from <= state.cursor)?.name;
    this.time.replaceChildren(h("b", clock(state.cursor)), h("span.of", ` / ${clock(high, high - low > 120 ? 0 : 1)}`), phase ? h("span.phase-tag", phase) : "");
    this.playButton.replaceChildren(icon(state.playing ? "pause" : "play"));
    this.playButton.setAttribute("aria-label", state.playing ? "pause" : "play");
    this.slider.value = String(Math.round((1000 * (state.cursor - low)) / (high - low)));
    this.slider.setAttribute("aria-valuetext", `${state.cursor.toFixed(1)} seconds`);

    const width = canvas.clientWidth, ratio = devicePixelRatio;
    if (!width) return;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(STRIP * ratio);
    const ctx = canvas.getContext("2d")!;
    ctx.scale(ratio, ratio);
    const x = (t: number) => PAD + ((t - low) / (high - low)) * (width - 2 * PAD);
    const bar = { y: 16, height: 14 };
    ctx.font = "10.5px system-ui, sans-serif";
    ctx.textBaseline = "middle";
    spans.forEach((span, k) => {
      const from = x(span.from), to = x(span.to);
      ctx.fillStyle = colour(`band${k % 2}`);
      ctx.fillRect(from, bar.y, Math.max(1, to - from), bar.height);
      const room = to - from - 8;
      if (ctx.measureText(span.name).width < room) {
        ctx.fillStyle = colour("ink-2");
        ctx.fillText(span.name, from + 4, bar.y + bar.height / 2 + 0.5);
      }
    });
    if (!spans.length) {
      ctx.fillStyle = colour("band0");
      ctx.fillRect(PAD, bar.y, width - 2 * PAD, bar.height);
    }
    for (const event of this.events()) {
      if (event.kind === "phase" && event.level > 4) continue;
      const loud = event.level <= 3 || event.kind === "failsafe";
      ctx.fillStyle = colour(loud ? "bad" : event.level <= 4 ? "warn" : "ink-3");
      const tall = loud ? 9 : event.level <= 4 ? 7 : 4;
      ctx.fillRect(x(event.t) - 0.75, bar.y - 2 - tall, 1.5, tall);
    }
    const [from, to] = state.range.map(x);
    if (to - from < width - 2 * PAD - 1) {
      ctx.fillStyle = colour("veil");
      ctx.fillRect(PAD, bar.y, from - PAD, bar.height);
      ctx.fillRect(to, bar.y, width - PAD - to, bar.height);
      ctx.strokeStyle = colour("accent");
      ctx.strokeRect(from + 0.5, bar.y - 0.5, Math.max(2, to - from - 1), bar.height + 1);
    }
    const at = x(state.cursor);
    ctx.fillStyle = colour("cursor");
    ctx.fillRect(at - 0.75, 4, 1.5, STRIP - 14);
    ctx.beginPath();
    ctx.arc(at, STRIP - 9, 4.5, 0, 7);
    ctx.fill();
  }
}
