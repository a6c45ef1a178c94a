import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Triple } from './types';
import { listenToFingers } from './view_fingers';

/** A lasso in space: the eye, then the corners, as `frangia edit --select-outline` takes them. */
export type Outline = string;
type Eye = THREE.PerspectiveCamera | THREE.OrthographicCamera;

/** Corners of an outline at most. */
const MOST_CORNERS = 72;
/** What is looked at where nothing is: a part of a hand's size on the table, mm. */
const EMPTY = new THREE.Box3(new THREE.Vector3(-70, -70, 0), new THREE.Vector3(70, 70, 110));
/** Vertical field of view, degrees: that of a portrait lens. */
const FIELD_DEG = 28;
/** How much nearer a double click brings what it hit. */
const CLOSER = 0.4;
/** Where parallel rays are given by an eye: that many times the height of the picture away they differ by a thousandth. */
const FAR_EYE = 500;

/** The eye, how a hand turns it around the object, and the rays that it sends through the picture. */
export class ViewCamera {
  camera: Eye;
  readonly controls: OrbitControls;
  private readonly perspective = new THREE.PerspectiveCamera(FIELD_DEG, 1, 1, 5000);
  private readonly parallel = new THREE.OrthographicCamera();
  private aspect = 1;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    changed: () => void,
    /** A hand begins or ends to turn. */
    held: (held: boolean) => void,
  ) {
    this.camera = this.perspective;
    this.perspective.up.set(0, 0, 1);
    this.parallel.up.set(0, 0, 1);
    this.camera.position.set(260, -300, 190);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.target.set(0, 0, 40);
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => held(true));
    this.controls.addEventListener('end', () => held(false));
    const whole = 2 * Math.PI; // by the height of the picture, as one finger turns it
    listenToFingers(
      canvas,
      (angle) => this.turn(this.away.z < 0 ? -angle : angle, 0),
      (right, down) => this.turn(-whole * right, whole * down),
    );
  }

  /** Puts a box in the middle of the picture, seen from a direction or from where the eye is. `close` is its distance. */
  frame(box: THREE.Box3, close: number, direction?: [number, number, number]): void {
    const shown = box.isEmpty() ? EMPTY : box;
    const radius = shown.getSize(new THREE.Vector3()).length() / 2;
    const away = direction ? new THREE.Vector3(...direction) : this.away;
    this.perspective.fov = FIELD_DEG;
    const distance = (close * radius) / Math.sin(this.halfField) / Math.min(1, this.aspect);
    this.place(shown.getCenter(new THREE.Vector3()), away, distance * Math.tan(this.halfField));
  }

  /** Puts a point into the middle of the picture, nearer than before. */
  approach(point: THREE.Vector3): void {
    this.place(point, this.away, this.halfHeight * CLOSER);
  }

  /** Puts a point into the middle of the picture, seen from a direction; `halfHeight` of it is shown upright, mm. */
  visit(point: Triple, from: Triple, halfHeight: number): void {
    this.place(new THREE.Vector3(...point), new THREE.Vector3(...from), halfHeight);
  }

  /** Looks from where a camera is, along its axis and with its field of view, at what is a distance away. */
  standAt(eye: THREE.Vector3, axis: THREE.Vector3, distance: number, fieldDeg: number): void {
    this.setParallel(false);
    this.perspective.fov = fieldDeg;
    const target = eye.clone().addScaledVector(axis.clone().normalize(), distance);
    this.place(target, axis.clone().negate(), distance * Math.tan(this.halfField));
  }

  get isParallel(): boolean {
    return this.camera === this.parallel;
  }
  /** Parallel rays, by which equal lengths look equal, or those of an eye; the middle of the picture keeps its size. */
  setParallel(parallel: boolean): void {
    if (parallel === this.isParallel) return;
    const { away, halfHeight, controls } = this;
    this.camera = parallel ? this.parallel : this.perspective;
    controls.object = this.camera;
    this.place(controls.target.clone(), away, halfHeight);
  }

  /** Turns around what is looked at, radians: to the side and up. */
  turn(aside: number, up: number): void {
    const { camera, controls } = this;
    const offset = camera.position.clone().sub(controls.target);
    const distance = offset.length();
    const azimuth = Math.atan2(offset.y, offset.x) + aside;
    const height = Math.min(1.55, Math.max(-1.55, Math.asin(offset.z / distance) + up));
    const way = new THREE.Vector3(
      Math.cos(azimuth) * Math.cos(height),
      Math.sin(azimuth) * Math.cos(height),
      Math.sin(height),
    );
    this.place(controls.target.clone(), way, this.halfHeight);
  }
  /** Moves the view by shares of the height of the picture. */
  pan(right: number, up: number): void {
    const { camera, controls } = this;
    camera.updateMatrixWorld();
    const step = (column: number, share: number) =>
      new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, column).multiplyScalar(2 * share * this.halfHeight);
    this.place(controls.target.clone().add(step(0, right)).add(step(1, up)), this.away, this.halfHeight);
  }
  zoom(factor: number): void {
    this.place(this.controls.target.clone(), this.away, this.halfHeight * factor);
  }

  /** Whether the left button and one finger draw; wheel, other buttons and more fingers move the view all the same. */
  setDrawing(drawing: boolean): void {
    const { controls } = this;
    controls.mouseButtons = {
      LEFT: drawing ? null : THREE.MOUSE.ROTATE,
      MIDDLE: drawing ? THREE.MOUSE.ROTATE : THREE.MOUSE.DOLLY,
      RIGHT: THREE.MOUSE.PAN,
    };
    controls.touches = { ONE: drawing ? null : THREE.TOUCH.ROTATE, TWO: THREE.TOUCH.DOLLY_PAN };
  }

  /** Millimetres that a pixel of the screen stands for at the middle of the picture. */
  get mmPerPixel(): number {
    return (2 * this.halfHeight) / Math.max(1, this.canvas.clientHeight);
  }

  setAspect(aspect: number): void {
    this.aspect = aspect;
    this.perspective.aspect = aspect;
    this.parallel.right = this.parallel.top * aspect;
    this.parallel.left = -this.parallel.right;
    this.perspective.updateProjectionMatrix();
    this.parallel.updateProjectionMatrix();
  }

  /** The ray through a pixel. */
  rayAt([x, y]: [number, number]): THREE.Ray {
    const ray = new THREE.Raycaster();
    this.camera.updateMatrixWorld(); // of a view that is not drawn yet
    ray.setFromCamera(
      new THREE.Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight),
      this.camera,
    );
    return ray.ray;
  }

  /** A stroke in space, at most 72 corners with a tenth of a micrometre at arm's length. */
  outlineOf(stroke: [number, number][]): Outline {
    const { camera, controls, isParallel } = this;
    const step = Math.max(1, stroke.length / MOST_CORNERS);
    const eye = isParallel
      ? controls.target.clone().addScaledVector(this.away, 2 * FAR_EYE * this.halfHeight)
      : camera.position;
    const depth = camera.position.distanceTo(controls.target);
    const numbers: number[] = [...eye.toArray()];
    for (let i = 0; i < stroke.length; i += step) {
      const ray = this.rayAt(stroke[Math.floor(i)] as [number, number]);
      numbers.push(...ray.at(depth, new THREE.Vector3()).toArray());
    }
    return numbers.map((value) => String(Math.round(value * 1000) / 1000)).join(',');
  }

  private get halfField(): number {
    return ((this.perspective.fov / 2) * Math.PI) / 180;
  }
  /** From what is looked at to the eye. */
  private get away(): THREE.Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }
  /** Half of what the picture shows upright at what is looked at, mm. */
  private get halfHeight(): number {
    if (this.isParallel) return this.parallel.top / this.parallel.zoom;
    return this.camera.position.distanceTo(this.controls.target) * Math.tan(this.halfField);
  }
  private place(target: THREE.Vector3, away: THREE.Vector3, halfHeight: number): void {
    const { camera, controls } = this;
    const distance = halfHeight / Math.tan(this.halfField);
    controls.target.copy(target);
    camera.position.copy(target).addScaledVector(away.clone().normalize(), distance);
    this.perspective.near = distance / 50;
    this.perspective.far = this.parallel.far = distance * 20;
    this.parallel.near = -this.parallel.far; // what is nearer than the eye is drawn as well
    this.parallel.top = halfHeight;
    this.parallel.bottom = -halfHeight;
    this.parallel.zoom = 1;
    this.setAspect(this.aspect);
    controls.update();
  }
}
