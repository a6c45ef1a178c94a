/** A file with its place in a folder, such as "views/000/a.png". */
export interface PlacedFile {
  path: string;
  file: File;
}

/** More need zip64. */
export const MOST_FILES = 65535;

const CRC = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let bit = 0; bit < 8; bit++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (CRC[(crc ^ byte) & 0xff] as number) ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
}

/** Little-endian numbers, each with its size in bytes. */
function packed(...numbers: [value: number, bytes: 2 | 4][]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(numbers.reduce((sum, [, size]) => sum + size, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [value, size] of numbers) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return bytes;
}

/** An archive of files, which are stored as they are: images are compressed already. At most 4 GB and MOST_FILES. */
export async function zipOf(files: readonly PlacedFile[]): Promise<Blob> {
  const UTF8 = 0x0800;
  const VERSION = 20;
  const FIRST_OF_JANUARY_1980 = 0x21;
  const parts: BlobPart[] = [];
  const directory: BlobPart[] = [];
  let at = 0;
  let directoryBytes = 0;
  for (const { path, file } of files) {
    const name = new TextEncoder().encode(path);
    const crc = crc32(new Uint8Array(await file.arrayBuffer()));
    const common: [number, 2 | 4][] = [
      [VERSION, 2],
      [UTF8, 2],
      [0, 2],
      [0, 2],
      [FIRST_OF_JANUARY_1980, 2],
      [crc, 4],
      [file.size, 4],
      [file.size, 4],
      [name.length, 2],
      [0, 2],
    ];
    const local = packed([0x04034b50, 4], ...common);
    const entry = packed([0x02014b50, 4], [VERSION, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]);
    parts.push(local, name, file);
    directory.push(entry, name);
    at += local.length + name.length + file.size;
    directoryBytes += entry.length + name.length;
  }
  const end = packed(
    [0x06054b50, 4],
    [0, 2],
    [0, 2],
    [files.length, 2],
    [files.length, 2],
    [directoryBytes, 4],
    [at, 4],
    [0, 2],
  );
  return new Blob([...parts, ...directory, end]);
}
