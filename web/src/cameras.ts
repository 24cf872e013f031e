/** Where the scene is looked at from: one camera with perspective, one without; turned, moved and fitted. */

import { MOUSE, OrthographicCamera, PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Point } from "./data";
import { toThree, type Ground } from "./solids";

export const VIEWS = ["3D", "top", "side"] as const;
export type View = (typeof VIEWS)[number];
type Camera = PerspectiveCamera | OrthographicCamera;

/** How large the scene is. */
export interface Extent { centre: Vector3; reach: number; box: [Vector3, Vector3]; floor: Ground }

export class Cameras {
  view: View = "3D";
  /** The camera is where a person put it. */
  turned = false;
  controls: OrbitControls | null = null;
  private readonly perspective = new PerspectiveCamera(38, 1, 0.05, 5000);
  private readonly flat = new OrthographicCamera(-1, 1, 1, -1, -5000, 5000);
  private side = 0;
  private size: [number, number] = [16, 10];
  private extent!: Extent;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly changed: () => void) {}

  get camera(): Camera {
    return this.view === "3D" ? this.perspective : this.flat;
  }

  measured(extent: Extent): void {
    this.extent = extent;
    Object.assign(this.perspective, { near: extent.reach / 1500, far: extent.reach * 60 }).updateProjectionMatrix();
  }

  /** The canvas has a size [px]. */
  resize(width: number, height: number): void {
    this.size = [width, height];
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    this.frameFlat();
  }

  /** What a pixel is at a place [m]. */
  perPixel(place: Vector3): number {
    const height = this.size[1];
    if (this.camera === this.flat) return (this.flat.top - this.flat.bottom) / this.flat.zoom / height;
    return (2 * Math.tan((this.perspective.fov * Math.PI) / 360) * this.perspective.position.distanceTo(place)) / height;
  }

  /** The pointers' camera. */
  private use(camera: Camera): void {
    this.controls?.dispose();
    const controls = new OrbitControls(camera, this.canvas);
    controls.zoomToCursor = true;
    controls.maxDistance = 4000;
    controls.minDistance = 0.5;
    controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    controls.addEventListener("change", this.changed);
    controls.addEventListener("start", () => (this.turned = true));
    this.controls = controls;
  }

  setView(view: View): void {
    this.side = view === "side" && this.view === "side" ? 1 - this.side : 0;
    this.view = view;
    this.reset();
  }

  private frameFlat(): void {
    const aspect = this.size[0] / this.size[1], { floor, reach } = this.extent;
    const wide = (this.view === "side" && this.side === 1 ? floor.high[0] - floor.low[0] : floor.high[1] - floor.low[1]) * 1.3;
    const tall = (this.view === "top" ? floor.high[0] - floor.low[0] : reach * 0.3) * 1.3;
    const height = Math.max(tall, wide / aspect) / 2;
    Object.assign(this.flat, { left: -height * aspect, right: height * aspect, top: height, bottom: -height });
    this.flat.updateProjectionMatrix();
  }

  /** See all of it. */
  reset(): void {
    this.turned = false;
    this.use(this.camera);
    const { centre, reach } = this.extent, controls = this.controls!;
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
    this.changed();
  }

  /** Put the perspective camera so far off in a direction that the whole box is seen, and in the middle; gives the target. */
  private fit(direction: Vector3): Vector3 {
    const { perspective: camera } = this, { box, reach, centre } = this.extent;
    const target = centre.clone();
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

  /** Look at a place from where it was looked from before. */
  moveTo(place: Vector3): void {
    if (!this.controls) return;
    const shift = place.clone().sub(this.controls.target);
    this.controls.target.add(shift);
    this.controls.object.position.add(shift);
  }

  zoom(factor: number): void {
    if (!this.controls) return;
    const camera = this.controls.object as Camera;
    if (camera === this.flat) {
      this.flat.zoom = Math.max(0.02, Math.min(200, this.flat.zoom / factor));
      this.flat.updateProjectionMatrix();
    } else camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.changed();
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
    this.changed();
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
    this.changed();
  }

  /** Where on the ground a pointer is (north, east); null beside it. */
  groundAt(clientX: number, clientY: number): [number, number] | null {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(pointer, this.camera);
    const hit = ray.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -this.extent.floor.level), new Vector3());
    return hit ? [-hit.z, hit.x] : null;
  }

  /** Where a place is on the screen [px of the page's window]. */
  screenOf(place: Point): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const p = toThree(place).project(this.camera);
    return [box.left + ((p.x + 1) / 2) * box.width, box.top + ((1 - p.y) / 2) * box.height];
  }

  end(): void {
    this.controls?.dispose();
  }
}
