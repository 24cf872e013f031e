/** The flight in space: what is drawn when, the cameras, and what a pointer does in it. */

import {
  AmbientLight, BufferAttribute, Color, DirectionalLight, Euler, Group, HemisphereLight, Line, Mesh, Object3D, OrthographicCamera, PerspectiveCamera,
  RingGeometry, Scene as Stage, SphereGeometry, SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { Cameras, VIEWS, type View } from "./cameras";
import { decode, Track, type MoverJson, type PlanJson, type Point, type SceneJson } from "./data";
import { colour, h, svg } from "./dom";
import { clock, fixed, number } from "./format";
import { fat, flat3, thin, trail, TRAIL } from "./lines";
import { RAMP_CSS, ramp, roundUp } from "./ramp";
import { boundsFrame, dispose, fenceCurtain, glowing, ground, obstacle, segments, solid, toThree, vehicle, VEHICLE_SPAN, type Ground } from "./solids";
import type { State } from "./state";

const MOST_VERTICES = 6000, MOST_IN_SOFTWARE = 1500; // of a line; each costs the processor a few microseconds a frame
const CLICK_PX = 5;
const TRAIL_S = 3; // [s]
type ColourBy = "error" | "speed" | "height" | "time";

interface Layer { name: string; label: string; tone: string; shown: boolean; group: Group }
interface Tag { element: HTMLElement; at: Vector3; layer?: string }
interface Moving { json: MoverJson; track: Track; object: Object3D; trail: Line; tag: Tag }
interface Way { t: number; kind: string; points: Float64Array | Float32Array }

export class FlightScene {
  readonly element: HTMLElement;
  /** What is in it, for those who look after it: counts of things drawn. */
  readonly drawn = { vertices: 0, obstacles: 0, plans: 0, movers: 0, frames: 0 };
  following = false;
  /** Called with (north, east) when the ground is clicked while a goal is asked for. */
  onGoal: ((north: number, east: number) => void) | null = null;

  private readonly stage = new Stage();
  private readonly renderer: WebGLRenderer | null;
  private readonly canvas = h<HTMLCanvasElement>("canvas.scene-canvas", { tabindex: 0, "aria-label": "3D scene: drag to turn, wheel to zoom, right drag to move" });
  readonly cameras = new Cameras(this.canvas, () => this.invalidate());
  private readonly overlay = h("div.scene-tags", { "aria-hidden": "true" });
  private readonly compass: SVGElement;
  private readonly needle: SVGElement;
  private readonly ends = h("span.legend-ends");
  private readonly layerBar = h("div.layers");
  private readonly readout = h("div.readouts");
  private readonly layers = new Map<string, Layer>();
  private tags: Tag[] = [];
  private moving: Moving[] = [];
  private ways: Way[] = [];
  private waysShown: (Way | undefined)[] = [];
  private craft = vehicle();
  private shadow = new Group();
  private ghost: Object3D = new Object3D();
  private goal: Object3D | null = null;
  private path = new Track();
  private truth = new Track();
  private reference = new Track();
  private kept: number[] = []; // indices of the path's drawn vertices
  private floor: Ground | null = null;
  private reach = 10;
  private colourBy: ColourBy = "error";
  private json: SceneJson;
  private waiting = false;
  private sized = false;
  private soft = false;
  private moving3d = false; // drawn coarsely, since more frames are coming
  private late = 0; // how late frames come, smoothed [ms]
  private settling = 0;
  private pose: Record<string, number> | null = null;
  private rebuildSoon = 0;
  private layersShown = "";

  constructor(json: SceneJson, private readonly state: State, private readonly live: boolean) {
    this.json = json;
    this.needle = svg("g", {}, svg("path", { d: "M0 -13 L5 2 L0 -1 L-5 2z", class: "needle" }), svg("text", { x: 0, y: -15.5, class: "north" }, "N"));
    this.compass = svg("svg", { viewBox: "-28 -28 56 56", width: 56, height: 56, class: "compass" }, svg("circle", { r: 26, class: "dial" }), this.needle);
    let renderer: WebGLRenderer | null = null;
    try {
      this.soft = drawnInSoftware();
      renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !this.soft, alpha: true, preserveDrawingBuffer: true });
      renderer.debug.checkShaderErrors = false; // asking for them stalls the first frame
    } catch {
      // no WebGL: the rest of the page stands without it
    }
    this.renderer = renderer;
    this.element = h("div.scene", { "data-scene": renderer ? "webgl" : "none" }, renderer
      ? [this.canvas, this.overlay, this.toolbar(), this.compass as unknown as HTMLElement, this.colourLegend()]
      : h("p.no-webgl", "This browser draws no WebGL, so there is no 3D scene. Everything else is here."));
    if (renderer) this.begin(renderer);
    this.load(json);
    if (renderer) this.cameras.reset();
    state.on("cursor", () => this.moveCursor());
    state.on("theme", () => this.rebuild());
  }

  /** What stands under the scene: which layers are shown, and the numbers at the cursor. */
  get below(): HTMLElement[] {
    return this.renderer ? [this.layerBar, this.readout] : [this.readout];
  }

  // ---- what is drawn

  private layer(name: string, label: string, tone: string, shown = true): Group {
    let layer = this.layers.get(name);
    if (!layer) {
      layer = { name, label, tone, shown, group: new Group() };
      this.layers.set(name, layer);
      this.stage.add(layer.group);
    }
    for (const child of [...layer.group.children]) dispose(child);
    layer.group.visible = layer.shown;
    return layer.group;
  }

  private load(json: SceneJson): void {
    this.json = json;
    this.path = new Track(json.path);
    this.truth = new Track(json.truth);
    this.reference = new Track(json.reference);
    this.ways = (json.plans ?? []).map(way);
    this.moving = (json.movers ?? []).map(moving);
    this.rebuild();
  }

  /** Fields that replace those of before. */
  replace(more: Partial<SceneJson>): void {
    const { path, truth, reference } = this;
    this.json = { ...this.json, ...more };
    if (more.path) this.path = new Track(more.path); else this.path = path;
    if (more.truth) this.truth = new Track(more.truth); else this.truth = truth;
    if (more.reference) this.reference = new Track(more.reference); else this.reference = reference;
    if (more.plans) this.ways = more.plans.map(way);
    if (more.movers) this.moving = more.movers.map(moving);
    this.rebuild();
  }

  append(more: {
    path?: number[][]; truth?: number[][]; reference?: number[][]; plans?: PlanJson[]; movers?: MoverJson[]; pose?: Record<string, number>;
  }): void {
    if (more.path) this.path.append(more.path);
    if (more.truth) this.truth.append(more.truth);
    if (more.reference) this.reference.append(more.reference);
    if (more.pose) this.pose = more.pose;
    if (more.plans?.length) this.ways.push(...more.plans.map(way));
    if (this.ways.length > 400) this.ways.splice(0, this.ways.length - 200);
    let fresh = false;
    for (const mover of more.movers ?? []) {
      const known = this.moving.find((m) => m.json.id === mover.id);
      if (!known) {
        this.moving.push(moving(mover));
        fresh = true;
      } else for (const name of ["t", "n", "e", "u"] as const) known.track[name].push(decode(mover[name]).view());
    }
    if (fresh) this.rebuildMovers();
    if ((more.path || more.truth || more.reference) && !this.rebuildSoon) {
      this.rebuildSoon = window.setTimeout(() => {
        this.rebuildSoon = 0;
        if (this.outgrown()) {
          this.rebuild();
          if (!this.cameras.turned) this.cameras.reset();
          return;
        }
        this.rebuildPath();
        this.fillLayerBar();
        this.moveCursor();
      }, 250);
    }
    this.moveCursor();
  }

  /** Whether the flight has left the ground that is drawn. */
  private outgrown(): boolean {
    const last = this.path.length - 1, floor = this.floor!;
    if (last < 0) return false;
    const n = this.path.n.at(last), e = this.path.e.at(last);
    return n < floor.low[0] || n > floor.high[0] || e < floor.low[1] || e > floor.high[1];
  }

  lastTime(): number {
    return this.path.length ? this.path.t.at(this.path.length - 1) : 0;
  }

  firstTime(): number {
    return this.path.length ? this.path.t.at(0) : 0;
  }

  private rebuild(): void {
    this.overlay.replaceChildren();
    this.tags = [];
    this.measure();
    this.rebuildStanding();
    this.rebuildPath();
    this.rebuildMovers();
    this.rebuildCraft();
    this.waysShown = [];
    this.fillLayerBar();
    this.moveCursor();
  }

  /** How large the scene is: the flight, and the world's bounds where they are of its size. */
  private measure(): void {
    const low: Point = [Infinity, Infinity, Infinity], high: Point = [-Infinity, -Infinity, -Infinity];
    const take = (p: ArrayLike<number>) => {
      for (let k = 0; k < 3; k++) {
        if (p[k] < low[k]) low[k] = p[k];
        if (p[k] > high[k]) high[k] = p[k];
      }
    };
    for (const track of [this.path, this.reference, this.truth]) {
      const stride = Math.max(1, Math.floor(track.length / 2000));
      for (let i = 0; i < track.length; i += stride) take([track.n.at(i), track.e.at(i), track.u.at(i)]);
    }
    for (const plan of this.ways.slice(0, 50)) for (let i = 0; i + 2 < plan.points.length; i += 3) take(plan.points.subarray(i, i + 3));
    const flown = Number.isFinite(low[0]) ? Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
    const { bounds } = this.json;
    if (bounds && (!flown || Math.max(bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1]) < 4 * flown + 20)) {
      take(bounds[0]);
      take(bounds[1]);
    }
    if (!Number.isFinite(low[0])) {
      take([-5, -5, 0]);
      take([5, 5, 3]);
    }
    const floor = bounds ? bounds[0][2] : Math.min(0, low[2]);
    for (let k = 0; k < 2; k++) {
      if (high[k] - low[k] >= 4) continue;
      const middle = (low[k] + high[k]) / 2;
      [low[k], high[k]] = [middle - 2, middle + 2];
    }
    this.floor = ground([low[0], low[1]], [high[0], high[1]], floor);
    low[2] = Math.min(low[2], floor);
    const centre = toThree([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2]);
    this.reach = Math.max(4, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    this.cameras.measured({ centre, reach: this.reach, box: [toThree(low), toThree(high)], floor: this.floor });
  }

  private rebuildStanding(): void {
    const floor = this.floor!;
    this.layer("ground", "", "").add(floor.object);
    const label = (n: number, e: number, text: string, kind = "tick") => this.tag(text, toThree([n, e, floor.level]), kind);
    const off = 0.035 * this.reach;
    const every = floor.step * Math.max(1, Math.ceil((floor.high[0] - floor.low[0]) / floor.step / 6));
    for (let n = floor.low[0]; n <= floor.high[0] + 1e-6; n += every) label(n, floor.low[1] - off, number(round(n)));
    for (let e = floor.low[1]; e <= floor.high[1] + 1e-6; e += every) label(floor.low[0] - off, e, number(round(e)));
    label((floor.low[0] + floor.high[0]) / 2, floor.low[1] - 3 * off, "north [m]", "axis");
    label(floor.low[0] - 2.6 * off, (floor.low[1] + floor.high[1]) / 2, "east [m]", "axis");

    const { obstacles, bounds, fence, least } = this.json;
    const standing = obstacles.filter((o) => o.kind !== "cells"), mapped = obstacles.filter((o) => o.kind === "cells");
    const solids = this.layer("obstacles", "obstacles", "solid");
    standing.forEach((o) => solids.add(obstacle(o)));
    const cells = this.layer("cells", "map", "cells");
    mapped.forEach((o) => cells.add(obstacle(o)));
    this.drawn.obstacles = obstacles.length;
    const box = this.layer("bounds", "bounds", "ink-3");
    if (bounds) box.add(boundsFrame(...bounds));
    const rim = this.layer("fence", "fence", "bad");
    if (fence?.length) rim.add(fenceCurtain(fence, floor.level, bounds ? bounds[1][2] : floor.level + Math.max(3, this.reach / 8)));
    const mark = this.layer("least", "least clearance", "warn");
    if (least) {
      const at = toThree(least.at);
      const size = Math.max(0.12, this.reach / 160);
      const ball = new Mesh(new SphereGeometry(size, 20, 14), glowing("warn"));
      ball.position.copy(at);
      mark.add(ball, segments([at.x, floor.level, at.z, at.x, at.y, at.z], "warn", 0.7));
      const tag = this.tag(`${number(least.clearance, 3)} m clear`, at, "least", "least");
      tag.element.title = `least clearance, at ${clock(least.t)}`;
      tag.element.addEventListener("click", () => this.state.setCursor(least.t));
    }
    this.stage.children.filter((c) => c.userData.light).forEach((c) => c.removeFromParent());
    const dark = document.documentElement.dataset.theme === "dark";
    const sky = new HemisphereLight(0xffffff, dark ? 0x334 : 0x99a, dark ? 1.6 : 2.0), sun = new DirectionalLight(0xffffff, 1.2), all = new AmbientLight(0xffffff, 0.6);
    sun.position.set(0.5, 1, 0.8);
    for (const light of [sky, sun, all]) {
      light.userData.light = true;
      this.stage.add(light);
    }
  }

  private tag(text: string, at: Vector3, kind: string, layer?: string): Tag {
    const tag = { element: h(`span.tag.${kind}`, text), at, layer };
    this.overlay.append(tag.element);
    this.tags.push(tag);
    return tag;
  }

  private thinned(track: Track): number[] {
    return thin(track, this.reach, this.soft ? MOST_IN_SOFTWARE : MOST_VERTICES);
  }

  private rebuildPath(): void {
    const flown = this.layer("path", "flown", "ink-2");
    const reference = this.layer("reference", "reference", "ink-3", true);
    const truth = this.layer("truth", "truth", "s2", false);
    this.kept = this.thinned(this.path);
    const { values, high, unit } = this.colouring();
    if (this.kept.length > 1) {
      const neutral = new Color(colour("ink-3"));
      const colours = new Float32Array(3 * this.kept.length), positions = new Float32Array(3 * this.kept.length), c = new Color();
      this.kept.forEach((i, k) => {
        positions.set([this.path.e.at(i), this.path.u.at(i), -this.path.n.at(i)], 3 * k);
        if (Number.isFinite(values[k])) c.setRGB(...ramp(values[k] / high), SRGBColorSpace);
        else c.copy(neutral);
        colours.set([c.r, c.g, c.b], 3 * k);
      });
      flown.add(fat(positions, colours, 4));
      const ends = this.path.length - 1;
      const start = toThree([this.path.n.at(0), this.path.e.at(0), this.path.u.at(0)]), end = toThree([this.path.n.at(ends), this.path.e.at(ends), this.path.u.at(ends)]);
      this.tags = this.tags.filter((t) => t.layer !== "path" || (t.element.remove(), false));
      this.tag("start", start, "place", "path");
      if (!this.live) this.tag("end", end, "place", "path");
    }
    for (const [track, group, tone, dashed] of [[this.reference, reference, "ink-2", true], [this.truth, truth, "s2", false]] as const) {
      const kept = this.thinned(track);
      if (kept.length < 2) continue;
      const dash = dashed ? this.reach / 120 : 0;
      group.add(fat(flat3(track, kept), colour(tone), 1.6, 0.8, dash));
    }
    this.drawn.vertices = this.kept.length;
    this.ends.replaceChildren(h("span", "0"), h("span", `${this.colourBy === "time" ? clock(high, 0) : number(high)}${unit}`));
    this.invalidate();
  }

  private colouring(): { values: number[]; high: number; unit: string } {
    const by = this.colourBy;
    let values: number[];
    let unit = " m";
    if (by === "time") {
      values = this.kept.map((i) => this.path.t.at(i));
      unit = "";
      return { values, high: Math.max(1e-6, this.state.full[1]), unit };
    }
    if (by === "height") {
      const floor = this.floor!.level;
      values = this.kept.map((i) => this.path.u.at(i) - floor);
    } else if (by === "speed") {
      values = this.kept.map((i) => this.speedAt(this.path.t.at(i)));
      unit = " m/s";
    } else values = this.kept.map((i) => this.errorAt(this.path.t.at(i)));
    const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
    return { values, high: roundUp(sorted[Math.floor(0.99 * (sorted.length - 1))] ?? 1), unit };
  }

  private speedAt(moment: number): number {
    const t = Math.max(this.firstTime(), Math.min(this.lastTime(), moment));
    const a = this.path.at(t - 0.1), b = this.path.at(t + 0.1);
    const first = this.firstTime(), last = this.lastTime();
    const span = Math.min(last, t + 0.1) - Math.max(first, t - 0.1);
    return a && b && span > 0 ? Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / span : NaN;
  }

  /** How far from where it should be: told, or the distance to the reference at the same time. */
  private errorAt(t: number): number {
    if (this.path.error.length) return this.path.value(this.path.error, t);
    const count = this.reference.length;
    if (!count || t < this.reference.t.at(0) - 0.1 || t > this.reference.t.at(count - 1) + 0.1) return NaN;
    const a = this.path.at(t), b = this.reference.at(t);
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) : NaN;
  }

  private rebuildMovers(): void {
    const group = this.layer("movers", "movers", "mover");
    this.tags = this.tags.filter((t) => t.layer !== "movers" || (t.element.remove(), false));
    for (const mover of this.moving) {
      const object = new Mesh(new SphereGeometry(mover.json.radius, 24, 16), solid("mover", 0.6));
      mover.object = object;
      mover.tag = this.tag(this.moving.length > 12 ? "" : mover.json.id, object.position, "mover", "movers");
      group.add(object);
      mover.trail = trail();
      group.add(mover.trail);
    }
    this.drawn.movers = this.moving.length;
    this.fillLayerBar();
  }

  private rebuildCraft(): void {
    dispose(this.craft);
    dispose(this.shadow);
    dispose(this.ghost);
    this.craft = vehicle();
    this.craft.rotation.order = "YXZ";
    this.shadow = new Group();
    const spot = new Mesh(new RingGeometry(0.16, 0.24, 40), glowing("accent", 0.75));
    spot.rotation.x = -Math.PI / 2;
    this.shadow.add(spot, segments([0, 0, 0, 0, 1, 0], "accent", 0.55));
    this.ghost = new Mesh(new SphereGeometry(0.07, 16, 12), glowing("ink-2", 0.8));
    this.stage.add(this.craft, this.shadow, this.ghost);
  }

  // ---- what the cursor moves

  private moveCursor(): void {
    const t = this.state.cursor;
    const newest = this.live && this.state.follow && this.pose;
    const at: Point | null = newest ? [newest.n, newest.e, newest.u] : this.path.at(t);
    this.craft.visible = this.shadow.visible = !!at;
    if (at) {
      const place = toThree(at);
      this.craft.position.copy(place);
      const angle = (name: "roll" | "pitch" | "yaw") => (newest ? newest[name] : this.path.value(this.path[name], t)) || 0;
      this.craft.setRotationFromEuler(new Euler(angle("pitch"), -angle("yaw"), -angle("roll"), "YXZ"));
      const level = this.floor!.level;
      this.shadow.position.set(place.x, level, place.z);
      this.shadow.children[1].scale.y = Math.max(1e-3, place.y - level);
      const { controls } = this.cameras;
      if (this.following && controls) {
        const shift = place.clone().sub(controls.target);
        controls.target.add(shift);
        controls.object.position.add(shift);
      }
    }
    const should = this.reference.length && t >= this.reference.t.at(0) && t <= this.reference.t.at(this.reference.length - 1) + 0.2 ? this.reference.at(t) : null;
    this.ghost.visible = !!should && (this.layers.get("reference")?.shown ?? true);
    if (should) this.ghost.position.copy(toThree(should));
    for (const mover of this.moving) {
      const { track } = mover, last = track.length - 1;
      const place = track.at(t);
      mover.object.visible = !!place && t >= track.t.at(0) - 0.5 && t <= track.t.at(last) + 1.5;
      mover.trail.visible = mover.object.visible;
      if (!place || !mover.object.visible) continue;
      mover.object.position.copy(toThree(place));
      const points = mover.trail.geometry.getAttribute("position") as BufferAttribute;
      for (let k = 0; k < TRAIL; k++) {
        const [n, e, u] = track.at(Math.max(track.t.at(0), t - (TRAIL_S * k) / (TRAIL - 1)))!;
        points.setXYZ(k, e, u, -n);
      }
      points.needsUpdate = true;
    }
    this.showWays(t);
    this.fillReadout(t, at);
    this.invalidate();
  }

  /** The plan that was flown at that moment, and the stop kept ready. */
  private showWays(t: number): void {
    let plan: Way | undefined, backup: Way | undefined;
    for (const w of this.ways) {
      if (w.t > t + 1e-6) continue;
      if (w.kind === "backup") backup = w;
      else plan = w;
    }
    plan ??= this.ways.find((w) => w.kind !== "backup");
    if (this.waysShown[0] === plan && this.waysShown[1] === backup && this.waysShown.length) return;
    this.waysShown = [plan, backup];
    const planned = this.layer("plan", "plan", "plan"), stop = this.layer("backup", "stop kept ready", "warn");
    const draw = (w: Way | undefined, group: Group, tone: string, linewidth: number) => {
      if (!w || w.points.length < 6) return;
      const positions = new Float32Array(w.points.length);
      for (let i = 0; i + 2 < w.points.length; i += 3) positions.set([w.points[i + 1], w.points[i + 2], -w.points[i]], i);
      group.add(fat(positions, colour(tone), linewidth, 0.9));
    };
    draw(plan, planned, "plan", 2.4);
    draw(backup, stop, "warn", 2);
    this.drawn.plans = Number(!!plan) + Number(!!backup);
  }

  private fillReadout(t: number, at: Point | null): void {
    const yaw = this.path.value(this.path.yaw, t);
    const values: [string, string, string][] = at ? [
      ["north", fixed(at[0], 2), "m"], ["east", fixed(at[1], 2), "m"], ["up", fixed(at[2], 2), "m"],
      ["speed", fixed(this.speedAt(t), 2), "m/s"], ["error", fixed(this.errorAt(t), 3), "m"],
      ["heading", Number.isFinite(yaw) ? fixed((((yaw * 180) / Math.PI) % 360 + 360) % 360, 0) : "–", "°"],
    ] : [];
    if (this.readout.children.length !== values.length) {
      this.readout.replaceChildren(...values.map(([name, , unit]) => h("div.readout-item", h("span.name", name), h("span.value"), h("span.unit", unit))));
    }
    values.forEach(([, text], k) => (this.readout.children[k].children[1].textContent = text));
  }

  // ---- cameras and pointers

  private begin(renderer: WebGLRenderer): void {
    renderer.setPixelRatio(this.ratio());
    new ResizeObserver(() => this.resize()).observe(this.element);
    let down: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY }));
    this.canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < CLICK_PX) this.click(event);
      down = null;
    });
    this.canvas.addEventListener("dblclick", () => this.cameras.reset());
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.rebuild());
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!this.renderer || !width || !height) return;
    this.renderer.setSize(width, height, false);
    this.cameras.resize(width, height);
    if (!this.sized) this.cameras.reset();
    this.sized = true;
    this.invalidate();
  }

  setView(view: View): void {
    if (!this.renderer) return;
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
    let best = -1, least = event.pointerType === "mouse" ? 18 : 30;
    for (const i of this.kept) {
      const [x, y] = this.cameras.screenOf([this.path.n.at(i), this.path.e.at(i), this.path.u.at(i)]);
      const away = Math.hypot(x - event.clientX, y - event.clientY);
      if (away < least) [best, least] = [i, away];
    }
    if (best < 0) return;
    this.state.setPlaying(false);
    this.state.setCursor(this.path.t.at(best));
    this.state.reveal();
  }

  /** A pole where a goal is meant; null takes it away. */
  showGoal(place: Point | null): void {
    if (this.goal) dispose(this.goal);
    this.goal = null;
    if (place) {
      const at = toThree(place), level = this.floor!.level;
      this.goal = new Group();
      const size = Math.max(0.3, this.reach / 70);
      const ring = new Mesh(new RingGeometry(size, 1.4 * size, 48), glowing("accent"));
      ring.rotation.x = -Math.PI / 2;
      ring.position.set(at.x, level + 0.01, at.z);
      const ball = new Mesh(new SphereGeometry(0.55 * size, 20, 14), glowing("accent"));
      ball.position.copy(at);
      this.goal.add(ring, ball, segments([at.x, level, at.z, at.x, at.y, at.z], "accent"));
      this.stage.add(this.goal);
    }
    this.invalidate();
  }

  /** At once, in the colours and the size of now. */
  drawNow(): void {
    this.moving3d = false;
    this.rebuild();
    this.resize();
    this.render();
  }

  /** Give the graphics card back. */
  end(): void {
    this.cameras.end();
    clearTimeout(this.settling);
    clearTimeout(this.rebuildSoon);
    this.stage.children.slice().forEach(dispose);
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }

  // ---- controls on top of it

  private toolbar(): HTMLElement {
    return h("div.scene-toolbar",
      h("div.segments", { role: "group", "aria-label": "view" }, VIEWS.map((view, k) => h("button", {
        type: "button", "data-view": view, "aria-pressed": String(view === this.cameras.view), title: `${view} view (${k + 1})`, onclick: () => this.setView(view),
      }, view))),
      h("button.pill", { type: "button", "data-follow": "", "aria-pressed": "false", title: "follow the vehicle (f)", onclick: () => this.setFollowing(!this.following) }, "follow"));
  }

  /** What the path's colour means, and the choice of it. */
  private colourLegend(): HTMLElement {
    const by = h<HTMLSelectElement>("select", {
      "aria-label": "colour of the path", title: "colour of the path",
      onchange: () => {
        this.colourBy = by.value as ColourBy;
        this.rebuildPath();
      },
    }, (["error", "speed", "height", "time"] as const).map((name) => h("option", { value: name }, name === "error" ? "tracking error" : name)));
    return h("div.colour-legend", by, h("span.ramp", { style: { "background-image": RAMP_CSS } }), this.ends);
  }

  private fillLayerBar(): void {
    const order = ["path", "reference", "truth", "plan", "backup", "obstacles", "cells", "movers", "fence", "bounds", "least"];
    const present: Record<string, boolean> = {
      path: this.path.length > 1, reference: this.reference.length > 1, truth: this.truth.length > 1, plan: this.ways.some((w) => w.kind !== "backup"),
      backup: this.ways.some((w) => w.kind === "backup"), movers: this.moving.length > 0, fence: !!this.json.fence?.length, bounds: !!this.json.bounds,
      least: !!this.json.least, obstacles: this.json.obstacles.some((o) => o.kind !== "cells"), cells: this.json.obstacles.some((o) => o.kind === "cells"),
    };
    const shown = order.filter((name) => present[name]);
    if (this.layersShown === String(shown)) return;
    this.layersShown = String(shown);
    this.layer("plan", "plan", "plan");
    this.layer("backup", "stop kept ready", "warn");
    this.waysShown = [];
    this.layerBar.replaceChildren(...shown.map((name) => {
      const layer = this.layers.get(name)!;
      return h("button.chip", {
        type: "button", "aria-pressed": String(layer.shown), "data-layer": name,
        onclick: (event: Event) => {
          layer.shown = !layer.shown;
          layer.group.visible = layer.shown;
          (event.currentTarget as HTMLElement).setAttribute("aria-pressed", String(layer.shown));
          this.moveCursor();
        },
      }, h("span.swatch", { style: { background: name === "path" ? RAMP_CSS : `var(--${layer.tone})` } }), layer.label);
    }));
  }

  // ---- drawing, only when something moved

  /**
   * Without a graphics card a frame costs tens of milliseconds, most of it by the pixel: while things move they are
   * drawn coarsely, and once more finely when they stand. A card that falls behind is treated likewise.
   */
  private ratio(): number {
    const fine = this.soft ? 2 : Math.min(2, devicePixelRatio);
    return this.moving3d ? Math.min(fine, this.soft ? 0.8 : 1) : fine;
  }

  invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    const asked = performance.now();
    requestAnimationFrame(() => {
      this.waiting = false;
      this.late += 0.2 * (Math.min(500, performance.now() - asked) - this.late);
      clearTimeout(this.settling);
      if (this.drawn.frames > 2 && (this.soft || this.late > 60)) {
        this.moving3d = true;
        this.settling = window.setTimeout(() => {
          this.moving3d = false;
          this.render();
        }, 300);
      }
      this.render();
    });
  }

  private render(): void {
    if (!this.renderer) return;
    if (this.renderer.getPixelRatio() !== this.ratio()) this.renderer.setPixelRatio(this.ratio());
    const { camera } = this.cameras;
    const perPixel = this.cameras.perPixel(this.craft.position);
    const scale = Math.max(1, (38 * perPixel) / VEHICLE_SPAN); // never smaller than 38 px
    this.craft.scale.setScalar(scale);
    this.shadow.children[0]?.scale.setScalar(scale);
    this.ghost.scale.setScalar(scale);
    this.renderer.render(this.stage, camera);
    this.drawn.frames++;
    this.element.dataset.drawn = "true";
    this.placeTags(camera);
    const ahead = new Vector3();
    camera.getWorldDirection(ahead);
    const azimuth = Math.abs(ahead.y) > 0.999 ? this.cameras.controls!.getAzimuthalAngle() : Math.atan2(-ahead.x, -ahead.z);
    this.needle.setAttribute("transform", `rotate(${(azimuth * 180) / Math.PI})`);
  }

  private placeTags(camera: PerspectiveCamera | OrthographicCamera): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    const p = new Vector3(), ahead = camera.getWorldDirection(new Vector3());
    const sideways = Math.abs(ahead.y) < 0.05;
    for (const { element, at, layer } of this.tags) {
      const mover = layer === "movers" && this.moving.find((m) => m.tag.element === element);
      const shown = (!layer || this.layers.get(layer)!.shown) && (!mover || mover.object.visible) && !(sideways && element.matches(".tick, .axis"));
      p.copy(at).project(camera);
      const inside = shown && p.z > -1 && p.z < 1 && Math.abs(p.x) < 1.05 && Math.abs(p.y) < 1.05;
      element.hidden = !inside;
      if (inside) element.style.transform = `translate(${((p.x + 1) / 2) * width}px, ${((1 - p.y) / 2) * height}px) translate(-50%, -50%)`;
    }
  }
}

/** Whether WebGL is the processor's work here. */
function drawnInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function moving(json: MoverJson): Moving {
  return { json, track: new Track(json), object: new Object3D(), trail: trail(), tag: null as unknown as Tag };
}

function way(json: PlanJson): Way {
  return { t: json.t, kind: json.kind, points: decode(json.points).view() };
}

function round(value: number): number {
  return Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(6));
}
