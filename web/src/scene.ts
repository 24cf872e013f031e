/** The flight in space: its parts put together, rebuilt when they change, moved with the cursor. */

import { Scene as Stage, Vector3, type WebGLRenderer } from "three";
import { Cameras, VIEWS, type Extent, type View } from "./cameras";
import { Craft, type Angles } from "./craft";
import type { MoverJson, PlanJson, Point, SceneJson, Track } from "./data";
import { colour, h, svg } from "./dom";
import { Labels } from "./labels";
import { Layers } from "./layers";
import { fat, flat3, thin } from "./lines";
import { Movers } from "./movers";
import { Painter } from "./painter";
import { clicks, Goal, nearest } from "./picking";
import { Readout } from "./readout";
import { dispose, toThree, type Ground } from "./solids";
import { extentOf, light, stand, standing } from "./standing";
import type { State } from "./state";
import { Tint } from "./tint";
import { Tracks, type Rows } from "./tracks";
import { Ways } from "./ways";

const MOST_VERTICES = 6000, MOST_IN_SOFTWARE = 1500; // of a line; each costs the processor a few microseconds a frame
const REBUILD_MS = 250; // a path that grows is drawn anew no more often

export interface More extends Rows { plans?: PlanJson[]; movers?: MoverJson[]; pose?: Record<string, number> }

export class FlightScene {
  readonly element: HTMLElement;
  /** What is in it, for those who look after it: counts of things drawn. */
  readonly drawn = { vertices: 0, obstacles: 0, plans: 0, movers: 0, frames: 0 };
  following = false;
  /** Called with (north, east) when the ground is clicked while a goal is asked for. */
  onGoal: ((north: number, east: number) => void) | null = null;

  private readonly canvas = h<HTMLCanvasElement>("canvas.scene-canvas", { tabindex: 0, "aria-label": "3D scene: drag to turn, wheel to zoom, right drag to move" });
  private readonly stage = new Stage();
  private readonly painter = new Painter(this.canvas, (renderer) => this.draw(renderer));
  readonly cameras = new Cameras(this.canvas, () => this.painter.invalidate());
  readonly craft = new Craft();
  readonly layers = new Layers(this.stage, () => this.moveCursor());
  private readonly labels = new Labels();
  private readonly tint = new Tint(() => this.rebuildPath());
  private readonly readout = new Readout();
  private readonly movers = new Movers();
  private readonly ways = new Ways();
  private readonly goal = new Goal();
  private readonly needle = svg("g", {}, svg("path", { d: "M0 -13 L5 2 L0 -1 L-5 2z", class: "needle" }), svg("text", { x: 0, y: -15.5, class: "north" }, "N"));
  private readonly tracks: Tracks;
  private extent!: Extent;
  private kept: number[] = []; // indices of the path's drawn vertices
  private pose: Record<string, number> | null = null;
  private sized = false;
  private rebuildSoon = 0;

  constructor(private json: SceneJson, private readonly state: State, private readonly live: boolean) {
    const { renderer } = this.painter;
    this.tracks = new Tracks(json);
    if (!live && !this.tracks.judged) this.tint.choose("speed");
    this.ways.replace(json.plans ?? []);
    this.movers.replace(json.movers ?? []);
    const compass = svg("svg", { viewBox: "-28 -28 56 56", width: 56, height: 56, class: "compass" }, svg("circle", { r: 26, class: "dial" }), this.needle);
    this.element = h("div.scene", { "data-scene": renderer ? "webgl" : "none" }, renderer
      ? [this.canvas, this.labels.element, this.toolbar(), compass as unknown as HTMLElement, this.tint.element]
      : h("p.no-webgl", "This browser draws no WebGL, so there is no 3D scene. Everything else is here."));
    if (renderer) this.listen();
    this.rebuild();
    if (renderer) this.cameras.reset();
    state.on("cursor", () => this.moveCursor());
    state.on("theme", () => this.rebuild());
  }

  /** What stands under the scene: which layers are shown, and the numbers at the cursor. */
  get below(): HTMLElement[] {
    return this.painter.renderer ? [this.layers.bar, this.readout.element] : [this.readout.element];
  }

  get path(): Track {
    return this.tracks.path;
  }

  get floor(): Ground {
    return this.extent.floor;
  }

  firstTime(): number {
    return this.tracks.first;
  }

  lastTime(): number {
    return this.tracks.last;
  }

  // ---- what it is made of

  /** Fields that replace those of before. */
  replace(more: Partial<SceneJson>): void {
    this.json = { ...this.json, ...more };
    this.tracks.replace(more);
    if (more.plans) this.ways.replace(more.plans);
    if (more.movers) this.movers.replace(more.movers);
    this.rebuild();
  }

  append(more: More): void {
    const longer = this.tracks.append(more);
    if (more.pose) this.pose = more.pose;
    if (more.plans?.length) this.ways.append(more.plans);
    if (more.movers?.length && this.movers.append(more.movers)) this.rebuildMovers();
    if (longer) this.rebuildSoon ||= window.setTimeout(() => this.grow(), REBUILD_MS);
    this.moveCursor();
  }

  /** The path is longer: draw it, or all when it has left the ground that is drawn. */
  private grow(): void {
    this.rebuildSoon = 0;
    const last = this.path.length - 1, { low, high } = this.floor;
    const [n, e] = this.tracks.place(last);
    if (last >= 0 && (n < low[0] || n > high[0] || e < low[1] || e > high[1])) {
      this.rebuild();
      if (!this.cameras.turned) this.cameras.reset();
      return;
    }
    this.rebuildPath();
    this.listLayers();
    this.moveCursor();
  }

  private rebuild(): void {
    const { json } = this;
    this.extent = extentOf(json, this.tracks, this.ways);
    this.cameras.measured(this.extent);
    light(this.stage);
    stand(json, this.extent, this.layers, this.labels, (t) => this.state.setCursor(t));
    this.drawn.obstacles = json.obstacles.length;
    this.rebuildPath();
    this.rebuildMovers();
    this.craft.build(this.stage);
    this.ways.stale();
    this.listLayers();
    this.moveCursor();
  }

  private rebuildPath(): void {
    const { tracks, labels, layers } = this, most = this.painter.soft ? MOST_IN_SOFTWARE : MOST_VERTICES;
    const flown = layers.fresh("path");
    this.kept = thin(tracks.path, this.extent.reach, most);
    const tint = this.tint.of(tracks, this.kept, this.floor.level, this.state.full[1]);
    labels.clear("path");
    if (this.kept.length > 1) {
      flown.add(fat(flat3(tracks.path, this.kept), tint, 4));
      labels.add("start", toThree(tracks.place(0)), "place", "path");
      if (!this.live) labels.add("end", toThree(tracks.place(tracks.path.length - 1)), "place", "path");
    }
    for (const [name, tone, dash] of [["reference", "ink-2", this.extent.reach / 120], ["truth", "s2", 0]] as const) {
      const group = layers.fresh(name), kept = thin(tracks[name], this.extent.reach, most);
      if (kept.length > 1) group.add(fat(flat3(tracks[name], kept), colour(tone), 1.6, 0.8, dash));
    }
    this.drawn.vertices = this.kept.length;
    this.painter.invalidate();
  }

  private rebuildMovers(): void {
    this.movers.build(this.layers.fresh("movers"), this.labels);
    this.drawn.movers = this.movers.count;
    this.listLayers();
  }

  private listLayers(): void {
    const { path, reference, truth } = this.tracks;
    this.layers.list({
      ...standing(this.json), path: path.length > 1, reference: reference.length > 1, truth: truth.length > 1,
      plan: this.ways.has(false), backup: this.ways.has(true), movers: this.movers.count > 0,
    });
  }

  // ---- what the cursor moves

  private moveCursor(): void {
    const t = this.state.cursor, { path } = this;
    const newest = this.live && this.state.follow && this.pose;
    const at: Point | null = newest ? [newest.n, newest.e, newest.u] : path.at(t);
    const place = at && toThree(at);
    const angle = (name: keyof Angles) => (newest ? newest[name] : path.value(path[name], t)) || 0;
    this.craft.place(place, { roll: angle("roll"), pitch: angle("pitch"), yaw: angle("yaw") }, this.floor.level);
    if (place && this.following) this.cameras.moveTo(place);
    const should = this.layers.shown("reference") ? this.tracks.referenceAt(t, 0, 0.2) : null;
    this.craft.placeGhost(should && toThree(should));
    this.movers.moveTo(t);
    this.drawn.plans = this.ways.show(t, this.layers) ?? this.drawn.plans;
    this.readout.fill(t, at, this.tracks);
    this.painter.invalidate();
  }

  // ---- cameras and pointers

  private listen(): void {
    new ResizeObserver(() => this.resize()).observe(this.element);
    clicks(this.canvas, (event) => this.click(event));
    this.canvas.addEventListener("dblclick", () => this.cameras.reset());
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.rebuild());
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!this.painter.renderer || !width || !height) return;
    this.painter.renderer.setSize(width, height, false);
    this.cameras.resize(width, height);
    if (!this.sized) this.cameras.reset();
    this.sized = true;
    this.painter.invalidate();
  }

  setView(view: View): void {
    if (!this.painter.renderer) return;
    this.cameras.setView(view);
    for (const button of this.element.querySelectorAll<HTMLElement>("[data-view]")) button.setAttribute("aria-pressed", String(button.dataset.view === view));
  }

  setFollowing(following: boolean): void {
    this.following = following;
    this.element.querySelector("[data-follow]")?.setAttribute("aria-pressed", String(following));
    this.moveCursor();
  }

  get focused(): boolean {
    return document.activeElement === this.canvas;
  }

  private click(event: PointerEvent): void {
    if (this.onGoal) {
      const place = this.cameras.groundAt(event.clientX, event.clientY);
      if (place) this.onGoal(...place);
      return;
    }
    const best = nearest(event, this.tracks, this.kept, this.cameras);
    if (best < 0) return;
    this.state.setPlaying(false);
    this.state.setCursor(this.path.t.at(best));
    this.state.reveal();
  }

  /** A pole where a goal is meant; null takes it away. */
  showGoal(place: Point | null): void {
    this.goal.show(this.stage, place, this.floor.level, this.extent.reach);
    this.painter.invalidate();
  }

  private toolbar(): HTMLElement {
    return h("div.scene-toolbar",
      h("div.segments", { role: "group", "aria-label": "view" }, VIEWS.map((view, k) => h("button", {
        type: "button", "data-view": view, "aria-pressed": String(view === this.cameras.view), title: `${view} view (${k + 1})`, onclick: () => this.setView(view),
      }, view))),
      h("button.pill", { type: "button", "data-follow": "", "aria-pressed": "false", title: "follow the vehicle (f)", onclick: () => this.setFollowing(!this.following) }, "follow"));
  }

  // ---- drawing

  private draw(renderer: WebGLRenderer): void {
    const { camera } = this.cameras;
    this.craft.scale(this.cameras.perPixel(this.craft.position));
    renderer.render(this.stage, camera);
    this.drawn.frames++;
    this.element.dataset.drawn = "true";
    this.labels.place(camera, (label) => this.layers.shown(label.layer) && !this.movers.hides(label));
    const ahead = camera.getWorldDirection(new Vector3());
    const azimuth = Math.abs(ahead.y) > 0.999 ? this.cameras.controls!.getAzimuthalAngle() : Math.atan2(-ahead.x, -ahead.z);
    this.needle.setAttribute("transform", `rotate(${(azimuth * 180) / Math.PI})`);
  }

  /** At once, in the colours and the size of now. */
  drawNow(): void {
    this.rebuild();
    this.resize();
    this.painter.finely();
  }

  /** Give the graphics card back. */
  end(): void {
    this.cameras.end();
    clearTimeout(this.rebuildSoon);
    this.stage.children.slice().forEach(dispose);
    this.painter.end();
  }
}
