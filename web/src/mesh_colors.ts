import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { deviationColor, MARK_COLORS, quantile, type Rgb, SEVERAL_SETUPS, setupColor, viridis } from './colors';

export type Coloring = 'plain' | 'sigma' | 'views' | 'marks' | 'deviation' | 'setup';
export interface Legend {
  low: number;
  high: number;
  counts: number[];
  /** Share of the vertices beyond the scale, or without a value. */
  beyond: number;
  /** Tolerance, of deviations only. */
  band: [number, number] | null;
}
const BINS = 48;
const SHADES = 512;
const UNKNOWN: Rgb = [128, 128, 128];

function valuesFor(arrays: MeshArrays, coloring: Coloring): ArrayLike<number> | null {
  if (coloring === 'sigma') return arrays.sigma;
  if (coloring === 'views') return arrays.views;
  return coloring === 'deviation' ? arrays.deviation : null;
}

/** The values at the ends of a scale, in the unit of the arrays. */
export type Ends = readonly [number, number];

/** What a colouring shows where nobody chose its ends. */
function usualEnds(values: ArrayLike<number>, coloring: Coloring, band: [number, number] | null): Ends {
  const reach = band && 2 * Math.max(Math.abs(band[0]), Math.abs(band[1]));
  if (coloring === 'deviation' && reach) return [-reach, reach];
  if (coloring === 'views') return [0, Math.max(1, quantile(values, 1))];
  return [quantile(values, 0.02), quantile(values, 0.95)];
}

/** The scale of a colouring and its histogram, with the ends that were chosen; null where colours are no scale. */
export function scaleOf(
  arrays: MeshArrays,
  coloring: Coloring,
  band: [number, number] | null,
  ends: Ends | null = null,
): Legend | null {
  const values = valuesFor(arrays, coloring);
  if (!values || values.length === 0) return null;
  const whole = coloring === 'views' && !ends;
  const deviates = coloring === 'deviation';
  const [low, high] = ends ?? usualEnds(values, coloring, band);
  const counts = new Array<number>(whole ? Math.min(BINS, high + 1) : BINS).fill(0);
  let beyond = 0;
  for (let v = 0; v < values.length; v++) {
    const value = values[v] as number;
    const share = (value - low) / (high - low || 1);
    if (!Number.isFinite(value)) beyond += deviates ? 0 : 1;
    else if (share > 1 || (deviates && share < 0)) beyond++;
    else if (share >= 0) {
      const bin = Math.min(counts.length - 1, Math.floor(share * (whole ? high : counts.length)));
      counts[bin] = (counts[bin] as number) + 1;
    }
  }
  return { low, high, counts, beyond: beyond / values.length, band: deviates ? band : null };
}

const linear = (color: Rgb): THREE.Color =>
  new THREE.Color().setRGB(color[0] / 255, color[1] / 255, color[2] / 255, THREE.SRGBColorSpace);

/** The colour at a share of a scale. */
export function shade(scale: Legend, share: number): Rgb {
  return scale.band
    ? deviationColor(scale.low + share * (scale.high - scale.low), scale.band, [scale.low, scale.high])
    : viridis(share);
}

/** Colours of the vertices, as bytes of linear light; null for the plain one. */
export function vertexColors(arrays: MeshArrays, coloring: Coloring, scale: Legend | null): Uint8Array | null {
  const values = valuesFor(arrays, coloring);
  const vertices = arrays.positions.length / 3;
  const byte = (value: number) => Math.round(255 * value);
  if (coloring === 'marks' && arrays.marks) {
    const palette = MARK_COLORS.map((color) => linear(color));
    const marks = new Uint8Array(vertices);
    for (let t = 0; t < arrays.marks.length; t++) {
      const mark = arrays.marks[t] as number;
      if (mark > 0) for (let c = 0; c < 3; c++) marks[arrays.triangles[3 * t + c] as number] = mark;
    }
    const colors = new Uint8Array(3 * vertices);
    for (let v = 0; v < vertices; v++) {
      const color = palette[marks[v] as number] as THREE.Color;
      colors.set([byte(color.r), byte(color.g), byte(color.b)], 3 * v);
    }
    return colors;
  }
  if (coloring === 'setup' && arrays.setups) {
    const palette = Array.from({ length: 256 }, (_, bits) =>
      linear(
        bits === 0 ? UNKNOWN : (bits & (bits - 1)) === 0 ? setupColor(Math.log2(bits)) : (SEVERAL_SETUPS[0] as Rgb),
      ),
    );
    const colors = new Uint8Array(3 * vertices);
    for (let v = 0; v < vertices; v++) {
      const color = palette[arrays.setups[v] as number] as THREE.Color;
      colors.set([byte(color.r), byte(color.g), byte(color.b)], 3 * v);
    }
    return colors;
  }
  if (!values || !scale) return null;
  const shades = new Uint8Array(3 * (SHADES + 1));
  for (let i = 0; i <= SHADES; i++) {
    const color = linear(i < SHADES ? shade(scale, i / (SHADES - 1)) : UNKNOWN);
    shades.set([byte(color.r), byte(color.g), byte(color.b)], 3 * i);
  }
  const colors = new Uint8Array(3 * vertices);
  const factor = (SHADES - 1) / (scale.high - scale.low || 1);
  for (let v = 0; v < vertices; v++) {
    const value = values[v] as number;
    const i = Number.isFinite(value)
      ? Math.min(SHADES - 1, Math.max(0, Math.round((value - scale.low) * factor)))
      : SHADES;
    colors[3 * v] = shades[3 * i] as number;
    colors[3 * v + 1] = shades[3 * i + 1] as number;
    colors[3 * v + 2] = shades[3 * i + 2] as number;
  }
  return colors;
}

/** The heights of points above the turntable as a scale with its histogram: all of them, or between the ends that were chosen. */
export function scaleOfHeights(positions: Float32Array, ends: Ends | null): Legend {
  const heights = positions.filter((_, i) => i % 3 === 2);
  const [low, high] = ends ?? [quantile(heights, 0), quantile(heights, 1)];
  const counts = new Array<number>(BINS).fill(0);
  let beyond = 0;
  for (const height of heights) {
    const share = (height - low) / (high - low || 1);
    // The highest of a sample is a little below the highest of all.
    if (ends && (share < 0 || share > 1)) beyond++;
    const bin = Math.min(BINS - 1, Math.max(0, Math.floor(share * BINS)));
    if (!ends || (share >= 0 && share <= 1)) counts[bin] = (counts[bin] as number) + 1;
  }
  return { low, high, counts, beyond: beyond / Math.max(1, heights.length), band: null };
}
/** The colour at a share of that scale: its dark end would not be seen on the dark picture. */
export const heightColor = (share: number): Rgb => viridis(0.25 + 0.7 * Math.min(1, Math.max(0, share)));

/** Colours points by their height above the turntable. */
export function colorByHeight(geometry: THREE.BufferGeometry, positions: Float32Array, [low, high]: Ends): void {
  const colors = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3)
    linear(heightColor(((positions[i + 2] as number) - low) / (high - low || 1))).toArray(colors, i);
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
}
