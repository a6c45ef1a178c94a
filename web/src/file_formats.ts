/** Endings of files with a measured surface. */
export const MESH_FORMATS = ['stl', 'ply', 'obj', '3mf', 'glb', 'gltf', 'off', 'dxf'];
/** Endings of files that open as a surface. */
export const SURFACE_FORMATS = [...MESH_FORMATS, 'xyz', 'pcd', 'step', 'stp', 'iges', 'igs'];
/** Endings of references whose faces are known. */
export const CAD_FORMATS = ['step', 'stp'];
/** Endings of files that a surface is compared with. */
export const REFERENCE_FORMATS = ['stl', 'ply', 'obj', '3mf', ...CAD_FORMATS];

/** The ending of a file's name, if it is one of the formats. */
export function formatOf(name: string, formats: readonly string[]): string | undefined {
  const ending = /\.([^./]+)$/.exec(name)?.[1]?.toLowerCase();
  return ending !== undefined && formats.includes(ending) ? ending : undefined;
}

/** The value of `accept` of an input for such files. */
export const accepted = (formats: readonly string[]): string => formats.map((format) => `.${format}`).join();
