import { brushOutline, type Point } from './strokes';

export type Tool =
  | 'orbit'
  | 'measure'
  | 'section'
  | 'pair'
  | 'face'
  | 'brush'
  | 'lasso'
  | 'rectangle'
  | 'part'
  | 'like'
  | 'loop'
  | 'align'
  | 'feature';

export const DRAWING: ReadonlySet<Tool> = new Set(['lasso', 'rectangle', 'brush']);
export const CLICKING: ReadonlySet<Tool> = new Set([
  'measure',
  'section',
  'pair',
  'face',
  'part',
  'like',
  'loop',
  'align',
  'feature',
]);

/** Tools whose clicks are places of the surface. */
const PLACING = ['measure', 'section', 'pair', 'face'] as const satisfies readonly Tool[];
export type PlacingTool = (typeof PLACING)[number];
export const places = (tool: Tool): tool is PlacingTool => (PLACING as readonly Tool[]).includes(tool);

/** The keys that are held while the pointer draws. */
export interface ModifierKeys {
  shift: boolean;
  ctrl: boolean;
}

interface Events {
  /** A stroke of a drawing tool has ended: its outline, pixels. */
  outlined(stroke: Point[], keys: ModifierKeys): void;
  /** A clicking tool was used at a point, pixels. */
  clicked(point: Point, keys: ModifierKeys): void;
}

/** What the pointer draws on the picture with the present tool. */
export class PointerStrokes {
  private stroke: Point[] = [];
  private down: Point | null = null;
  private held: ModifierKeys = { shift: false, ctrl: false };
  private readonly fingers = new Set<number>();
  private readonly ring = document.createElementNS('http://www.w3.org/2000/svg', 'circle');

  constructor(
    canvas: HTMLCanvasElement,
    private readonly overlay: SVGSVGElement,
    /** The tool, and the radius of the brush, pixels. */
    private readonly settings: { readonly tool: Tool; readonly brush: number },
    events: Events,
  ) {
    const at = (event: PointerEvent): Point => {
      const frame = canvas.getBoundingClientRect();
      return [event.clientX - frame.left, event.clientY - frame.top];
    };
    canvas.addEventListener('pointerdown', (event) => {
      if (event.pointerType === 'touch') this.fingers.add(event.pointerId);
      if (this.fingers.size > 1) return this.drop(); // two fingers move the view
      if (event.button !== 0) return;
      this.down = at(event);
      this.held = { shift: event.shiftKey, ctrl: event.ctrlKey || event.metaKey };
      if (!DRAWING.has(settings.tool)) return;
      canvas.setPointerCapture(event.pointerId);
      this.stroke = [this.down];
    });
    canvas.addEventListener('pointermove', (event) => {
      this.showRing(event.pointerType === 'mouse' && settings.tool === 'brush' ? at(event) : null);
      if (this.stroke.length === 0) return;
      this.extend(at(event));
      this.sketch();
    });
    canvas.addEventListener('pointerup', (event) => {
      this.fingers.delete(event.pointerId);
      if (event.button !== 0) return;
      const point = at(event);
      const still = this.down && Math.hypot(point[0] - this.down[0], point[1] - this.down[1]) < 4;
      this.down = null;
      const stroke = this.stroke;
      this.stroke = [];
      this.sketch();
      const outline = settings.tool === 'brush' ? brushOutline(stroke, settings.brush) : stroke;
      if (DRAWING.has(settings.tool) && outline.length >= 3) return events.outlined(outline, this.held);
      if (still && CLICKING.has(settings.tool)) events.clicked(point, this.held);
    });
    canvas.addEventListener('pointerleave', () => this.showRing(null));
    canvas.addEventListener('pointercancel', (event) => {
      this.fingers.delete(event.pointerId);
      this.drop();
    });
  }

  /** What the brush would cover, around the pointer. */
  private showRing(at: Point | null): void {
    if (!at) return this.ring.remove();
    this.ring.setAttribute('cx', String(at[0]));
    this.ring.setAttribute('cy', String(at[1]));
    this.ring.setAttribute('r', String(this.settings.brush));
    if (!this.ring.parentNode) this.overlay.append(this.ring);
  }

  private drop(): void {
    this.stroke = [];
    this.down = null;
    this.sketch();
  }

  private extend(point: Point): void {
    const start = this.stroke[0] as Point;
    const last = this.stroke.at(-1) as Point;
    if (this.settings.tool === 'rectangle') this.stroke = [start, [point[0], start[1]], point, [start[0], point[1]]];
    else if (Math.hypot(point[0] - last[0], point[1] - last[1]) > 3) this.stroke.push(point);
  }

  private sketch(): void {
    const points = this.stroke.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');
    const brush = this.settings.tool === 'brush';
    const name = brush ? 'polyline' : 'polygon';
    let line = this.overlay.querySelector('polyline, polygon');
    if (!points) return line?.remove();
    if (!line) {
      line = document.createElementNS('http://www.w3.org/2000/svg', name);
      if (brush) line.setAttribute('stroke-width', String(2 * this.settings.brush));
      this.overlay.append(line);
    }
    line.setAttribute('points', points);
  }
}
