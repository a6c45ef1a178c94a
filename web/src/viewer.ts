// Above 250 lines: what the page may show of the one scene; its parts are in files of their own.
import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { CloudsView } from './clouds_view';
import type { Coloring, Ends, Legend } from './mesh_colors';
import { EditPreview } from './edit_preview';
import { HoleMarks, type Marked } from './hole_marks';
import { type Drawn, Ruler } from './ruler';
import { RigModel } from './rig_model';
import { addLights, addTable } from './stage_props';
import { Smoothing } from './smoothing';
import type { Ray, ViewerEvents } from './viewer_events';
import { ReferenceView } from './reference_view';
import { SectionView } from './section_view';
import { CLICKING, DRAWING, PointerStrokes, type ModifierKeys, type Tool } from './pointer_strokes';
import { smallPicture } from './small_picture';
import type { Point } from './strokes';
import { type SectionLook, type Shading, SurfaceView } from './surface_view';
import type { RigGeometry, Section, Triple } from './types';
import { ViewCamera } from './view_camera';
import { listenToKeys } from './view_keys';
import { ViewMarks } from './view_marks';
import { ViewPicks } from './view_picks';

export type { ModifierKeys, Tool } from './pointer_strokes';
export type { Hit, Ray } from './viewer_events';
export type { SectionAxis, SectionLook, Shading } from './surface_view';

/** After a move, until the finest level is drawn, ms: later where it takes long and would hold up the next move. */
const REST_MS = 160;
const REST_IN_SOFTWARE_MS = 400;
/** A point of a cloud is hit within this distance. */
const NEAR_PX = 6;

/** The 3D picture. It draws when something changes, not all the time. */
export class Viewer {
  readonly canvas: HTMLCanvasElement;
  readonly overlay: SVGSVGElement;
  tool: Tool = 'orbit';
  through = false;
  /** Radius of the brush, pixels of the screen. */
  brush = 18;
  readonly supported: boolean;

  private renderer!: THREE.WebGLRenderer;
  private smoothing!: Smoothing;
  view!: ViewCamera;
  private readonly marks = new ViewMarks((from) => this.frame(from));
  private readonly picks: ViewPicks;
  private readonly scene = new THREE.Scene();
  private readonly lights = new THREE.Group();
  readonly clouds = new CloudsView();
  private readonly table = new THREE.Group();
  private readonly surface = new SurfaceView();
  private readonly ruler = new Ruler(() => this.draw());
  private readonly cut = new SectionView();
  private readonly preview = new EditPreview();
  private readonly reference = new ReferenceView();
  private readonly holes = new HoleMarks();
  private readonly rig = new RigModel();
  private rigShown = 'null';
  private tableKnown = true;
  private wanted = true;
  private due = false;
  private resting = 0;
  private held = false;
  private incomplete = false;
  private moving = false;

  constructor(
    private readonly host: HTMLElement,
    events: ViewerEvents,
  ) {
    this.picks = new ViewPicks(this, events);
    this.canvas = document.createElement('canvas');
    this.canvas.className = 'view-canvas';
    this.canvas.tabIndex = 0;
    this.overlay = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.overlay.setAttribute('class', 'view-overlay');
    this.overlay.setAttribute('aria-hidden', 'true');
    host.append(this.canvas, this.overlay, this.ruler.labels, this.marks.element);
    try {
      // three.js would complain on the console; the page says it in words.
      const context = document.createElement('canvas').getContext('webgl2');
      if (!context) throw new Error('no WebGL');
      context.getExtension('WEBGL_lose_context')?.loseContext();
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: false, alpha: true });
      this.supported = true;
    } catch {
      this.supported = false;
      return;
    }
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.localClippingEnabled = true;
    this.smoothing = new Smoothing(this.renderer);
    this.view = new ViewCamera(
      this.canvas,
      () => this.draw(),
      (held) => {
        this.held = held;
        this.move();
      },
    );
    this.scene.add(
      this.lights,
      this.clouds.group,
      this.table,
      this.surface.group,
      this.cut.group,
      this.reference.group,
      this.preview.group,
      this.holes.group,
      this.ruler.group,
      this.rig.group,
    );
    addLights(this.lights);
    addTable(this.table);
    new ResizeObserver(() => this.resize()).observe(host);
    const acts = {
      outlined: (stroke: Point[], keys: ModifierKeys) =>
        events.outlined(this.view.outlineOf(stroke), this.through, keys),
      clicked: (point: Point, keys: ModifierKeys) => this.picks.clicked(point, keys),
      approached: (point: Point) => this.approach(point),
      moved: () => this.move(),
    };
    new PointerStrokes(this.canvas, this.overlay, this, acts);
    listenToKeys(this.canvas, this.view, this, acts);
    this.canvas.addEventListener('dblclick', ({ offsetX, offsetY }) => this.approach([offsetX, offsetY]));
    this.resize();
  }

  /** Points of a station while a scan grows. */
  setCloud(station: number, positions: Float32Array | null, ends: Ends | null = null): void {
    this.clouds.set(station, positions, ends);
    this.draw();
  }
  clearClouds(): void {
    this.clouds.clear();
    this.draw();
  }
  /** Shows the clouds of some stations, or that of the live preview alone. */
  showClouds(shown: boolean, live = false, isShown: (station: number) => boolean = () => true): void {
    if (this.clouds.show(shown, live, isShown)) this.draw();
  }

  /** The rig around the turntable; null hides it. */
  setRig(rig: RigGeometry | null): void {
    const text = JSON.stringify(rig);
    if (text === this.rigShown) return;
    const appears = rig !== null && (this.rigShown === 'null' || this.tableKnown !== (rig.turntable !== null));
    this.tableKnown = !rig || rig.turntable !== null;
    this.rigShown = text;
    this.rig.set(rig);
    this.table.visible = this.tableKnown;
    if (appears) this.frame();
    this.draw();
  }

  /** A picture of the present view, as the screen shows it. */
  async snapshot(): Promise<Blob | null> {
    this.setMoving(false);
    this.drawNow();
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }

  /** The present view in a small JPEG, base64; empty where the browser makes none. */
  async thumbnail(width: number, height: number): Promise<string> {
    this.drawNow();
    return smallPicture(this.canvas, width, height);
  }

  showSurface(shown: boolean): void {
    this.wanted = shown;
    this.showParts();
  }
  /** The surface with what belongs to it, or the reference in its place. */
  private showParts(): void {
    const shown = this.wanted && !this.showsReference;
    this.surface.group.visible = this.preview.group.visible = shown;
    this.cut.group.visible = shown && !this.surface.whole;
    this.ruler.group.visible = this.wanted;
    this.ruler.showKept(shown);
    this.draw();
  }
  /** Draws the coarsest level until nothing has moved for a while. */
  private move(): void {
    this.setMoving(true);
    clearTimeout(this.resting);
    if (this.held || this.incomplete) return;
    this.resting = window.setTimeout(
      () => {
        this.setMoving(false);
        this.draw();
      },
      this.smoothing?.software ? REST_IN_SOFTWARE_MS : REST_MS,
    );
  }
  private setMoving(moving: boolean): void {
    this.moving = moving;
    this.surface.setMoving(moving);
  }

  /** Holds back the finest level until everything that it shows has arrived. */
  setIncomplete(incomplete: boolean): void {
    if (incomplete === this.incomplete) return;
    this.incomplete = incomplete;
    this.move();
  }

  /** Whether the picture is the final one: nothing moves. */
  get atRest(): boolean {
    return !this.moving && !this.due;
  }
  get meshShown(): number {
    return this.surface.revision;
  }
  /** Whether a mesh is in the picture, and its finest level. */
  get shown(): boolean {
    return this.surface.shown !== null;
  }
  get levelsShown(): number {
    return this.surface.levels.length;
  }
  get trianglesShown(): number {
    return this.surface.shown?.triangles ?? 0;
  }
  get wiresCoarsely(): boolean {
    return this.surface.wiresCoarsely;
  }
  clearMesh(): void {
    this.clearMeasurement();
    this.surface.clear();
    this.draw();
  }
  /** Shows a mesh of the last ones again. */
  recallMesh(revision: number, selection: number): boolean {
    if (!this.surface.recall(revision, selection)) return false;
    this.clearMeasurement();
    this.move();
    this.draw();
    return true;
  }
  addLevel(revision: number, arrays: MeshArrays): void {
    const first = this.surface.levels.length === 0;
    if (this.surface.revision !== revision) this.clearMeasurement();
    this.surface.addLevel(revision, arrays);
    if (first) this.frame();
    this.draw();
  }
  /** The selection that so many levels of the mesh show. */
  get selected(): { revision: number; levels: number } {
    return this.surface.selected;
  }
  setSelection(level: number, flags: Uint8Array | null, revision: number): void {
    this.surface.select(level, flags, revision);
    this.move();
    this.draw();
  }
  /** Shows what an edit would change; null shows nothing. */
  setPreview(arrays: Map<string, ArrayLike<number>> | null): void {
    this.preview.set(arrays);
    this.surface.setWhole(arrays !== null);
    this.showParts();
  }
  /** Rings around some holes. */
  mark(holes: readonly Marked[]): void {
    if (this.holes.set(holes, this.size.length() / 30)) this.draw();
  }
  setDeviations(values: readonly (Float32Array | null)[], band: [number, number] | null): void {
    this.surface.setDeviations(values, band);
    this.draw();
  }
  setShading(shading: Shading): void {
    this.surface.setShading(shading);
    this.draw();
  }
  setSetups(clouds: readonly Float32Array[]): void {
    this.surface.setSetups(clouds);
    this.draw();
  }
  setColoring(coloring: Coloring): void {
    this.surface.setColoring(coloring);
    this.draw();
  }
  setSection({ axis, normal, at, flipped }: SectionLook): void {
    const before = JSON.stringify(this.surface.section);
    this.surface.section = { axis, normal, at, flipped };
    if (before !== JSON.stringify(this.surface.section)) this.move();
    this.surface.cut();
    this.draw();
  }
  get legend(): Legend | null {
    return this.surface.legend;
  }
  /** Chooses the ends of the scale of colours; null takes the usual ones again. */
  setEnds(ends: Ends | null): void {
    this.surface.setEnds(ends);
    this.draw();
  }
  get hasOwnEnds(): boolean {
    return this.surface.hasOwnEnds;
  }
  /** Shows the reference in place of the surface; null shows the surface again. */
  setReference(arrays: MeshArrays | null): void {
    if (!arrays && !this.showsReference) return;
    this.reference.set(arrays);
    this.showParts();
    this.frame();
  }
  get showsReference(): boolean {
    return this.reference.shown;
  }
  /** Shows what the section plane cuts; null shows nothing. */
  setCut(section: Section | null): void {
    this.cut.set(section);
    this.draw();
  }
  /** The section plane: its normal, null without one; the ends of the part along it, and its position there, mm. */
  get section(): { normal: Triple | null; range: [number, number]; at: number } {
    const { sectionNormal: normal, sectionRange: range, sectionAt: at } = this.surface;
    return { normal, range, at };
  }
  get size(): THREE.Vector3 {
    return this.surface.size;
  }

  /** Brings what is seen at a pixel to the middle, nearer; a tool that clicks takes both clicks itself. */
  private approach(at: Point): void {
    if (CLICKING.has(this.tool)) return;
    if (this.wanted && this.shown)
      return this.picks.ask(at, ({ point_mm }) => this.view.approach(new THREE.Vector3(...point_mm)));
    const point = this.clouds.pointOn(this.view.rayAt(at), NEAR_PX * this.view.mmPerPixel);
    if (point) this.view.approach(point);
  }
  /** Puts the object in the middle of the picture. */
  frame(direction?: [number, number, number]): void {
    if (!this.supported) return;
    const rig = this.rig.box();
    const part = this.showsReference ? this.reference.box : this.surface.box;
    this.view.frame(rig ?? part, rig ? 0.78 : 1.22, direction); // beside the legend and above the views
    this.draw();
  }
  setTool(tool: Tool): void {
    this.tool = tool;
    if (!this.supported) return;
    this.view.setDrawing(DRAWING.has(tool));
    this.canvas.dataset.tool = tool;
    this.clearMeasurement();
  }
  /** Drops points that were clicked and make nothing yet. */
  clearMeasurement(): void {
    this.picks.forget();
  }
  showMeasurements(list: readonly Drawn[]): void {
    this.ruler.show(list, this.size.length() / 260);
    this.draw();
  }
  /** Marks points that were clicked and make nothing yet. */
  showPending(points: readonly Triple[]): void {
    this.ruler.showPending(
      points.map((point) => new THREE.Vector3(...point)),
      this.size.length() / 260,
    );
    this.draw();
  }

  /** The ray of the eye through a pixel. */
  rayThrough(point: Point): Ray {
    const { origin, direction } = this.view.rayAt(point);
    const { kept } = this.surface;
    const of = this.showsReference ? { reference: true as const } : kept ? { section: kept } : {};
    return { eye: origin.toArray(), direction: direction.toArray(), ...of };
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!this.supported || width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.view.setAspect(width / height);
    this.draw();
  }

  draw(): void {
    if (this.due || !this.supported) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.drawNow();
    });
  }
  drawNow(): void {
    const { camera } = this.view;
    camera.updateMatrixWorld(); // before letters are placed by it
    this.lights.quaternion.copy(camera.quaternion);
    this.marks.update(camera, this.view.mmPerPixel, this.canvas.clientWidth);
    this.ruler.place(camera, this.canvas.clientWidth, this.canvas.clientHeight);
    this.smoothing.render(this.scene, camera, !(this.moving && this.smoothing.software));
  }
}
