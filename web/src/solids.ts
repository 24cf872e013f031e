/** What stands in the scene: obstacles, map cells, fence, bounds, ground, the vehicle. North, east, up become three's -z, x, y. */

import {
  BoxGeometry, BufferGeometry, CircleGeometry, CylinderGeometry, DoubleSide, EdgesGeometry, ExtrudeGeometry, Float32BufferAttribute,
  Group, InstancedMesh, LineBasicMaterial, LineSegments, Material, Matrix4, Mesh, MeshLambertMaterial, Object3D,
  RingGeometry, Shape, SphereGeometry, Vector3,
} from "three";
import { decode, type ObstacleJson, type Point } from "./data";
import { colour } from "./dom";

export function toThree([n, e, u]: ArrayLike<number> & Iterable<number>): Vector3 {
  return new Vector3(e, u, -n);
}

// Every material is one of three kinds that differ in numbers only: each further kind is a shader to compile.

/** Lit by the sun. */
export function solid(name: string, opacity = 1): MeshLambertMaterial {
  return new MeshLambertMaterial({ color: colour(name), transparent: true, opacity, depthWrite: opacity >= 1, side: DoubleSide });
}

/** Of its own colour, whatever the light. */
export function glowing(name: string, opacity = 1): MeshLambertMaterial {
  return new MeshLambertMaterial({ color: 0, emissive: colour(name), transparent: true, opacity, depthWrite: opacity >= 1, side: DoubleSide });
}

function edged(geometry: BufferGeometry, name: string, opacity: number): Group {
  const group = new Group();
  group.add(new Mesh(geometry, solid(name, opacity)),
    new LineSegments(new EdgesGeometry(geometry, 30), new LineBasicMaterial({ color: colour(name), transparent: true, opacity: 0.85 })));
  return group;
}

/** One obstacle; `cells` become one instanced mesh. */
export function obstacle(json: ObstacleJson): Object3D {
  if (json.kind === "cells") return cells(decode(json.at).view(), json.size);
  let shape: Object3D;
  if (json.kind === "box") {
    const low = toThree(json.low), high = toThree(json.high);
    const size = high.clone().sub(low);
    shape = edged(new BoxGeometry(Math.abs(size.x), Math.abs(size.y), Math.abs(size.z)), "solid", 0.42);
    shape.position.copy(low.add(high).multiplyScalar(0.5));
  } else if (json.kind === "cylinder") {
    shape = edged(new CylinderGeometry(json.radius, json.radius, json.height, 40), "solid", 0.42);
    shape.position.copy(toThree(json.base)).y += json.height / 2;
  } else if (json.kind === "sphere") {
    shape = edged(new SphereGeometry(json.radius, 32, 20), "solid", 0.42);
    shape.position.copy(toThree(json.centre));
  } else {
    const outline = new Shape();
    json.polygon.forEach(([n, e], k) => (k ? outline.lineTo(e, n) : outline.moveTo(e, n)));
    const geometry = new ExtrudeGeometry(outline, { depth: json.high - json.low, bevelEnabled: false });
    geometry.rotateX(-Math.PI / 2); // x stays east, y north becomes -z, depth becomes up
    shape = edged(geometry, "solid", 0.42);
    shape.position.y = json.low;
  }
  return shape;
}

function cells(at: ArrayLike<number>, size: number): Object3D {
  const count = Math.floor(at.length / 3);
  const mesh = new InstancedMesh(new BoxGeometry(size * 0.94, size * 0.94, size * 0.94), solid("cells", 0.5), count);
  const place = new Matrix4();
  for (let i = 0; i < count; i++) mesh.setMatrixAt(i, place.makeTranslation(at[3 * i + 1], at[3 * i + 2], -at[3 * i]));
  return mesh;
}

/** Straight pieces between pairs of points. */
export function segments(points: number[], name: string, opacity = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour(name), transparent: true, opacity }));
}

export function boundsFrame(low: Point, high: Point): Object3D {
  const a = toThree(low), b = toThree(high);
  const frame = new LineSegments(
    new EdgesGeometry(new BoxGeometry(Math.abs(b.x - a.x), Math.abs(b.y - a.y), Math.abs(b.z - a.z))),
    new LineBasicMaterial({ color: colour("ink-3"), transparent: true, opacity: 0.4 }));
  frame.position.copy(a.add(b).multiplyScalar(0.5));
  return frame;
}

/** A curtain along the fence. */
export function fenceCurtain(corners: [number, number][], low: number, high: number): Object3D {
  const group = new Group(), wall: number[] = [], rim: number[] = [];
  corners.forEach(([n, e], k) => {
    const [n2, e2] = corners[(k + 1) % corners.length];
    wall.push(e, low, -n, e2, low, -n2, e2, high, -n2, e, low, -n, e2, high, -n2, e, high, -n);
    rim.push(e, low, -n, e2, low, -n2, e, high, -n, e2, high, -n2, e, low, -n, e, high, -n);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(wall, 3));
  group.add(new Mesh(geometry, glowing("bad", 0.05)),
    segments(rim, "bad", 0.55));
  return group;
}

export interface Ground { object: Object3D; step: number; low: [number, number]; high: [number, number]; level: number }

/** A grid of round spacing over (north, east) from low to high. */
export function ground(low: [number, number], high: [number, number], level: number): Ground {
  const span = Math.max(high[0] - low[0], high[1] - low[1], 1);
  const raw = span / 10, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= raw)!;
  const from = low.map((v) => Math.floor(v / step + 1e-6) * step) as [number, number];
  const to = high.map((v) => Math.ceil(v / step - 1e-6) * step) as [number, number];
  const lines: number[] = [];
  for (let n = from[0]; n <= to[0] + step * 1e-6; n += step) lines.push(from[1], level, -n, to[1], level, -n);
  for (let e = from[1]; e <= to[1] + step * 1e-6; e += step) lines.push(e, level, -from[0], e, level, -to[0]);
  const object = segments(lines, "ground-line", 0.9);
  return { object, step, low: from, high: to, level };
}

const ARM = 0.25; // [m] of an X500, middle to motor
export const VEHICLE_SPAN = 2 * (ARM + 0.13);

/** A quadrotor of natural size, nose toward -z; the front rotors carry the accent. */
export function vehicle(): Group {
  const group = new Group();
  const dark = solid("vehicle");
  const put = (geometry: BufferGeometry, material: Material, x: number, y: number, z: number, turn = 0) => {
    const mesh = new Mesh(geometry, material);
    mesh.position.set(x, y, z);
    mesh.rotation.y = turn;
    group.add(mesh);
    return mesh;
  };
  put(new BoxGeometry(0.13, 0.07, 0.2), dark, 0, 0, 0);
  put(new BoxGeometry(0.05, 0.035, 0.06), solid("accent"), 0, 0.01, -0.12);
  for (const [x, z] of [[1, -1], [-1, -1], [1, 1], [-1, 1]]) {
    const front = z < 0, d = ARM / Math.SQRT2;
    put(new BoxGeometry(0.022, 0.02, ARM), dark, (x * d) / 2, 0, (z * d) / 2, Math.atan2(x, z));
    put(new CylinderGeometry(0.022, 0.026, 0.05, 12), dark, x * d, 0.02, z * d);
    for (const [geometry, opacity] of [[new CircleGeometry(0.127, 32), 0.28], [new RingGeometry(0.115, 0.13, 40), 0.95]] as const) {
      const disc = put(geometry, glowing(front ? "accent" : "vehicle", opacity), x * d, 0.05, z * d);
      disc.rotation.x = -Math.PI / 2;
    }
  }
  for (const x of [-1, 1]) put(new BoxGeometry(0.012, 0.1, 0.012), dark, x * 0.07, -0.07, 0), put(new BoxGeometry(0.014, 0.014, 0.22), dark, x * 0.07, -0.12, 0);
  return group;
}

/** Give back what the graphics card holds. */
export function dispose(object: Object3D): void {
  object.traverse((child) => {
    const { geometry, material } = child as Mesh;
    geometry?.dispose();
    for (const m of [material].flat()) if (!m?.userData.kept) m?.dispose();
  });
  object.removeFromParent();
}
