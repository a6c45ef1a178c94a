import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { type Coloring, type Ends, type Legend, scaleOf } from './mesh_colors';
import { MeshLevel } from './mesh_level';
import { setupsAt } from './setup_cells';
import type { Triple } from './types';

export type Shading = 'smooth' | 'flat' | 'wire';
export type SectionAxis = 'off' | 'x' | 'y' | 'z' | 'points';
/** A plane normal to an axis, or through three points, at a position along its normal; null: in the middle of the part. */
export interface SectionLook {
  axis: SectionAxis;
  /** Of the plane through three points; null until they were picked. */
  normal: Triple | null;
  at: number | null;
  flipped: boolean;
}

const AXES: Record<'x' | 'y' | 'z', Triple> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** Wires of more triangles than these are a grey area. */
const MOST_WIRED = 300_000;

/** The levels of one mesh, the coarsest first. */
interface Picture {
  revision: number;
  levels: MeshLevel[];
  /** The selection that is drawn, and how many levels show it, from the coarsest on. */
  selected: { revision: number; levels: number };
}

/**
 * The mesh in the scene: levels of detail, shading, colours, section plane and selection. The last meshes stay in memory, so
 * that undo and redo show them without asking for them again.
 */
export class SurfaceView {
  readonly group = new THREE.Group();
  readonly plane = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
  readonly box = new THREE.Box3();
  legend: Legend | null = null;
  section: SectionLook = { axis: 'off', normal: null, at: null, flipped: false };
  private pictures: Picture[] = [];
  private current: Picture | null = null;
  private moving = false;
  /** Both sides of the section plane are shown. */
  whole = false;
  private shading: Shading = 'smooth';
  private coloring: Coloring = 'plain';
  /** The ends of scales that were chosen. */
  private readonly ends = new Map<Coloring, Ends>();
  private setups: readonly Float32Array[] = [];
  private band: [number, number] | null = null;

  private static readonly KEPT = 4;

  get revision(): number {
    return this.current?.revision ?? -1;
  }
  get levels(): readonly MeshLevel[] {
    return this.current?.levels ?? [];
  }
  /** The level that is drawn now. */
  get shown(): MeshLevel | null {
    const { levels } = this;
    return (this.moving || this.wiresCoarsely ? levels[0] : levels.at(-1)) ?? null;
  }
  /** Whether wires are drawn of fewer triangles than the mesh has. */
  get wiresCoarsely(): boolean {
    return this.shading === 'wire' && (this.levels.at(-1)?.triangles ?? 0) > MOST_WIRED;
  }
  /** Draws the coarsest level while something moves. */
  setMoving(moving: boolean): void {
    this.moving = moving;
    this.showLevel();
  }
  private showLevel(): void {
    const { shown } = this;
    for (const level of this.levels) level.group.visible = level === shown;
  }

  /**
   * Shows a mesh that is known already, at once with its selection where that is known, too; returns false when it has to
   * be added.
   */
  recall(revision: number, selection: number): boolean {
    const known = this.pictures.find((one) => one.revision === revision);
    if (!known) return false;
    if (known.selected.revision !== selection) {
      for (const level of known.levels) level.select(null);
      known.selected = { revision: -1, levels: 0 };
    }
    this.show(known);
    return true;
  }
  get selected(): { revision: number; levels: number } {
    return this.current?.selected ?? { revision: -1, levels: 0 };
  }
  clear(): void {
    for (const picture of this.pictures) this.drop(picture);
    this.pictures = [];
    this.current = null;
    this.legend = null;
    this.group.clear();
    this.box.makeEmpty();
  }
  /** Adds the next finer level of a mesh, or a new mesh. */
  addLevel(revision: number, arrays: MeshArrays): void {
    let picture = this.pictures.find((one) => one.revision === revision);
    if (!picture) {
      picture = { revision, levels: [], selected: { revision: -1, levels: 0 } };
      this.pictures.push(picture);
    }
    const level = new MeshLevel(arrays);
    picture.levels.push(level);
    this.show(picture);
  }
  private show(picture: Picture): void {
    this.pictures = [...this.pictures.filter((one) => one !== picture), picture];
    while (this.pictures.length > SurfaceView.KEPT) this.drop(this.pictures.shift() as Picture);
    this.current = picture;
    this.group.clear();
    for (const level of picture.levels) this.group.add(level.group);
    this.box.makeEmpty();
    const coarsest = picture.levels[0];
    if (coarsest)
      this.box.setFromBufferAttribute(coarsest.mesh.geometry.getAttribute('position') as THREE.BufferAttribute);
    this.colorAll();
    this.shadeAll();
    this.cut();
  }
  private drop(picture: Picture): void {
    for (const level of picture.levels) level.dispose();
  }

  /** Shows the triangles of a level that are selected, of a selection with a revision; null shows none. */
  select(level: number, flags: Uint8Array | null, revision: number): void {
    this.levels[level]?.select(flags);
    if (this.current) this.current.selected = { revision, levels: level + 1 };
  }
  /** One array of deviations for each level, within a tolerance. */
  setDeviations(deviations: readonly (Float32Array | null)[], band: [number, number] | null): void {
    this.band = band;
    this.levels.forEach((level, i) => (level.arrays.deviation = deviations[i] ?? null));
    this.colorAll();
  }

  /** Normal of the section plane; null without one. */
  get sectionNormal(): Triple | null {
    const { axis, normal } = this.section;
    if (axis === 'off') return null;
    return axis === 'points' ? normal : AXES[axis];
  }
  /** The ends of the part along the normal of the section plane, mm. */
  get sectionRange(): [number, number] {
    const normal = this.sectionNormal;
    if (!normal || this.box.isEmpty()) return [0, 0];
    const center = this.box.getCenter(new THREE.Vector3()).dot(new THREE.Vector3(...normal));
    const { x, y, z } = this.box.getSize(new THREE.Vector3());
    const half = (Math.abs(normal[0]) * x + Math.abs(normal[1]) * y + Math.abs(normal[2]) * z) / 2;
    return [center - half, center + half];
  }
  /** Position of the section plane along its normal, mm. */
  get sectionAt(): number {
    const [low, high] = this.sectionRange;
    return this.section.at ?? (low + high) / 2;
  }
  /** Normal and offset of the half-space that stays; null without a section. */
  get kept(): [number, number, number, number] | null {
    return this.sectionNormal && [...this.plane.normal.toArray(), this.plane.constant];
  }

  get size(): THREE.Vector3 {
    return this.box.isEmpty() ? new THREE.Vector3() : this.box.getSize(new THREE.Vector3());
  }

  /** Shows both sides of the section plane, for a preview of what becomes of them. */
  setWhole(whole: boolean): void {
    this.whole = whole;
    this.cut();
  }

  cut(): void {
    const normal = this.sectionNormal;
    const sign = this.section.flipped ? 1 : -1;
    if (normal) {
      this.plane.normal.set(...normal).multiplyScalar(sign);
      this.plane.constant = -sign * this.sectionAt;
    }
    for (const level of this.levels) level.cut(!normal || this.whole ? [] : [this.plane]);
  }

  setShading(shading: Shading): void {
    this.shading = shading;
    this.shadeAll();
    this.cut();
  }
  private shadeAll(): void {
    this.showLevel();
    for (const level of this.levels)
      level.shade(this.shading === 'flat', this.shading === 'wire' && level === this.shown);
  }

  /** Points of each joined setup, by which the mesh is coloured. */
  setSetups(clouds: readonly Float32Array[]): void {
    this.setups = clouds;
    for (const picture of this.pictures) for (const level of picture.levels) level.arrays.setups = null;
    this.colorAll();
  }
  setColoring(coloring: Coloring): void {
    this.coloring = coloring;
    this.colorAll();
  }
  /** Chooses the ends of the present scale; null takes the usual ones again. */
  setEnds(ends: Ends | null): void {
    if (ends) this.ends.set(this.coloring, ends);
    else this.ends.delete(this.coloring);
    this.colorAll();
  }
  get hasOwnEnds(): boolean {
    return this.ends.has(this.coloring);
  }
  /** All levels share the scale of the finest one. */
  private colorAll(): void {
    const finest = this.levels.at(-1);
    this.legend = finest ? scaleOf(finest.arrays, this.coloring, this.band, this.ends.get(this.coloring)) : null;
    for (const { arrays } of this.levels)
      if (this.coloring === 'setup' && this.setups.length > 0)
        arrays.setups ??= setupsAt(arrays.positions, arrays.triangles, this.setups);
    for (const level of this.levels) level.color(this.coloring, this.legend);
  }
}
