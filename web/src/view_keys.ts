import { DRAWING, type ModifierKeys, type Tool, CLICKING } from './pointer_strokes';
import type { Point } from './strokes';
import type { ViewCamera } from './view_camera';

/** A press turns the view by this much, rad; with Shift it moves it by this share of the picture. */
const TURN = Math.PI / 36;
const PAN = 0.05;
const ZOOM = 0.85;
/** Corners of the round outline that stands for a stroke. */
const CORNERS = 24;

interface Settings {
  readonly tool: Tool;
  /** Radius of the brush, pixels. */
  readonly brush: number;
}
interface Acts {
  /** The view was moved. */
  moved(): void;
  /** A clicking tool is used in the middle of the picture. */
  clicked(at: Point, keys: ModifierKeys): void;
  /** No tool is used: what is seen there is brought nearer. */
  approached(at: Point): void;
  /** A drawing tool is used there: its outline. */
  outlined(outline: Point[], keys: ModifierKeys): void;
}

/** The 3D picture by keyboard: arrows turn, Shift and arrows move, Page keys zoom; Enter uses the tool in the middle, or brings nearer what is seen there. */
export function listenToKeys(canvas: HTMLCanvasElement, camera: ViewCamera, settings: Settings, acts: Acts): void {
  const move = ({ key, shiftKey }: KeyboardEvent): boolean => {
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key] ?? [0, 0];
    if (key === 'PageUp' || key === 'PageDown') camera.zoom(key === 'PageUp' ? ZOOM : 1 / ZOOM);
    else if (x === 0 && y === 0) return false;
    else if (shiftKey) camera.pan(PAN * (x as number), PAN * (y as number));
    else camera.turn(TURN * (x as number), TURN * (y as number));
    acts.moved();
    return true;
  };
  const use = ({ key, shiftKey: shift, ctrlKey, metaKey }: KeyboardEvent): boolean => {
    const { tool, brush } = settings;
    if (key !== 'Enter') return false;
    const keys = { shift, ctrl: ctrlKey || metaKey };
    const middle: Point = [canvas.clientWidth / 2, canvas.clientHeight / 2];
    if (CLICKING.has(tool)) acts.clicked(middle, keys);
    else if (DRAWING.has(tool)) acts.outlined(around(middle, brush), keys);
    else acts.approached(middle);
    return true;
  };
  canvas.addEventListener('keydown', (event) => {
    if (event.altKey || !(move(event) || use(event))) return;
    event.preventDefault();
    event.stopPropagation();
  });
}

const around = ([x, y]: Point, radius: number): Point[] =>
  Array.from({ length: CORNERS }, (_, i) => {
    const angle = (2 * Math.PI * i) / CORNERS;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
