import { unpack, valuesOf } from './arrays';
import { type Rgb, viridis } from './colors';
import type { Layer } from './session';

/** The figures that arrive with a live picture. */
export interface LiveFigures {
  revision: number;
  layer: Layer;
  width: number;
  height: number;
  low: number;
  high: number;
  frames_per_s: number;
  decodes_per_s: number;
  decode_ms: number;
  contrast: number;
  saturated: number;
  dark: number;
  points: number;
  finding: string;
}

/** Colours of PixelStatus, as the program's pictures have them. */
export const STATUS_COLORS: readonly Rgb[] = [
  [230, 230, 225],
  [110, 200, 120],
  [26, 31, 33],
  [220, 60, 50],
  [160, 80, 200],
  [240, 170, 40],
  [70, 130, 220],
  [240, 220, 90],
  [120, 100, 90],
];

/** Light below a hundredth of white is dark: bytes of the sRGB curve below this one. */
const DARK = 26;
const WHITE = 255;
const STRIPE_PX = 4;

/** Camera pixels as the screen shows them, and the same with marks: dark ones are tinted, saturated ones striped. */
const GRAY = table((value) => [value, value, value]);
const TINTED = table((value) =>
  value < DARK ? [value * 0.9 + 4, value * 0.95 + 9, value + 30] : [value, value, value],
);
const STRIPED = table((value) =>
  value === WHITE
    ? [255, 66, 58]
    : value < DARK
      ? [value * 0.9 + 4, value * 0.95 + 9, value + 30]
      : [value, value, value],
);

/** A cyclic scale: -pi and pi look alike. */
export function cyclic(share: number): Rgb {
  const at = (shift: number) => Math.round(128 + 105 * Math.cos(2 * Math.PI * (share - shift)));
  return [at(0), at(1 / 3), at(2 / 3)];
}

function table(color: (value: number) => Rgb): Uint32Array {
  return Uint32Array.from({ length: 256 }, (_, value) => {
    const [r, g, b] = color(value);
    return (0xff << 24) | (Math.round(b) << 16) | (Math.round(g) << 8) | Math.round(r);
  });
}

/** A picture that is shown at 1 : 1 or larger is enlarged as well. */
const LEAST_LOUPE = 2;
const NOTHING: Rgb = [20, 25, 27];
const scaled = (color: (share: number) => Rgb) => table((value) => (value === 0 ? NOTHING : color((value - 1) / 254)));
const TABLES: Record<Exclude<Layer, 'none' | 'points' | 'camera'>, Uint32Array> = {
  phase: scaled(cyclic),
  modulation: scaled(viridis),
  depth: scaled((share) => viridis(1 - share)),
  status: table((value) => STATUS_COLORS[value] ?? NOTHING),
};

/** The live picture of the camera: colours by layer, and the points of a board. */
export class LiveView {
  readonly canvas = document.createElement('canvas');
  figures: LiveFigures | null = null;
  histogram = new Uint32Array(64);
  positions: Float32Array | null = null;
  /** Whether the dark and the saturated pixels are marked. */
  marks = true;
  /** Whether the picture is enlarged until its pixels are seen. */
  loupe = false;
  private message: ArrayBuffer | null = null;
  private readonly pen = this.canvas.getContext('2d') as CanvasRenderingContext2D;

  constructor() {
    this.canvas.className = 'live-picture';
    this.canvas.width = 640;
    this.canvas.height = 512;
  }

  /** Draws a message of the server; returns whether it holds points instead of a picture. */
  draw(message: ArrayBuffer): boolean {
    this.message = message;
    const arrays = unpack(message);
    this.figures = valuesOf<LiveFigures>(message);
    this.histogram = arrays.get('histogram') as Uint32Array<ArrayBuffer>;
    this.positions = (arrays.get('positions') as Float32Array | undefined) ?? null;
    if (this.positions) return true;
    const { width, height, layer } = this.figures;
    const picture = arrays.get('picture') as Uint8Array;
    if (layer === 'none' || layer === 'points' || width === 0) return false;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const image = this.pen.createImageData(width, height);
    const pixels = new Uint32Array(image.data.buffer);
    if (layer === 'camera') this.paintCamera(picture, pixels, width);
    else {
      const colors = TABLES[layer];
      for (let i = 0; i < pixels.length; i++) pixels[i] = colors[picture[i] as number] as number;
    }
    this.pen.putImageData(image, 0, 0);
    this.drawCorners(arrays.get('corners') as Float32Array);
    return false;
  }

  /** The picture under the marks stays readable. */
  private paintCamera(picture: Uint8Array, pixels: Uint32Array, width: number): void {
    for (let i = 0, x = 0, y = 0; i < pixels.length; i++) {
      const colors = !this.marks ? GRAY : (x + y) % (2 * STRIPE_PX) < STRIPE_PX ? STRIPED : TINTED;
      pixels[i] = colors[picture[i] as number] as number;
      if (++x === width) {
        x = 0;
        y++;
      }
    }
  }

  private drawCorners(corners: Float32Array): void {
    const { pen } = this;
    pen.lineWidth = 1.6;
    for (let i = 0; i < corners.length; i += 2) {
      pen.strokeStyle = `hsl(${150 - (110 * i) / corners.length} 85% 58%)`;
      pen.beginPath();
      pen.arc(corners[i] as number, corners[i + 1] as number, 5, 0, 2 * Math.PI);
      pen.stroke();
    }
  }

  /** Enlarges the picture about a place, shares of the width and height of its element, or shows all of it again. */
  toggleLoupe(x: number, y: number): void {
    const { canvas } = this;
    const shown = Math.min(canvas.clientWidth / canvas.width, canvas.clientHeight / canvas.height);
    this.loupe = !this.loupe;
    canvas.style.transformOrigin = `${100 * x}% ${100 * y}%`;
    canvas.style.transform = this.loupe ? `scale(${Math.max(1 / shown, LEAST_LOUPE)})` : '';
    canvas.classList.toggle('loupe', this.loupe);
  }

  setMarks(marks: boolean): void {
    this.marks = marks;
    if (this.message) this.draw(this.message);
  }

  clear(): void {
    this.message = null;
    this.figures = null;
    this.pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }
}
