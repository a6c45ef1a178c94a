import * as THREE from 'three';

import type { MeshArrays } from './arrays';
import { type Coloring, type Legend, scaleOf } from './mesh_colors';
import { MeshLevel } from './mesh_level';
import { setupsAt } from './setup_cells';

export type Shading = 'smooth' | 'flat' | 'wire';
export type SectionAxis = 'off' | 'x' | 'y' | 'z';

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
  section: { axis: SectionAxis; share: number; flipped: boolean } = { axis: 'off', share: 0.5, flipped: false };
  private pictures: Picture[] = [];
  private current: Picture | null = null;
  private moving = false;
  private whole = false;
  private shading: Shading = 'smooth';
  private coloring: Coloring = 'plain';
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

  /** Position of the section plane, mm. */
  get sectionAt(): number {
    const { axis, share } = this.section;
    if (axis === 'off' || this.box.isEmpty()) return 0;
    return this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
  }
  /** Normal and offset of the half-space that stays; null without a section. */
  get kept(): [number, number, number, number] | null {
    return this.section.axis === 'off' ? null : [...this.plane.normal.toArray(), this.plane.constant];
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
    const { axis, flipped } = this.section;
    const sign = flipped ? 1 : -1;
    if (axis !== 'off') {
      this.plane.normal.set(axis === 'x' ? sign : 0, axis === 'y' ? sign : 0, axis === 'z' ? sign : 0);
      this.plane.constant = -sign * this.sectionAt;
    }
    for (const level of this.levels) level.cut(axis === 'off' || this.whole ? [] : [this.plane]);
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
  /** All levels share the scale of the finest one. */
  private colorAll(): void {
    const finest = this.levels.at(-1);
    this.legend = finest ? scaleOf(finest.arrays, this.coloring, this.band) : null;
    for (const { arrays } of this.levels)
      if (this.coloring === 'setup' && this.setups.length > 0)
        arrays.setups ??= setupsAt(arrays.positions, arrays.triangles, this.setups);
    for (const level of this.levels) level.color(this.coloring, this.legend);
  }
}
