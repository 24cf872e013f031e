/** The flight in space: what is drawn when, the cameras, and what a pointer does in it. */

import {
  AmbientLight, BufferAttribute, BufferGeometry, DirectionalLight, Euler, Group, HemisphereLight, Line, LineBasicMaterial, MOUSE, Mesh, Object3D, OrthographicCamera,
  PerspectiveCamera, Plane, Raycaster, RingGeometry, Scene as Stage, SphereGeometry, Vector2, Vector3, WebGLRenderer, Color, SRGBColorSpace,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { decode, Track, type MoverJson, type PlanJson, type Point, type SceneJson } from "./data";
import { colour, h, svg } from "./dom";
import { clock, fixed, number } from "./format";
import { RAMP_CSS, ramp, roundUp } from "./ramp";
import { boundsFrame, dispose, fenceCurtain, glowing, ground, obstacle, segments, solid, toThree, vehicle, VEHICLE_SPAN, type Ground } from "./solids";
import type { State } from "./state";

const MOST_VERTICES = 6000, MOST_IN_SOFTWARE = 1500; // of a line; each costs the processor a few microseconds a frame
const CLICK_PX = 5;
const TRAIL = 24, TRAIL_S = 3;
const VIEWS = ["3D", "top", "side"] as const;
export type View = (typeof VIEWS)[number];
type ColourBy = "error" | "speed" | "height" | "time";

interface Layer { name: string; label: string; tone: string; shown: boolean; group: Group }
interface Tag { element: HTMLElement; at: Vector3; layer?: string }
interface Moving { json: MoverJson; track: Track; object: Object3D; trail: Line; tag: Tag }
interface Way { t: number; kind: string; points: Float64Array | Float32Array }

export class FlightScene {
  readonly element: HTMLElement;
  /** What is in it, for those who look after it: counts of things drawn. */
  readonly drawn = { vertices: 0, obstacles: 0, plans: 0, movers: 0, frames: 0 };
  view: View = "3D";
  following = false;
  /** Called with (north, east) when the ground is clicked while a goal is asked for. */
  onGoal: ((north: number, east: number) => void) | null = null;

  private readonly stage = new Stage();
  private readonly renderer: WebGLRenderer | null;
  private readonly perspective = new PerspectiveCamera(38, 1, 0.05, 5000);
  private readonly flat = new OrthographicCamera(-1, 1, 1, -1, -5000, 5000);
  private controls: OrbitControls | null = null;
  private readonly canvas = h<HTMLCanvasElement>("canvas.scene-canvas", { tabindex: 0, "aria-label": "3D scene: drag to turn, wheel to zoom, right drag to move" });
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
  private centre = new Vector3();
  private reach = 10;
  private box: [Vector3, Vector3] = [new Vector3(), new Vector3()];
  private colourBy: ColourBy = "error";
  private json: SceneJson;
  private waiting = false;
  private side = 0;
  private sized = false;
  private soft = false;
  private turned = false; // the camera is where a person put it
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
    this.resetCamera();
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
          if (!this.turned) this.resetCamera();
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
    this.centre = toThree([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2]);
    this.box = [toThree(low), toThree(high)];
    this.reach = Math.max(4, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    Object.assign(this.perspective, { near: this.reach / 1500, far: this.reach * 60 }).updateProjectionMatrix();
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
      if (this.following && this.controls) {
        const shift = place.clone().sub(this.controls.target);
        this.controls.target.add(shift);
        this.controls.object.position.add(shift);
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
    const camera = (object: PerspectiveCamera | OrthographicCamera) => {
      this.controls?.dispose();
      const controls = new OrbitControls(object, this.canvas);
      controls.zoomToCursor = true;
      controls.maxDistance = 4000;
      controls.minDistance = 0.5;
      controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      controls.addEventListener("change", () => this.invalidate());
      controls.addEventListener("start", () => (this.turned = true));
      this.controls = controls;
    };
    camera(this.perspective);
    this.useCamera = camera;
    new ResizeObserver(() => this.resize()).observe(this.element);
    let down: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY }));
    this.canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < CLICK_PX) this.click(event);
      down = null;
    });
    this.canvas.addEventListener("dblclick", () => this.resetCamera());
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.rebuild());
  }

  private useCamera: (object: PerspectiveCamera | OrthographicCamera) => void = () => undefined;

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!this.renderer || !width || !height) return;
    this.renderer.setSize(width, height, false);
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    if (!this.sized) this.resetCamera();
    this.sized = true;
    this.frameFlat();
    this.invalidate();
  }

  private frameFlat(): void {
    const aspect = (this.element.clientWidth || 1) / (this.element.clientHeight || 1);
    const floor = this.floor!;
    const wide = (this.view === "side" && this.side === 1 ? floor.high[0] - floor.low[0] : floor.high[1] - floor.low[1]) * 1.3;
    const tall = (this.view === "top" ? floor.high[0] - floor.low[0] : this.reach * 0.3) * 1.3;
    const height = Math.max(tall, wide / aspect) / 2;
    Object.assign(this.flat, { left: -height * aspect, right: height * aspect, top: height, bottom: -height });
    this.flat.updateProjectionMatrix();
  }

  setView(view: View): void {
    this.side = view === "side" && this.view === "side" ? 1 - this.side : 0;
    this.view = view;
    this.resetCamera();
    for (const button of this.element.querySelectorAll<HTMLElement>("[data-view]")) button.setAttribute("aria-pressed", String(button.dataset.view === view));
  }

  resetCamera(): void {
    if (!this.controls) return;
    this.turned = false;
    this.useCamera(this.view === "3D" ? this.perspective : this.flat);
    const { centre, reach, controls } = this;
    if (this.view === "3D") {
      controls.target.copy(this.fit(new Vector3(-0.42, 0.66, 0.9).normalize()));
    } else {
      const away = this.view === "top" ? new Vector3(0, 1, 1e-4) : this.side ? new Vector3(1, 0.0001, 0) : new Vector3(0, 0.0001, 1);
      this.flat.position.copy(centre).addScaledVector(away, reach * 3);
      this.flat.zoom = 1;
      this.frameFlat();
      controls.target.copy(centre);
    }
    controls.update();
    this.invalidate();
  }

  /** Put the perspective camera so far off in a direction that the whole box is seen, and in the middle; gives the target. */
  private fit(direction: Vector3): Vector3 {
    const { perspective: camera, box, reach } = this;
    const target = this.centre.clone();
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new Vector3(box[k & 1].x, box[(k >> 1) & 1].y, box[(k >> 2) & 1].z));
    const spread = (far: number) => {
      camera.position.copy(target).addScaledVector(direction, far);
      camera.lookAt(target);
      camera.updateMatrixWorld();
      camera.updateProjectionMatrix();
      const seen = corners.map((c) => c.clone().project(camera));
      const [x, y] = [seen.map((p) => p.x), seen.map((p) => p.y)];
      return { low: [Math.min(...x), Math.min(...y)], high: [Math.max(...x), Math.max(...y)], behind: seen.some((p) => p.z > 1 || p.z < -1) };
    };
    let far = 2 * reach;
    for (let turn = 0; turn < 4; turn++) {
      let [near, most] = [0.3 * reach, 8 * reach];
      for (let k = 0; k < 24; k++) {
        far = (near + most) / 2;
        const { low, high, behind } = spread(far);
        if (behind || high[0] - low[0] > 1.7 || high[1] - low[1] > 1.62) near = far;
        else most = far;
      }
      far = most;
      const { low, high } = spread(far);
      const height = far * Math.tan((camera.fov * Math.PI) / 360);
      const right = new Vector3().setFromMatrixColumn(camera.matrix, 0), up = new Vector3().setFromMatrixColumn(camera.matrix, 1);
      target.addScaledVector(right, ((low[0] + high[0]) / 2) * height * camera.aspect).addScaledVector(up, ((low[1] + high[1]) / 2) * height);
    }
    spread(far);
    return target;
  }

  zoom(factor: number): void {
    if (!this.controls) return;
    const camera = this.controls.object as PerspectiveCamera | OrthographicCamera;
    if (camera === this.flat) {
      this.flat.zoom = Math.max(0.02, Math.min(200, this.flat.zoom / factor));
      this.flat.updateProjectionMatrix();
    } else camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  /** Turn by angles [rad], as a drag would. */
  orbit(azimuth: number, elevation: number): void {
    if (!this.controls) return;
    const { object, target } = this.controls;
    const arm = object.position.clone().sub(target);
    const polar = Math.max(0.02, Math.min(Math.PI - 0.02, arm.angleTo(new Vector3(0, 1, 0)) - elevation));
    const turn = Math.atan2(arm.x, arm.z) + azimuth;
    object.position.copy(target).add(new Vector3().setFromSphericalCoords(arm.length(), polar, turn));
    this.controls.update();
    this.invalidate();
  }

  /** Move the camera sideways by shares of what it sees. */
  pan(right: number, up: number): void {
    if (!this.controls) return;
    const { object, target } = this.controls;
    const size = object === this.flat ? (this.flat.top - this.flat.bottom) / this.flat.zoom : object.position.distanceTo(target);
    const shift = new Vector3().setFromMatrixColumn(object.matrix, 0).multiplyScalar(right * size)
      .addScaledVector(new Vector3().setFromMatrixColumn(object.matrix, 1), up * size);
    object.position.add(shift);
    target.add(shift);
    this.controls.update();
    this.invalidate();
  }

  setFollowing(following: boolean): void {
    this.following = following;
    this.element.querySelector("[data-follow]")?.setAttribute("aria-pressed", String(following));
    this.moveCursor();
  }

  get focused(): boolean {
    return document.activeElement === this.canvas;
  }

  /** Where on the ground a pointer is (north, east); null beside it. */
  groundAt(clientX: number, clientY: number): [number, number] | null {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(pointer, this.controls!.object as PerspectiveCamera);
    const hit = ray.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -this.floor!.level), new Vector3());
    return hit ? [-hit.z, hit.x] : null;
  }

  /** Where a place is on the screen [px of the page's window]. */
  screenOf(place: Point): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const p = toThree(place).project(this.controls!.object as PerspectiveCamera);
    return [box.left + ((p.x + 1) / 2) * box.width, box.top + ((1 - p.y) / 2) * box.height];
  }

  private click(event: PointerEvent): void {
    if (this.onGoal) {
      const place = this.groundAt(event.clientX, event.clientY);
      if (place) this.onGoal(...place);
      return;
    }
    let best = -1, least = event.pointerType === "mouse" ? 18 : 30;
    for (const i of this.kept) {
      const [x, y] = this.screenOf([this.path.n.at(i), this.path.e.at(i), this.path.u.at(i)]);
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
    this.controls?.dispose();
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
        type: "button", "data-view": view, "aria-pressed": String(view === this.view), title: `${view} view (${k + 1})`, onclick: () => this.setView(view),
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
    if (!this.renderer || !this.controls) return;
    if (this.renderer.getPixelRatio() !== this.ratio()) this.renderer.setPixelRatio(this.ratio());
    const camera = this.controls.object as PerspectiveCamera | OrthographicCamera;
    const height = this.element.clientHeight || 1;
    const perPixel = camera === this.flat ? (this.flat.top - this.flat.bottom) / this.flat.zoom / height
      : (2 * Math.tan((this.perspective.fov * Math.PI) / 360) * camera.position.distanceTo(this.craft.position)) / height;
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
    const azimuth = Math.abs(ahead.y) > 0.999 ? this.controls.getAzimuthalAngle() : Math.atan2(-ahead.x, -ahead.z);
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

/** Where something was in the last seconds, paler with age. */
function trail(): Line {
  const geometry = new BufferGeometry(), tint = new Color(colour("mover"));
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * TRAIL), 3));
  geometry.setAttribute("color", new BufferAttribute(Float32Array.from({ length: 4 * TRAIL }, (_, i) =>
    i % 4 < 3 ? [tint.r, tint.g, tint.b][i % 4] : 0.8 * (1 - Math.floor(i / 4) / TRAIL)), 4));
  const line = new Line(geometry, new LineBasicMaterial({ vertexColors: true, transparent: true }));
  line.frustumCulled = false;
  return line;
}

function way(json: PlanJson): Way {
  return { t: json.t, kind: json.kind, points: decode(json.points).view() };
}

/** Indices of the vertices worth drawing: those that moved visibly, never more than a few thousand. */
function thin(track: Track, reach: number, most: number): number[] {
  const count = track.length, kept: number[] = [];
  let least = (reach / 1000) ** 2;
  for (;;) {
    kept.length = 0;
    let n = NaN, e = NaN, u = NaN;
    for (let i = 0; i < count; i++) {
      const [a, b, c] = [track.n.at(i), track.e.at(i), track.u.at(i)];
      if (Number.isNaN(a + b + c)) continue;
      const far = (a - n) ** 2 + (b - e) ** 2 + (c - u) ** 2;
      if (far < least && i < count - 1) continue;
      kept.push(i);
      [n, e, u] = [a, b, c];
    }
    if (kept.length <= most) return kept;
    least *= 2;
  }
}

function flat3(track: Track, kept: number[]): Float32Array {
  const positions = new Float32Array(3 * kept.length);
  kept.forEach((i, k) => positions.set([track.e.at(i), track.u.at(i), -track.n.at(i)], 3 * k));
  return positions;
}

const fatMaterials = new Map<string, LineMaterial>();

/** Kept for good: with the last material of a kind its shader would go, and be compiled again for the next line. */
function fatMaterial(linewidth: number, opacity: number, dash: number): LineMaterial {
  const key = [linewidth, opacity, dash].join();
  let material = fatMaterials.get(key);
  if (!material) {
    material = new LineMaterial({
      linewidth, vertexColors: true, transparent: true, opacity, dashed: true, dashSize: dash || 1e9, gapSize: 0.75 * dash, depthWrite: opacity >= 1,
    });
    material.userData.kept = true;
    fatMaterials.set(key, material);
  }
  return material;
}

/** A line of so many pixels, in one colour or one a vertex. */
function fat(positions: Float32Array, tint: Float32Array | string, linewidth: number, opacity = 1, dash = 0): Line2 {
  const geometry = new LineGeometry();
  geometry.setPositions(positions);
  if (typeof tint === "string") {
    const { r, g, b } = new Color(tint);
    tint = Float32Array.from({ length: positions.length }, (_, i) => [r, g, b][i % 3]);
  }
  geometry.setColors(tint);
  const material = fatMaterial(linewidth, opacity, dash);
  const line = new Line2(geometry, material);
  // Below the obstacles, which tint what is behind them; where lines coincide, what was flown covers what was meant.
  line.renderOrder = opacity < 1 ? -2 : -1;
  line.computeLineDistances();
  line.frustumCulled = false;
  return line;
}

function round(value: number): number {
  return Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(6));
}
