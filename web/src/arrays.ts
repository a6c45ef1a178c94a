type Numbers = Float32Array | Uint32Array | Uint16Array | Uint8Array;

/** Reads the arrays that the server packs: a length, a JSON header, the arrays. */
export function unpack(buffer: ArrayBuffer): Map<string, Numbers> {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as {
    arrays: { name: string; type: string; length: number; offset: number }[];
  };
  const arrays = new Map<string, Numbers>();
  for (const { name, type, length: count, offset } of header.arrays) {
    if (type === 'float32') arrays.set(name, new Float32Array(buffer, offset, count));
    else if (type === 'uint32') arrays.set(name, new Uint32Array(buffer, offset, count));
    else if (type === 'uint16') arrays.set(name, new Uint16Array(buffer, offset, count));
    else if (type === 'uint8') arrays.set(name, new Uint8Array(buffer, offset, count));
  }
  return arrays;
}

/** What stands beside the arrays, such as the figures of a live picture. */
export function valuesOf<T>(buffer: ArrayBuffer): T {
  const length = new DataView(buffer).getUint32(0, true);
  return (JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as { values: T }).values;
}

export interface MeshArrays {
  positions: Float32Array;
  triangles: Uint32Array;
  normals: Float32Array;
  sigma: Float32Array | null;
  views: Uint16Array | null;
  marks: Uint8Array | null;
  /** From the reference, mm; NaN where it was not compared. */
  deviation: Float32Array | null;
  /** Bits of the joined setups that measured a vertex; null until that is asked for. */
  setups: Uint8Array | null;
}

export function meshOf(buffer: ArrayBuffer): MeshArrays {
  const arrays = unpack(buffer);
  return {
    positions: arrays.get('positions') as Float32Array,
    triangles: arrays.get('triangles') as Uint32Array,
    normals: arrays.get('normals') as Float32Array,
    sigma: (arrays.get('sigma_mm') as Float32Array | undefined) ?? null,
    views: (arrays.get('views') as Uint16Array | undefined) ?? null,
    marks: (arrays.get('marks') as Uint8Array | undefined) ?? null,
    deviation: null,
    setups: null,
  };
}
