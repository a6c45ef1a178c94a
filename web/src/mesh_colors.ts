import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { MARK_COLORS, quantile, type Rgb, viridis } from './colors';

export type Coloring = 'plain' | 'sigma' | 'views' | 'marks';
export type ColoredMesh = THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
export interface Legend {
  low: number;
  high: number;
  counts: number[];
  beyond: number;
}
const BINS = 48;

/** Colours by a value of each vertex, with the legend and its histogram. */
export function colorMesh(mesh: ColoredMesh, arrays: MeshArrays, coloring: Coloring): Legend | null {
  const vertices = arrays.positions.length / 3;
  const values = coloring === 'sigma' ? arrays.sigma : coloring === 'views' ? arrays.views : null;
  const marks = coloring === 'marks' ? arrays.marks : null;
  if (!values && !marks) {
    mesh.geometry.deleteAttribute('color');
    mesh.material.vertexColors = false;
    mesh.material.color.set(0xd6d2c9);
    mesh.material.needsUpdate = true;
    return null;
  }
  let legend: Legend | null = null;
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
    const whole = coloring === 'views';
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
    legend = { low, high, counts, beyond: beyond / vertices };
  }
  mesh.geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  mesh.material.vertexColors = true;
  mesh.material.color.set(0xffffff);
  mesh.material.needsUpdate = true;
  return legend;
}

/** Colours points by their height above the turntable. */
export function colorByHeight(geometry: THREE.BufferGeometry, positions: Float32Array): void {
  const heights = positions.filter((_, i) => i % 3 === 2);
  const [low, high] = [quantile(heights, 0), quantile(heights, 1)];
  const colors = new Float32Array(positions.length);
  const linear = new THREE.Color();
  heights.forEach((height, i) => {
    const [r, g, b] = viridis(0.25 + (0.7 * (height - low)) / (high - low || 1));
    linear.setRGB(r / 255, g / 255, b / 255, THREE.SRGBColorSpace).toArray(colors, 3 * i);
  });
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
}
