import { CAD_FORMATS, formatOf, SURFACE_FORMATS } from './file_formats';
import { number, t } from './messages';
import { MOST_FILES, type PlacedFile } from './zip_files';

/** What files are that were dropped or chosen together: one thing that can be opened. */
export type Dropped =
  | { kind: 'scan'; name: string; files: PlacedFile[] }
  | { kind: 'zip'; file: File }
  | { kind: 'part'; file: File; reference?: File; plan?: File }
  | { kind: 'rig'; file: File; covariance?: File }
  | { kind: 'plan'; file: File };

const CAD = [...CAD_FORMATS, 'iges', 'igs'];
/** Names that a sentence lists. */
const MOST_NAMES = 3;

/** The files below an entry that was dropped, without hidden ones. */
async function below(entry: FileSystemEntry, folder: string): Promise<PlacedFile[]> {
  const path = `${folder}${entry.name}`;
  if (entry.isFile)
    return [{ path, file: await new Promise<File>((done, fail) => (entry as FileSystemFileEntry).file(done, fail)) }];
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: PlacedFile[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, fail) => reader.readEntries(done, fail));
    if (some.length === 0) return found;
    for (const one of some) if (!one.name.startsWith('.')) found.push(...(await below(one, `${path}/`)));
  }
}

/** The files that were dropped, with those of folders. Throws a sentence for what holds none, or cannot be read. */
export async function filesOf(data: DataTransfer): Promise<PlacedFile[]> {
  // Taken before anything is awaited: the browser clears them when the event has ended.
  const entries = [...data.items].map((item) => item.webkitGetAsEntry()).filter((one) => one !== null);
  const found: PlacedFile[] = [];
  for (const entry of entries) {
    try {
      found.push(...(await below(entry, '')));
    } catch {
      throw new Error(t('open.unreadable', { name: entry.name }));
    }
  }
  if (found.length === 0) throw new Error(t('open.empty', { name: entries[0]?.name ?? '' }));
  return found.sort((a, b) => (a.path < b.path ? -1 : 1)); // a folder names its files in any order
}

const formatOfToml = async (file: File): Promise<string | undefined> =>
  /^\s*format\s*=\s*["']([^"']*)["']/m.exec(await file.slice(0, 65536).text())?.[1];

/**
 * What the files are. A scan takes all of its folder; a mesh may come with the CAD file that it is compared with and with
 * a plan of its inspection, a rig with its covariance. Throws a sentence where that leaves none, or several.
 */
export async function sortOut(files: readonly PlacedFile[]): Promise<Dropped> {
  const named = (pattern: RegExp) => files.filter(({ path }) => pattern.test(path));
  const several = (found: readonly PlacedFile[]) => {
    const names = found.slice(0, MOST_NAMES).map(({ path }) => path);
    const rest = found.length > MOST_NAMES ? ', …' : '';
    return new Error(t('open.several', { count: found.length, names: `${names.join(', ')}${rest}` }));
  };
  const folderOf = ({ path }: PlacedFile) => path.slice(0, path.lastIndexOf('/') + 1);
  const allScans = named(/(^|\/)scan\.toml$/i);
  // A scan holds more of the name in its folders, as it was captured.
  const scans = allScans.filter(
    (one) => !allScans.some((outer) => outer !== one && one.path.startsWith(folderOf(outer))),
  );
  const [scan] = scans;
  if (scans.length > 1) throw several(scans);
  if (scan) {
    const folder = folderOf(scan);
    const own = files.filter(({ path }) => path.startsWith(folder));
    if (own.length > MOST_FILES) throw new Error(t('open.many', { files: number(own.length) }));
    return { kind: 'scan', name: folder.split('/').at(-2) ?? '', files: own };
  }
  const zips = named(/\.zip$/i);
  const surfaces = files.filter(({ path }) => formatOf(path, SURFACE_FORMATS));
  const cads = surfaces.filter(({ path }) => formatOf(path, CAD));
  const meshes = surfaces.filter((one) => !cads.includes(one));
  const tomls = await Promise.all(
    named(/\.toml$/i).map(async (one) => ({ ...one, format: await formatOfToml(one.file) })),
  );
  const plans = tomls.filter(({ format }) => format === 'frangia-inspection');
  const rigs = tomls.filter(({ format }) => format !== 'frangia-inspection');
  const things = [zips, meshes, cads, rigs, plans];
  const withPart = zips.length + rigs.length === 0 && surfaces.length > 0;
  if (things.some(({ length }) => length > 1) || (!withPart && things.flat().length > 1)) throw several(things.flat());
  const [part] = meshes.length > 0 ? meshes : cads;
  const [zip, rig, plan, reference] = [zips[0], rigs[0], plans[0], part === cads[0] ? undefined : cads[0]];
  if (part)
    return {
      kind: 'part',
      file: part.file,
      ...(reference ? { reference: reference.file } : {}),
      ...(plan ? { plan: plan.file } : {}),
    };
  if (zip) return { kind: 'zip', file: zip.file };
  if (plan) return { kind: 'plan', file: plan.file };
  const [covariance] = named(/\.csv$/i);
  if (rig) return { kind: 'rig', file: rig.file, ...(covariance ? { covariance: covariance.file } : {}) };
  throw new Error(t('open.unknown', { name: files[0]?.path.split('/')[0] ?? '' }));
}
