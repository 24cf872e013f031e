/** The vehicle in the scene, its shadow on the ground, and the ghost where it should be. */

import { Euler, Group, Mesh, RingGeometry, SphereGeometry, type Scene as Stage, type Vector3 } from "three";
import { dispose, glowing, segments, vehicle, VEHICLE_SPAN } from "./solids";

const LEAST_PX = 38; // it is never drawn smaller

export interface Angles { roll: number; pitch: number; yaw: number }

export class Craft {
  private body = new Group();
  private shadow = new Group();
  private ghost = new Group();

  get position(): Vector3 {
    return this.body.position;
  }

  /** Anew, in the colours of now. */
  build(stage: Stage): void {
    [this.body, this.shadow, this.ghost].forEach(dispose);
    this.body = vehicle();
    this.shadow = new Group();
    const spot = new Mesh(new RingGeometry(0.16, 0.24, 40), glowing("accent", 0.75));
    spot.rotation.x = -Math.PI / 2;
    this.shadow.add(spot, segments([0, 0, 0, 0, 1, 0], "accent", 0.55));
    this.ghost = new Group();
    this.ghost.add(new Mesh(new SphereGeometry(0.07, 16, 12), glowing("ink-2", 0.8)));
    stage.add(this.body, this.shadow, this.ghost);
  }

  /** Where it is, above the ground's level; null hides it. */
  place(at: Vector3 | null, { roll, pitch, yaw }: Angles, level: number): void {
    this.body.visible = this.shadow.visible = !!at;
    if (!at) return;
    this.body.position.copy(at);
    this.body.setRotationFromEuler(new Euler(pitch, -yaw, -roll, "YXZ"));
    this.shadow.position.set(at.x, level, at.z);
    this.shadow.children[1].scale.y = Math.max(1e-3, at.y - level);
  }

  placeGhost(at: Vector3 | null): void {
    this.ghost.visible = !!at;
    if (at) this.ghost.position.copy(at);
  }

  /** As great as it is, but never too small to be seen. */
  scale(metresAPixel: number): void {
    const scale = Math.max(1, (LEAST_PX * metresAPixel) / VEHICLE_SPAN);
    for (const object of [this.body, this.shadow.children[0], this.ghost]) object?.scale.setScalar(scale);
  }
}
