// The camera of the image on show: from the world to the stage's CSS pixels and back.
import { unit } from '../maths/matrix.ts';
import { add, cross, degrees, dot, scale, sub, type Vec3 } from '../maths/vec.ts';
import type { LookAt } from '../maths/camera.ts';

export interface Point {
  x: number; // to the right
  y: number; // down
}

export interface Ray {
  origin: Vec3;
  direction: Vec3; // of length 1
}

export class Lens {
  private readonly forward: Vec3;
  private readonly right: Vec3;
  private readonly up: Vec3;
  private readonly focal: number; // CSS pixels

  constructor(readonly camera: LookAt, readonly width: number, readonly height: number) {
    this.forward = unit(sub(camera.target, camera.eye));
    const right = cross(this.forward, camera.up);
    // An up along the view has no meaning: any other does.
    this.right = unit(dot(right, right) > 1e-12 ? right : cross(this.forward, Math.abs(this.forward[1]) > 0.9 ? [0, 0, 1] : [0, 1, 0]));
    this.up = cross(this.right, this.forward);
    this.focal = height / 2 / Math.tan(camera.fov / 2 / degrees);
  }

  get view(): { forward: Vec3; right: Vec3; up: Vec3 } {
    return { forward: this.forward, right: this.right, up: this.up };
  }

  /** Along the view, from the eye. */
  depthOf(p: Vec3): number {
    return dot(sub(p, this.camera.eye), this.forward);
  }

  /** Null for what is not before the camera. */
  project(p: Vec3): Point | null {
    const v = sub(p, this.camera.eye), depth = dot(v, this.forward);
    if (depth < this.camera.near * 0.5) return null;
    const perUnit = this.focal / depth;
    return { x: this.width / 2 + dot(v, this.right) * perUnit, y: this.height / 2 - dot(v, this.up) * perUnit };
  }

  /** World units of a CSS pixel at that place. */
  pixelAt(p: Vec3): number {
    return Math.max(this.depthOf(p), this.camera.near) / this.focal;
  }

  rayAt({ x, y }: Point): Ray {
    const aside = add(scale(this.right, (x - this.width / 2) / this.focal), scale(this.up, (this.height / 2 - y) / this.focal));
    return { origin: this.camera.eye, direction: unit(add(this.forward, aside)) };
  }
}

/** Where a line comes nearest to a ray, in lengths of its direction from its point; null where they are parallel. */
export function alongLine(point: Vec3, direction: Vec3, ray: Ray): number | null {
  const between = sub(point, ray.origin), a = dot(direction, direction), b = dot(direction, ray.direction), denominator = a - b * b;
  if (!(denominator > 1e-9 * a)) return null;
  return (b * dot(between, ray.direction) - dot(between, direction)) / denominator;
}

/** Where a ray meets a plane; null where it is nearly along it or the plane is behind. */
export function onPlane(point: Vec3, normal: Vec3, ray: Ray): Vec3 | null {
  const across = dot(unit(normal), ray.direction);
  if (Math.abs(across) < 1e-3) return null;
  const distance = dot(sub(point, ray.origin), unit(normal)) / across;
  return distance > 0 ? add(ray.origin, scale(ray.direction, distance)) : null;
}
