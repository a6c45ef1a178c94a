import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { acceleratedRaycast, computeBoundsTree, disposeBoundsTree } from 'three-mesh-bvh';

import type { MeshArrays } from './arrays';
import { css, MARK_COLORS, quantile, type Rgb, viridis } from './colors';

THREE.Mesh.prototype.raycast = acceleratedRaycast;
THREE.BufferGeometry.prototype.computeBoundsTree = computeBoundsTree;
THREE.BufferGeometry.prototype.disposeBoundsTree = disposeBoundsTree;

export type Shading = 'smooth' | 'flat' | 'wire';
export type Coloring = 'plain' | 'sigma' | 'views' | 'marks';
export type Tool = 'orbit' | 'measure' | 'lasso' | 'rectangle' | 'part';
export type SectionAxis = 'off' | 'x' | 'y' | 'z';

export interface Legend {
  low: number;
  high: number;
  counts: number[];
  beyond: number;
}
export interface Measurement {
  distance_mm: number;
  sigma_mm: number | null;
}
/** A lasso in space: the eye, then the corners, as `frangia edit --select-outline` takes them. */
export type Outline = string;

interface Events {
  measured(result: Measurement | null): void;
  outlined(outline: Outline, through: boolean): void;
  partPicked(triangle: number): void;
}

const BINS = 48;

/** The 3D picture. It draws when something changes, not all the time. */
export class Viewer {
  readonly canvas: HTMLCanvasElement;
  readonly overlay: SVGSVGElement;
  tool: Tool = 'orbit';
  through = false;
  legend: Legend | null = null;
  readonly supported: boolean;

  private renderer!: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(28, 1, 1, 5000);
  private controls!: OrbitControls;
  private readonly lights = new THREE.Group();
  private readonly clouds = new THREE.Group();
  private readonly table = new THREE.Group();
  private readonly plane = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
  private arrays: MeshArrays | null = null;
  private mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial> | null = null;
  private inside: THREE.Mesh | null = null;
  private wire: THREE.LineSegments | null = null;
  private picked: THREE.Mesh | null = null;
  private readonly rule = new THREE.Group();
  private ends: THREE.Vector3[] = [];
  private endSigmas: number[] = [];
  private shading: Shading = 'smooth';
  private coloring: Coloring = 'plain';
  private section: { axis: SectionAxis; share: number; flipped: boolean } = { axis: 'off', share: 0.5, flipped: false };
  private readonly box = new THREE.Box3();
  private surfaceShown = true;
  private due = false;
  private stroke: [number, number][] = [];
  private down: [number, number] | null = null;

  constructor(
    private readonly host: HTMLElement,
    private readonly events: Events,
  ) {
    this.canvas = document.createElement('canvas');
    this.canvas.className = 'view-canvas';
    this.overlay = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.overlay.setAttribute('class', 'view-overlay');
    this.overlay.setAttribute('aria-hidden', 'true');
    host.append(this.canvas, this.overlay);
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
      this.supported = true;
    } catch {
      this.supported = false;
      return;
    }
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.localClippingEnabled = true;
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(260, -300, 190);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.target.set(0, 0, 40);
    this.controls.addEventListener('change', () => this.draw());
    this.scene.add(this.lights, this.clouds, this.table, this.rule);
    this.buildLights();
    this.buildTable();
    new ResizeObserver(() => this.resize()).observe(host);
    this.listen();
    this.resize();
  }

  private buildLights(): void {
    const add = (color: number, strength: number, x: number, y: number, z: number) => {
      const light = new THREE.DirectionalLight(color, strength);
      light.position.set(x, y, z);
      this.lights.add(light);
    };
    this.lights.add(new THREE.HemisphereLight(0xeaf1ff, 0x4a4540, 0.95));
    add(0xfff6ea, 2.7, -0.75, 0.9, 1.0); // key light, upper left of the viewer; lights follow the camera
    add(0xcfe4ff, 0.75, 1.0, -0.1, 0.25);
    add(0xffffff, 0.9, 0.3, 0.6, -1.0);
  }

  /** The turntable: a disc with a ring of degrees. */
  private buildTable(): void {
    const disc = new THREE.Mesh(
      new THREE.CircleGeometry(110, 128),
      new THREE.MeshBasicMaterial({ color: 0x808c88, transparent: true, opacity: 0.07, depthWrite: false, side: THREE.DoubleSide }),
    );
    const points: number[] = [];
    for (let degree = 0; degree < 360; degree += 3) {
      const angle = (degree * Math.PI) / 180;
      const inner = degree % 45 === 0 ? 96 : degree % 15 === 0 ? 102 : 106;
      points.push(Math.cos(angle) * inner, Math.sin(angle) * inner, 0, Math.cos(angle) * 110, Math.sin(angle) * 110, 0);
    }
    const ticks = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    this.table.add(disc, new THREE.LineSegments(ticks, new THREE.LineBasicMaterial({ color: 0x808c88, transparent: true, opacity: 0.55 })));
    const ring = new THREE.BufferGeometry().setFromPoints(
      Array.from({ length: 129 }, (_, i) => new THREE.Vector3(Math.cos((i * Math.PI) / 64) * 110, Math.sin((i * Math.PI) / 64) * 110, 0)),
    );
    this.table.add(new THREE.Line(ring, new THREE.LineBasicMaterial({ color: 0x808c88, transparent: true, opacity: 0.55 })));
  }

  /** Points of a station while a scan grows. */
  setCloud(station: number, positions: Float32Array | null): void {
    const old = this.clouds.getObjectByName(String(station)) as THREE.Points | undefined;
    if (old) {
      old.geometry.dispose();
      this.clouds.remove(old);
    }
    if (positions) {
      const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(positions, 3));
      const [r, g, b] = viridis(0.35 + 0.6 * ((station * 0.381966) % 1));
      const material = new THREE.PointsMaterial({ size: 1.6, sizeAttenuation: false, color: new THREE.Color(r / 255, g / 255, b / 255).convertSRGBToLinear() });
      const points = new THREE.Points(geometry, material);
      points.name = String(station);
      this.clouds.add(points);
    }
    this.draw();
  }

  clearClouds(): void {
    for (const child of [...this.clouds.children]) this.setCloud(Number(child.name), null);
  }

  showClouds(shown: boolean): void {
    this.clouds.visible = shown;
    this.draw();
  }

  /** Hides the surface while a scan is looked at. */
  showSurface(shown: boolean): void {
    this.surfaceShown = shown;
    for (const part of [this.mesh, this.inside, this.picked]) if (part) part.visible = shown;
    if (this.wire) this.wire.visible = shown && this.shading === 'wire';
    this.draw();
  }

  setMesh(arrays: MeshArrays | null): void {
    for (const part of [this.mesh, this.inside, this.wire, this.picked]) if (part) this.scene.remove(part);
    this.mesh?.geometry.disposeBoundsTree();
    this.mesh?.geometry.dispose();
    this.wire?.geometry.dispose();
    const first = this.arrays === null;
    this.mesh = this.inside = this.wire = this.picked = null;
    this.arrays = arrays;
    this.clearMeasurement();
    if (!arrays || arrays.triangles.length === 0) return this.draw();
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(arrays.positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(arrays.normals, 3));
    geometry.setIndex(new THREE.BufferAttribute(arrays.triangles, 1));
    geometry.computeBoundingBox();
    this.box.copy(geometry.boundingBox as THREE.Box3);
    const material = new THREE.MeshStandardMaterial({ color: 0xd6d2c9, roughness: 0.62, metalness: 0.0 });
    this.mesh = new THREE.Mesh(geometry, material);
    this.inside = new THREE.Mesh(
      geometry,
      new THREE.MeshStandardMaterial({ color: 0x7a4a3f, roughness: 0.9, side: THREE.BackSide }),
    );
    this.scene.add(this.mesh, this.inside);
    this.color();
    this.shade();
    this.cut();
    if (first) this.frame();
    this.showSurface(this.surfaceShown);
    // After the first picture: rays are needed when someone points at the mesh.
    setTimeout(() => {
      // Indirect: the triangles keep their order, by which the server numbers them.
      if (this.mesh?.geometry === geometry) geometry.computeBoundsTree({ indirect: true });
    }, 50);
    this.draw();
  }

  setSelection(flags: Uint8Array | null): void {
    if (this.picked) {
      this.picked.geometry.dispose();
      this.scene.remove(this.picked);
      this.picked = null;
    }
    if (flags && this.mesh && this.arrays && flags.length * 3 === this.arrays.triangles.length) {
      let count = 0;
      for (const flag of flags) count += flag;
      if (count > 0) {
        const index = new Uint32Array(count * 3);
        let at = 0;
        for (let i = 0; i < flags.length; i++) {
          if (!flags[i]) continue;
          index.set(this.arrays.triangles.subarray(3 * i, 3 * i + 3), at);
          at += 3;
        }
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', this.mesh.geometry.getAttribute('position'));
        geometry.setAttribute('normal', this.mesh.geometry.getAttribute('normal'));
        geometry.setIndex(new THREE.BufferAttribute(index, 1));
        this.picked = new THREE.Mesh(
          geometry,
          new THREE.MeshStandardMaterial({
            color: 0x9a6bff, emissive: 0x43208f, roughness: 0.7, side: THREE.DoubleSide,
            polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -2,
            clippingPlanes: this.section.axis === 'off' ? [] : [this.plane],
          }),
        );
        this.scene.add(this.picked);
      }
    }
    this.draw();
  }

  setShading(shading: Shading): void {
    this.shading = shading;
    this.shade();
    this.draw();
  }

  setColoring(coloring: Coloring): void {
    this.coloring = coloring;
    this.color();
    this.draw();
  }

  setSection(axis: SectionAxis, share: number, flipped: boolean): void {
    this.section = { axis, share, flipped };
    this.cut();
    this.draw();
  }

  /** Position of the section plane, mm. */
  get sectionAt(): number {
    const { axis, share } = this.section;
    if (axis === 'off' || this.box.isEmpty()) return 0;
    return this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
  }

  get size(): THREE.Vector3 {
    return this.box.isEmpty() ? new THREE.Vector3() : this.box.getSize(new THREE.Vector3());
  }

  private shade(): void {
    if (!this.mesh) return;
    const material = this.mesh.material;
    material.flatShading = this.shading === 'flat';
    material.needsUpdate = true;
    if (this.shading === 'wire' && !this.wire) {
      this.wire = new THREE.LineSegments(
        new THREE.WireframeGeometry(this.mesh.geometry),
        new THREE.LineBasicMaterial({ color: 0x0c2a20, transparent: true, opacity: 0.42 }),
      );
      material.polygonOffset = true;
      material.polygonOffsetFactor = 1;
      material.polygonOffsetUnits = 1;
      this.scene.add(this.wire);
      this.cut();
    }
    if (this.wire) this.wire.visible = this.shading === 'wire';
  }

  private cut(): void {
    const { axis, flipped } = this.section;
    const sign = flipped ? 1 : -1;
    if (axis !== 'off') {
      this.plane.normal.set(axis === 'x' ? sign : 0, axis === 'y' ? sign : 0, axis === 'z' ? sign : 0);
      this.plane.constant = -sign * this.sectionAt;
    }
    for (const part of [this.mesh, this.inside, this.wire, this.picked]) {
      if (!part) continue;
      const material = part.material as THREE.Material;
      material.clippingPlanes = axis === 'off' ? [] : [this.plane];
      material.needsUpdate = true;
    }
  }

  /** Colours by a value of each vertex, with the legend and its histogram. */
  private color(): void {
    this.legend = null;
    const { mesh, arrays } = this;
    if (!mesh || !arrays) return;
    const vertices = arrays.positions.length / 3;
    const values = this.coloring === 'sigma' ? arrays.sigma : this.coloring === 'views' ? arrays.views : null;
    const marks = this.coloring === 'marks' ? arrays.marks : null;
    if (!values && !marks) {
      mesh.geometry.deleteAttribute('color');
      mesh.material.vertexColors = false;
      mesh.material.color.set(0xd6d2c9);
      mesh.material.needsUpdate = true;
      return;
    }
    const colors = new Float32Array(3 * vertices);
    const linear = new THREE.Color();
    const put = (vertex: number, [r, g, b]: Rgb) => {
      linear.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace).toArray(colors, 3 * vertex);
    };
    if (marks) {
      for (let v = 0; v < vertices; v++) put(v, MARK_COLORS[0] as Rgb);
      for (let t = 0; t < marks.length; t++) {
        const mark = marks[t] as number;
        if (mark === 0) continue;
        for (let c = 0; c < 3; c++) put(arrays.triangles[3 * t + c] as number, MARK_COLORS[mark] as Rgb);
      }
    } else if (values) {
      const whole = this.coloring === 'views';
      const low = whole ? 0 : quantile(values, 0.02);
      const high = whole ? Math.max(1, quantile(values, 1)) : quantile(values, 0.95);
      const counts = new Array<number>(whole ? Math.min(BINS, high + 1) : BINS).fill(0);
      let beyond = 0;
      const unknown: Rgb = [128, 128, 128];
      for (let v = 0; v < vertices; v++) {
        const value = values[v] as number;
        const share = (value - low) / (high - low || 1);
        put(v, Number.isFinite(value) ? viridis(share) : unknown);
        if (share > 1 || !Number.isFinite(value)) beyond++;
        else if (share >= 0) {
          const bin = Math.min(counts.length - 1, Math.floor(share * (whole ? high : counts.length)));
          counts[bin] = (counts[bin] as number) + 1;
        }
      }
      this.legend = { low, high, counts, beyond: beyond / vertices };
    }
    mesh.geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
    mesh.material.vertexColors = true;
    mesh.material.color.set(0xffffff);
    mesh.material.needsUpdate = true;
  }

  /** Puts the object in the middle of the picture. */
  frame(direction?: [number, number, number]): void {
    if (!this.supported) return;
    const box = this.box.isEmpty() ? new THREE.Box3(new THREE.Vector3(-70, -70, 0), new THREE.Vector3(70, 70, 110)) : this.box;
    const center = box.getCenter(new THREE.Vector3());
    const radius = box.getSize(new THREE.Vector3()).length() / 2;
    const away = direction
      ? new THREE.Vector3(...direction)
      : this.camera.position.clone().sub(this.controls.target);
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.12 * radius) / Math.sin(((this.camera.fov / 2) * Math.PI) / 180) / narrow;
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(away.normalize(), distance);
    this.camera.near = distance / 50;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  setTool(tool: Tool): void {
    this.tool = tool;
    if (!this.supported) return;
    const free = tool === 'orbit' || tool === 'measure' || tool === 'part';
    this.controls.enabled = free;
    this.canvas.dataset.tool = tool;
    if (tool !== 'measure') this.clearMeasurement();
  }

  clearMeasurement(): void {
    this.ends = [];
    this.endSigmas = [];
    this.rule.clear();
    this.events.measured(null);
    this.draw();
  }

  private listen(): void {
    const at = (event: PointerEvent): [number, number] => {
      const frame = this.canvas.getBoundingClientRect();
      return [event.clientX - frame.left, event.clientY - frame.top];
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      this.down = at(event);
      if (this.tool !== 'lasso' && this.tool !== 'rectangle') return;
      this.canvas.setPointerCapture(event.pointerId);
      this.stroke = [this.down];
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.stroke.length === 0) return;
      const point = at(event);
      const start = this.stroke[0] as [number, number];
      if (this.tool === 'rectangle') this.stroke = [start, [point[0], start[1]], point, [start[0], point[1]]];
      else if (Math.hypot(point[0] - (this.stroke.at(-1) as [number, number])[0], point[1] - (this.stroke.at(-1) as [number, number])[1]) > 3) this.stroke.push(point);
      this.sketch();
    });
    this.canvas.addEventListener('pointerup', (event) => {
      const point = at(event);
      const still = this.down && Math.hypot(point[0] - this.down[0], point[1] - this.down[1]) < 4;
      this.down = null;
      const stroke = this.stroke;
      this.stroke = [];
      this.sketch();
      if (stroke.length >= 3) return this.events.outlined(this.outlineOf(stroke), this.through);
      if (!still || (this.tool !== 'measure' && this.tool !== 'part')) return;
      const hit = this.hit(point);
      if (!hit) return;
      if (this.tool === 'part') this.events.partPicked(hit.faceIndex as number);
      else this.measure(hit);
    });
    this.canvas.addEventListener('pointercancel', () => {
      this.stroke = [];
      this.down = null;
      this.sketch();
    });
  }

  private sketch(): void {
    const points = this.stroke.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');
    let line = this.overlay.querySelector('polygon');
    if (!points) return line?.remove();
    if (!line) {
      line = document.createElementNS('http://www.w3.org/2000/svg', 'polygon');
      this.overlay.append(line);
    }
    line.setAttribute('points', points);
  }

  private rayAt([x, y]: [number, number]): THREE.Raycaster {
    const ray = new THREE.Raycaster();
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    ray.setFromCamera(new THREE.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera);
    ray.firstHitOnly = this.section.axis === 'off';
    return ray;
  }

  private hit(point: [number, number]): THREE.Intersection | null {
    if (!this.mesh) return null;
    const material = this.mesh.material;
    const side = material.side;
    material.side = THREE.DoubleSide;
    const hits = this.rayAt(point).intersectObject(this.mesh, false);
    material.side = side;
    const seen = hits.find((one) => this.section.axis === 'off' || this.plane.distanceToPoint(one.point) >= 0);
    return seen ?? null;
  }

  private measure(hit: THREE.Intersection): void {
    if (this.ends.length === 2) this.clearMeasurement();
    this.ends.push(hit.point.clone());
    const corners = [hit.face?.a, hit.face?.b, hit.face?.c].filter((i): i is number => i !== undefined);
    const sigma = this.arrays?.sigma;
    this.endSigmas.push(sigma ? Math.max(...corners.map((i) => sigma[i] as number)) : NaN);
    const size = this.size.length() / 260;
    const ball = new THREE.Mesh(new THREE.SphereGeometry(size, 20, 14), new THREE.MeshBasicMaterial({ color: 0xff8a4c, depthTest: false }));
    ball.position.copy(hit.point);
    ball.renderOrder = 3;
    this.rule.add(ball);
    if (this.ends.length === 2) {
      const line = new THREE.Line(
        new THREE.BufferGeometry().setFromPoints(this.ends),
        new THREE.LineBasicMaterial({ color: 0xff8a4c, depthTest: false }),
      );
      line.renderOrder = 3;
      this.rule.add(line);
      const [a, b] = this.ends as [THREE.Vector3, THREE.Vector3];
      const combined = Math.hypot(...this.endSigmas);
      this.events.measured({ distance_mm: a.distanceTo(b), sigma_mm: Number.isFinite(combined) ? combined : null });
    }
    this.draw();
  }

  /** The stroke in space, at most 72 corners with a tenth of a micrometre at arm's length. */
  private outlineOf(stroke: [number, number][]): Outline {
    const most = 72;
    const step = Math.max(1, stroke.length / most);
    const numbers: number[] = [...this.camera.position.toArray()];
    const depth = this.camera.position.distanceTo(this.controls.target);
    for (let i = 0; i < stroke.length; i += step) {
      const ray = this.rayAt(stroke[Math.floor(i)] as [number, number]).ray;
      numbers.push(...ray.at(depth, new THREE.Vector3()).toArray());
    }
    return numbers.map((value) => String(Math.round(value * 1000) / 1000)).join(',');
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!this.supported || width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw(): void {
    if (this.due || !this.supported) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.lights.quaternion.copy(this.camera.quaternion);
      this.renderer.render(this.scene, this.camera);
    });
  }
}

export const viridisStops = (): string[] => Array.from({ length: 11 }, (_, i) => css(viridis(i / 10)));
