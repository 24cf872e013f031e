/** The page: data in, parts put together, nothing kept elsewhere. */

import "uplot/dist/uPlot.min.css";
import "./style.css";
import { unpack, type DataJson, type EventJson, type HeaderJson, type HistogramJson, type MoverJson, type PlanJson, type SceneJson, type TableJson } from "./data";
import { h, icon, setTheme } from "./dom";
import { Histogram } from "./histogram";
import { keyboard } from "./keys";
import { Link, LivePanel, liveConfig, type Append } from "./live";
import { Plots, TimePlot } from "./plots";
import { FlightScene } from "./scene";
import { State } from "./state";
import { DataTable } from "./tables";
import { Timeline } from "./timeline";
import { Transport } from "./transport";
import { Verdict, verdictWord } from "./verdict";

const SECTIONS = ["path", "tracking", "setpoints", "estimator", "actuators", "planning", "link", "timeline", "parameters"];
const started = performance.now();

/** Everything that is on the page of one flight. */
class Page {
  readonly state = new State();
  readonly plots: Plots;
  readonly scene: FlightScene;
  readonly timeline: Timeline;
  readonly verdict: Verdict;
  readonly histograms: Histogram[] = [];
  readonly tables = new Map<string, DataTable>();
  readonly element: HTMLElement;
  private readonly badge = h("span.badge");
  private readonly nav = h("nav.sections", { "aria-label": "sections" });
  private readonly column = h("div.column");
  private readonly ended = new AbortController();
  readonly panel: LivePanel | null;

  constructor(readonly data: DataJson, link: Link | null) {
    const { state } = this;
    const live = (this.panel = link && new LivePanel(state, (order, values) => link.send(order, values)));
    const events: EventJson[] = [...data.events];
    this.plots = new Plots(state);
    this.scene = new FlightScene(data.scene, state, !!live);
    const low = Math.min(0, this.scene.firstTime()), high = Math.max(live ? 0 : data.header.duration_s || 0, this.scene.lastTime(), ...events.slice(-1).map((e) => e.t), low + 1e-3);
    state.full = [low, high];
    state.range = [low, high];
    state.setCursor(live ? high : startOf(data, low));
    this.timeline = new Timeline(state, events);
    this.verdict = new Verdict(data.header);
    const transport = new Transport(state, () => events);
    live?.attach(this.scene);
    const help = keyboard(state, this.scene, toggleTheme, this.ended.signal);
    this.element = h("div.page",
      h("header.top",
        h("a.brand", { href: "#verdict" }, this.badge, h("span.brand-title", data.header.title)),
        this.nav,
        live?.badge ?? null,
        h("button.round", { type: "button", title: "dark or light (t)", "aria-label": "dark or light", onclick: toggleTheme }, icon("theme")),
        h("button.round", { type: "button", title: "keys (?)", "aria-label": "help", onclick: help.open }, "?")),
      h("main",
        h("div.workspace",
          h("aside.stage", h("section.stage-card", { id: "scene", "aria-label": "scene" }, this.scene.element, live?.notice ?? null, this.scene.below, transport.element, live?.element ?? null)),
          this.column)));
    this.fill();
    this.title(data.header);
    state.tell("cursor");
  }

  /** Plots, histograms and tables under the heads of their sections. */
  private fill(): void {
    const { data } = this;
    const names = new Set([...SECTIONS, ...data.plots.map((p) => p.section), ...data.histograms.map((p) => p.section), ...data.tables.map((t) => t.section)]);
    names.delete("verdict");
    const links: [string, string][] = [["verdict", "Verdict"], ["scene", "Scene"]];
    for (const name of names) {
      const plots = data.plots.filter((p) => p.section === name).map((p) => new TimePlot(p, this.state, () => this.timeline.events));
      const histograms = data.histograms.filter((p) => p.section === name).map((p) => new Histogram(p));
      const tables = data.tables.filter((t) => t.section === name).map((t) => this.table(t));
      if (name !== "timeline" && !plots.length && !histograms.length && !tables.length) continue;
      const title = name.charAt(0).toUpperCase() + name.slice(1);
      links.push([`section-${name}`, title]);
      this.column.append(h("section.section", { id: `section-${name}`, "aria-label": title }, h("h2", title),
        name === "timeline" ? this.timeline.element : null,
        h("div.plots", plots.map((p) => p.element)),
        histograms.length ? h("div.histograms", histograms.map((p) => p.element)) : null, ...tables));
      plots.forEach((p) => this.plots.add(p));
      this.histograms.push(...histograms);
    }
    this.column.prepend(this.verdict.element);
    const extra = data.tables.filter((t) => t.section === "verdict").map((t) => this.table(t));
    const more = data.plots.filter((p) => p.section === "verdict").map((p) => new TimePlot(p, this.state, () => this.timeline.events));
    this.verdict.element.after(...(extra.length || more.length ? [h("section.section.verdict-more", ...extra, h("div.plots", more.map((p) => p.element)))] : []));
    more.forEach((p) => this.plots.add(p));
    this.nav.append(...links.map(([id, title]) => h("a", { href: `#${id}` }, title)));
    const seen = new Map<string, boolean>();
    const watch = new IntersectionObserver((entries) => {
      for (const entry of entries) seen.set(entry.target.id, entry.isIntersecting);
      const now = links.find(([id]) => id !== "scene" && seen.get(id))?.[0];
      for (const link of this.nav.querySelectorAll("a")) {
        const on = link.hash === `#${now}`;
        if (on && !link.classList.contains("now")) this.nav.scrollTo({ left: link.offsetLeft - this.nav.clientWidth / 2 });
        link.classList.toggle("now", on);
      }
    }, { rootMargin: "-70px 0px -55% 0px" });
    for (const section of this.column.children) watch.observe(section);
  }

  /** Another page takes its place. */
  end(): void {
    this.ended.abort();
    this.state.setPlaying(false);
    this.scene.end();
    this.element.remove();
  }

  private table(json: TableJson): HTMLElement {
    const table = new DataTable(json);
    this.tables.set(json.title, table);
    return table.element;
  }

  private title(header: HeaderJson): void {
    const { word, tone } = verdictWord(header);
    this.badge.textContent = word;
    this.badge.className = `badge ${tone}`;
    if (this.panel) this.panel.over = header.ok !== null;
    document.title = `${header.title} · ${word}`;
  }

  append(more: Append): void {
    const { state } = this;
    let newest = state.full[1];
    for (const [id, series] of Object.entries((more.series ?? {}) as Record<string, Record<string, [number[], number[]]>>)) {
      this.plots.find(id)?.append(series);
      for (const [t] of Object.values(series)) if (t.length) newest = Math.max(newest, t[t.length - 1]);
    }
    const rows = more.path as number[][] | undefined;
    if (rows?.length) newest = Math.max(newest, rows[rows.length - 1][0]);
    if (more.scene) this.scene.replace(more.scene as Partial<SceneJson>);
    this.scene.append({
      path: rows, truth: more.truth as number[][], reference: more.reference as number[][], plans: more.plans as PlanJson[], movers: more.movers as MoverJson[],
      pose: more.pose as Record<string, number>,
    });
    const events = (more.events ?? []) as EventJson[];
    if (events.length) {
      this.timeline.append(events);
      newest = Math.max(newest, events[events.length - 1].t);
    }
    if (more.header) this.title(this.verdict.update(more.header as Partial<HeaderJson>));
    for (const json of (more.histograms ?? []) as HistogramJson[]) this.histograms.find((p) => p.json.id === json.id)?.replace(json);
    for (const json of (more.tables ?? []) as TableJson[]) this.tables.get(json.title)?.replace(json);
    if (newest > state.full[1]) state.setFull(state.full[0], newest);
    state.tell("data");
  }
}

/** A report opens where there is something to see: at the least clearance, or half-way. */
function startOf(data: DataJson, low: number): number {
  return data.scene.least?.t ?? low + 0.45 * (data.header.duration_s || 0);
}

// ---- theme

const wanted = matchMedia("(prefers-color-scheme: dark)");
let chosen: string | null = null;
try {
  chosen = localStorage.getItem("companion-theme");
} catch {
  // a page from a file may have no storage
}

function applyTheme(): void {
  setTheme(chosen ?? (wanted.matches ? "dark" : "light"));
  page?.state.tell("theme");
}

function toggleTheme(): void {
  chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  try {
    localStorage.setItem("companion-theme", chosen);
  } catch {
    // then it holds until the page is closed
  }
  applyTheme();
}

// Paper is light and narrow, whatever the screen is; nothing on it waits to come into sight.
function print(before: boolean): void {
  document.documentElement.classList.toggle("printing", before);
  if (before) setTheme("light");
  else applyTheme();
  page?.scene.drawNow();
  page?.plots.drawAll();
}

// ---- begin

let page: Page | null = null;

function show(data: DataJson, link: Link | null): Page {
  if (data.version !== 1) throw new Error(`this page reads version 1 of the data, found ${data.version}`);
  const old = page;
  const next = new Page(data, link);
  old?.end();
  document.querySelector(".waiting")?.remove();
  document.body.append(next.element);
  next.timeline.mark(true);
  return next;
}

function complain(text: string): void {
  document.querySelector(".waiting")?.remove();
  document.body.append(h("p.complaint", text));
}

async function begin(): Promise<void> {
  applyTheme();
  wanted.addEventListener("change", applyTheme);
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
  const config = liveConfig();
  const test: Record<string, unknown> = ((window as unknown as Record<string, unknown>).companionPage = { ready: false });
  if (config) {
    const waiting = h("p.waiting", "waiting for the flight …");
    document.body.append(waiting);
    const link: Link = new Link(config, {
      data: (data) => {
        const { window, follow } = page?.state ?? { window: 60, follow: true };
        page = show(data, link); // after a reconnection the whole flight comes again
        page.state.setFollow(follow, window);
        page.panel!.show(link.state, performance.now());
        Object.assign(test, { ready: true, page, link });
      },
      append: (more) => page?.append(more),
      answer: (answer) => page?.panel?.answered(answer),
      state: (now, heard) => {
        waiting.textContent = now === "lost" ? "no connection, trying again …" : "waiting for the flight …";
        page?.panel?.show(now, heard);
      },
    });
    return;
  }
  const block = document.getElementById("data");
  if (!block) return complain("There are no data in this page.");
  try {
    const data = await unpack(block.textContent ?? "");
    block.remove();
    page = show(data, null);
  } catch (error) {
    return complain(`The data in this page cannot be read: ${error instanceof Error ? error.message : error}`);
  }
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.documentElement.dataset.ready = "true";
    Object.assign(test, { ready: true, page, took: performance.now() - started });
  }));
}

void begin();
