import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

/** A lasso in space: the eye, then the corners, as `frangia edit --select-outline` takes them. */
export type Outline = string;

/** Corners of an outline at most. */
const MOST_CORNERS = 72;
/** What is looked at where nothing is: a part of a hand's size on the table, mm. */
const EMPTY = new THREE.Box3(new THREE.Vector3(-70, -70, 0), new THREE.Vector3(70, 70, 110));

/** The eye, how a hand turns it around the object, and the rays that it sends through the picture. */
export class ViewCamera {
  readonly camera = new THREE.PerspectiveCamera(28, 1, 1, 5000);
  readonly controls: OrbitControls;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    changed: () => void,
    /** A hand begins or ends to turn. */
    held: (held: boolean) => void,
  ) {
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(260, -300, 190);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.target.set(0, 0, 40);
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => held(true));
    this.controls.addEventListener('end', () => held(false));
  }

  /** Puts a box in the middle of the picture, seen from a direction or from where the eye is. `close` is its distance. */
  frame(box: THREE.Box3, close: number, direction?: [number, number, number]): void {
    const { camera, controls } = this;
    const shown = box.isEmpty() ? EMPTY : box;
    const center = shown.getCenter(new THREE.Vector3());
    const radius = shown.getSize(new THREE.Vector3()).length() / 2;
    const away = direction ? new THREE.Vector3(...direction) : camera.position.clone().sub(controls.target);
    const narrow = Math.min(1, camera.aspect);
    const distance = (close * radius) / Math.sin(((camera.fov / 2) * Math.PI) / 180) / narrow;
    controls.target.copy(center);
    camera.position.copy(center).addScaledVector(away.normalize(), distance);
    camera.near = distance / 50;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    controls.update();
  }

  /** Whether the left button and one finger draw; wheel, other buttons and two fingers move the view all the same. */
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
    const { camera, controls } = this;
    const distance = camera.position.distanceTo(controls.target);
    return (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / Math.max(1, this.canvas.clientHeight);
  }

  setAspect(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
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
    const step = Math.max(1, stroke.length / MOST_CORNERS);
    const numbers: number[] = [...this.camera.position.toArray()];
    const depth = this.camera.position.distanceTo(this.controls.target);
    for (let i = 0; i < stroke.length; i += step) {
      const ray = this.rayAt(stroke[Math.floor(i)] as [number, number]);
      numbers.push(...ray.at(depth, new THREE.Vector3()).toArray());
    }
    return numbers.map((value) => String(Math.round(value * 1000) / 1000)).join(',');
  }
}
