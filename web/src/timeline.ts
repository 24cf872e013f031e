/** What happened, line by line: filtered by level, kind and words, each line a place to jump to. */

import type { EventJson } from "./data";
import { h } from "./dom";
import { clock } from "./format";
import type { State } from "./state";

const SHOWN = 400; // lines in the page at once; the rest on demand

const LEVELS: [string, (level: number) => boolean][] = [
  ["all", () => true],
  ["warnings", (level) => level <= 4],
  ["errors", (level) => level <= 3],
];

export class Timeline {
  readonly element: HTMLElement;
  private readonly list = h("ol.events", { tabindex: 0, "aria-label": "events" });
  private readonly count = h("span.count");
  private readonly kinds = h("div.kinds");
  private readonly off = new Set<string>();
  private readonly known = new Set<string>();
  private level = 0;
  private words = "";
  private limit = SHOWN;
  private rows: { event: EventJson; element: HTMLElement }[] = [];

  constructor(private readonly state: State, readonly events: EventJson[]) {
    const search = h<HTMLInputElement>("input", {
      type: "search", placeholder: "filter by text", "aria-label": "filter events by text", id: "event-search",
      oninput: () => {
        this.words = search.value.toLowerCase();
        this.fill();
      },
    });
    const levels = h("div.segments", { role: "group", "aria-label": "level" }, LEVELS.map(([name], k) =>
      h("button", {
        type: "button", "aria-pressed": String(k === 0), "data-level": name,
        onclick: (event: Event) => {
          this.level = k;
          for (const b of levels.children) b.setAttribute("aria-pressed", String(b === event.currentTarget));
          this.fill();
        },
      }, name)));
    this.element = h("div.timeline.card", h("div.filters", levels, this.kinds, search, this.count), this.list);
    this.fill();
    state.on("cursor", () => this.mark());
  }

  append(more: EventJson[]): void {
    const wasAtEnd = this.list.scrollTop + this.list.clientHeight >= this.list.scrollHeight - 24;
    this.events.push(...more);
    this.limit = Math.max(this.limit, SHOWN);
    this.fill();
    if (wasAtEnd) this.list.scrollTop = this.list.scrollHeight;
  }

  private fill(): void {
    for (const { kind } of this.events) {
      if (this.known.has(kind)) continue;
      this.known.add(kind);
      this.kinds.append(h("button.chip.kind-chip", {
        type: "button", "aria-pressed": "true", "data-kind": kind,
        onclick: (event: Event) => {
          const hidden = !this.off.delete(kind);
          if (hidden) this.off.add(kind);
          (event.currentTarget as HTMLElement).setAttribute("aria-pressed", String(!hidden));
          this.fill();
        },
      }, kind));
    }
    const fits = this.events.filter((e) =>
      LEVELS[this.level][1](e.level) && !this.off.has(e.kind) && (!this.words || `${e.kind} ${e.text}`.toLowerCase().includes(this.words)));
    this.count.textContent = fits.length === this.events.length ? `${fits.length} events` : `${fits.length} of ${this.events.length} events`;
    this.rows = fits.slice(Math.max(0, fits.length - this.limit)).map((event) => ({ event, element: this.row(event) }));
    const rest = fits.length - this.rows.length;
    this.list.replaceChildren(
      ...(rest > 0 ? [h("li.more", h("button", { type: "button", onclick: () => { this.limit *= 4; this.fill(); } }, `${rest} earlier`))] : []),
      ...this.rows.map((r) => r.element),
      ...(fits.length ? [] : [h("li.empty", this.events.length ? "no event fits the filter" : "nothing yet")]));
    this.mark();
  }

  private row(event: EventJson): HTMLElement {
    const level = event.level <= 3 ? "error" : event.level <= 4 ? "warning" : "info";
    return h(`li.event.${level}`, h("button", {
      type: "button",
      onclick: () => {
        this.state.setPlaying(false);
        this.state.setCursor(event.t);
        this.state.reveal();
      },
    }, h("span.t", clock(event.t)), h("span.kind", event.kind), h("span.text", event.text)));
  }

  /** The last event before the cursor is marked, and brought into sight when it changes (or `anew`). */
  mark(anew = false): void {
    let now: HTMLElement | undefined;
    for (const { event, element } of this.rows) if (event.t <= this.state.cursor + 1e-6) now = element;
    const old = this.list.querySelector(".now");
    if (old !== now) {
      old?.classList.remove("now");
      now?.classList.add("now");
    } else if (!anew) return;
    if (now && !this.list.matches(":hover, :focus-within")) {
      const top = now.offsetTop;
      if (top < this.list.scrollTop || top > this.list.scrollTop + this.list.clientHeight - 30) this.list.scrollTop = top - this.list.clientHeight / 2;
    }
  }
}
