import type { Store } from './store';
import type { Exporting } from './exporting';
import { formatOf, MESH_FORMATS, REFERENCE_FORMATS } from './file_formats';
import { currentLanguage, number, t } from './messages';
import type { Drawn } from './ruler';
import { requireSendable } from './session';
import type { CharacteristicKind, Plan, PlannedCharacteristic, PlannedFeature } from './inspection_types';
import type { FoundFeature, Inspection, Triple } from './types';
import type { Viewer } from './viewer';
import type { PickedFace } from './viewer_events';

/** The name of the next part: the number at the end of this one's grows. */
export function nextName(name: string, taken: readonly string[]): string {
  const [, base, digits] = /^(.*?)(\d*)$/.exec(name) as unknown as [string, string, string];
  for (let i = Number(digits || 1) + 1; ; i++) {
    const next = `${digits ? base : `${base} `}${String(i).padStart(digits.length, '0')}`;
    if (!taken.includes(next)) return next;
  }
}

/** The plan that is inspected by until one is made. */
const USUAL: Plan = {
  format: 'frangia-inspection',
  version: 1,
  align: 'best-fit',
  tolerance_mm: [-0.1, 0.1],
};

type Vector = readonly number[];
/** A place, which the server sends as null where it is not finite. */
const placed = (at: readonly (number | null)[]): Triple => at.map((one) => one ?? NaN) as Triple;
const dot = (a: Vector, b: Vector): number => a.reduce((sum, one, i) => sum + one * (b[i] as number), 0);

/** How far a point is from the surface of a feature, mm; infinite where the page does not know its shape. */
function distanceTo({ kind, at_mm, axis, diameter_mm, half_angle_deg }: FoundFeature, point: Vector): number {
  const from = point.map((one, i) => one - (at_mm[i] as number));
  const along = dot(from, placed(axis));
  const away = Math.hypot(...from);
  const across = Math.sqrt(Math.max(0, away * away - along * along));
  const radius = (diameter_mm ?? 0) / 2;
  if (kind === 'plane') return Math.abs(along);
  if (kind === 'sphere') return Math.abs(away - radius);
  if (kind === 'cylinder') return Math.abs(across - radius);
  if (kind !== 'cone') return Infinity;
  const slope = Math.tan(((half_angle_deg ?? 0) * Math.PI) / 180);
  return Math.min(Math.abs(across - radius - slope * along), Math.abs(across - radius + slope * along));
}

/** The feature that a point of the surface belongs to: the nearest one, and of those the one whose center is nearest. */
export function featureAt(features: readonly FoundFeature[], point: Vector): number | null {
  const OF_CENTER = 0.002;
  let best: number | null = null;
  let least = Infinity;
  features.forEach((feature, i) => {
    const center = Math.hypot(...point.map((one, k) => one - (feature.at_mm[k] as number)));
    const far = distanceTo(feature, point) + OF_CENTER * center;
    if (far >= least) return;
    least = far;
    best = i;
  });
  return best;
}

/** The reference, the plan and the inspection of the surface. */
export class Inspecting {
  /** Share of a reference that has been sent; null while none is. */
  sent: number | null = null;
  /** Whether the places that are out or undecided are ringed in the picture. */
  placesShown = false;
  /** Index of the place that was looked at last. */
  placeChosen: number | null = null;
  /** The kind of the characteristic that is being added. */
  kind: CharacteristicKind = 'distance';
  /** Index of the feature that was clicked last. */
  chosen: number | null = null;

  /** The inspection that was there when a new one was asked for, whose deviations are shown when it comes. */
  private wantedAfter: number | null = null;
  private report: { job: number; name: string } | null = null;

  constructor(
    private readonly app: Store,
    private readonly exporting: Exporting,
  ) {}

  get plan(): Plan {
    return this.app.project.plan ?? USUAL;
  }
  get found(): Inspection | null {
    return this.app.state.project?.surface?.inspection ?? null;
  }

  async send(file: File): Promise<void> {
    const { app } = this;
    const format = formatOf(file.name, REFERENCE_FORMATS);
    if (!format) return app.say(t('inspect.wrongFile'));
    try {
      requireSendable(file.size);
      this.sent = 0;
      await app.session.send(file, (share) => {
        this.sent = share;
        app.requestUpdate();
      });
      await app.session.command('set-reference', { name: file.name.slice(0, 120), format, bytes: file.size });
      this.sent = null;
      await this.run();
    } catch (error) {
      app.say(error);
    }
    this.sent = null;
    app.requestUpdate();
  }

  /** Begins the next part by the same plan: in a project of its own, to be scanned, or from a file that `into` brings into it. */
  async next(file?: File, into?: (file: File, format: string) => Promise<void>): Promise<void> {
    const { app } = this;
    const format = file && formatOf(file.name, MESH_FORMATS);
    if (file && !format) return app.say(t('inspect.wrongFile'));
    const taken = app.state.projects.map(({ name }) => name);
    const wanted = await app.asking.write(t('series.ask'), nextName(app.project.name, taken), t('series.begin'));
    if (wanted === null || !(await app.command('next-part', { name: wanted }))) return;
    if (!file || !format || !into) return app.go('scan');
    try {
      await into(file, format);
    } catch (error) {
      app.say(error);
    }
  }

  /** Inspects by the present plan; `features` looks for all features, to choose from. */
  async run(features = this.found?.searched ?? false): Promise<void> {
    const before = this.revision;
    if (await this.app.command('inspect', { features })) this.wantedAfter = before;
    this.follow();
  }
  /** Changes what stands at the head of the report. */
  head(change: Pick<Partial<Plan>, 'part' | 'report'>): void {
    void this.app.command('set-plan', { plan: { ...this.plan, ...change } });
  }
  /** Changes the plan, and inspects by it where something can be measured. */
  async change(change: Partial<Plan>): Promise<void> {
    const plan = { ...this.plan, ...change };
    if (!(await this.app.command('set-plan', { plan }))) return;
    if (this.app.project.reference || plan.features?.length) await this.run();
  }
  async open(file: File): Promise<void> {
    const LARGEST = 500_000;
    if (file.size > LARGEST) return this.app.say(t('inspect.wrongPlan'));
    if (!(await this.app.command('open-plan', { text: await file.text() }))) return;
    if (this.app.project.reference || this.plan.features?.length) await this.run();
  }

  /** A name that no feature or characteristic of the plan has. */
  private freeName(word: string): string {
    const names = [...(this.plan.features ?? []), ...(this.plan.characteristics ?? [])].map(({ name }) => name);
    for (let i = 1; ; i++) if (!names.includes(`${word} ${i}`)) return `${word} ${i}`;
  }
  /** Takes a feature that was found into the plan. */
  add(feature: FoundFeature): void {
    const planned: PlannedFeature = {
      name: this.freeName(t(`inspect.kind.${feature.kind}`)),
      kind: feature.kind,
      near_mm: placed(feature.near_mm).map((one) => Number(one.toFixed(3))) as [number, number, number],
    };
    if (feature.nominal_mm !== null) planned.diameter_mm = Number(feature.nominal_mm.toFixed(6));
    else if (feature.diameter_mm !== null && feature.kind !== 'line')
      planned.diameter_mm = Number(feature.diameter_mm.toFixed(2));
    this.chosen = null;
    void this.change({ features: [...(this.plan.features ?? []), planned] });
  }
  /** Takes a face of the reference into the plan, which states kind, place and size. */
  addFace({ number: face, kind }: PickedFace): void {
    if (!kind) return;
    const planned: PlannedFeature = { name: this.freeName(t(`inspect.kind.${kind}`)), face };
    void this.change({ features: [...(this.plan.features ?? []), planned] });
  }
  /** A feature as it was found; one that a face states tells its kind and place there alone. */
  foundOf(planned: PlannedFeature): FoundFeature | undefined {
    return this.found?.features.find(({ name }) => name === planned.name);
  }
  /** Gives a feature or characteristic another name, also where others refer to it. */
  rename(name: string, wanted: string): void {
    const { plan } = this;
    const names = [...(plan.features ?? []), ...(plan.characteristics ?? [])].map((one) => one.name);
    if (wanted === name || !wanted) return this.app.requestUpdate();
    if (names.includes(wanted)) return this.app.say(t('inspect.nameTaken', { name: wanted }));
    const to = <T extends string | undefined>(one: T) => (one === name ? wanted : one);
    void this.change({
      features: (plan.features ?? []).map((one) => ({ ...one, name: to(one.name) })),
      characteristics: (plan.characteristics ?? []).map((one) => ({
        ...one,
        name: to(one.name),
        ...(one.feature === undefined ? {} : { feature: to(one.feature) }),
        ...(one.datum === undefined ? {} : { datum: to(one.datum) }),
      })),
      ...(plan.datums ? { datums: plan.datums.map(to) } : {}),
    });
  }
  changeFeature(name: string, change: Partial<PlannedFeature>): void {
    void this.change({
      features: (this.plan.features ?? []).map((one) => (one.name === name ? { ...one, ...change } : one)),
    });
  }
  /** Takes a feature out of the plan, and with it what refers to it. */
  removeFeature(name: string): void {
    const { plan } = this;
    const datums = (plan.datums ?? []).filter((one) => one !== name);
    void this.change({
      features: (plan.features ?? []).filter((one) => one.name !== name),
      characteristics: (plan.characteristics ?? []).filter((one) => one.feature !== name && one.datum !== name),
      datums,
      ...(plan.align === 'datum' && datums.length === 0 ? { align: 'best-fit' } : {}),
    });
  }
  addCharacteristic(wanted: Omit<PlannedCharacteristic, 'name'>): void {
    const name = this.freeName(t(`inspect.what.${wanted.kind}`));
    void this.change({ characteristics: [...(this.plan.characteristics ?? []), { name, ...wanted }] });
  }
  removeCharacteristic(name: string): void {
    void this.change({ characteristics: (this.plan.characteristics ?? []).filter((one) => one.name !== name) });
  }

  /** A click on the surface chooses the feature there. */
  picked(point: [number, number, number]): void {
    this.chosen = featureAt(this.found?.features ?? [], point);
    this.app.requestUpdate();
  }
  choose(index: number | null): void {
    this.chosen = index;
    this.app.requestUpdate();
  }
  chooseKind(kind: CharacteristicKind): void {
    this.kind = kind;
    this.app.requestUpdate();
  }
  showPlaces(shown: boolean): void {
    this.placesShown = shown;
    this.placeChosen = null;
    this.app.requestUpdate();
  }
  /** Looks at a place from where it faces, and rings it alone; a second time rings all of them again. */
  choosePlace(index: number, viewer: Viewer): void {
    const place = this.found?.places[index];
    this.placeChosen = this.placeChosen === index ? null : index;
    if (place && this.placeChosen !== null && viewer.supported)
      viewer.view.visit(
        placed(place.at_mm),
        placed(place.normal),
        Math.max(viewer.size.length() / 8, 1.5 * place.area_mm2 ** 0.5),
      );
    this.app.requestUpdate();
  }
  /** What is ringed in the picture. */
  get marks(): { center_mm: [number, number, number]; size_mm: number }[] {
    const { found } = this;
    if (!found) return [];
    const feature = this.chosen === null ? undefined : found.features[this.chosen];
    const places = this.placesShown && found.current ? found.places : [];
    const alone = this.placeChosen === null ? undefined : places[this.placeChosen];
    return [
      ...(alone ? [alone] : places).map(({ at_mm, area_mm2 }) => ({
        center_mm: placed(at_mm),
        size_mm: Math.sqrt(area_mm2),
      })),
      ...(feature ? [{ center_mm: placed(feature.at_mm), size_mm: feature.diameter_mm ?? 0 }] : []),
    ];
  }

  /** What was measured of the features of the plan, for the picture: the worst first. */
  get labels(): Drawn[] {
    const MOST = 12; // more cover each other and the part
    const { found, plan } = this;
    if (found && !found.current && !this.app.occupied) return [];
    const features = plan.features ?? [];
    const ofName = (name: string) =>
      (plan.characteristics ?? []).find((one) => one.name === name)?.feature ??
      features
        .map((one) => one.name)
        .filter((one) => name.startsWith(`${one} `))
        .sort((a, b) => b.length - a.length)[0];
    const order = ['out', 'undecided', 'in'];
    return (found?.characteristics ?? [])
      .flatMap((row) => {
        const feature = found?.features.find(({ name }) => name !== null && name === ofName(row.name));
        if (!feature || row.value === null) return [];
        const at = placed(feature.at_mm);
        const value = `${number(row.value, row.unit === 'mm' ? 3 : 2)}${row.unit === 'mm' ? ' mm' : '°'}`;
        return [
          {
            key: `row ${row.name}`,
            text: `${row.name}: ${value}`,
            verdict: row.verdict,
            points: [at],
            from: at,
            to: at,
          },
        ];
      })
      .sort((a, b) => order.indexOf(a.verdict ?? 'in') - order.indexOf(b.verdict ?? 'in'))
      .slice(0, MOST);
  }

  /** Writes a report, or the plan, and downloads it when it is there. */
  async write(format: 'html' | 'pdf' | 'csv' | 'qif' | 'toml'): Promise<void> {
    try {
      const { job } = await this.app.session.command<{ job: number }>('report', {
        format,
        language: currentLanguage(),
      });
      const name = format === 'toml' ? 'inspection.toml' : `${this.app.project.name} report.${format}`;
      this.report = { job, name };
      this.follow();
    } catch (error) {
      this.app.say(error);
    }
  }

  /** Writes the certificate of the acceptance test, and downloads it when it is there. */
  async certify(): Promise<void> {
    try {
      const { job } = await this.app.session.command<{ job: number }>('certificate', { format: 'pdf' });
      this.report = { job, name: `${this.app.project.name} certificate.pdf` };
      this.follow();
    } catch (error) {
      this.app.say(error);
    }
  }

  private get revision(): number {
    return this.found?.revision ?? -1;
  }
  /** Shows the deviations that were asked for, and none that there are no longer. */
  follow(): void {
    const { app, revision } = this;
    // Results of another plan or reference color nothing, unless new ones are on their way.
    const compared = Boolean(app.state.project?.surface?.comparison) && (this.found?.current || app.occupied);
    if (revision >= 0 && this.wantedAfter !== null && this.wantedAfter !== revision) {
      this.wantedAfter = null;
      if (compared) app.setLook({ coloring: 'deviation' });
    }
    if (this.placeChosen !== null && this.placeChosen >= (this.found?.places.length ?? 0)) this.placeChosen = null;
    if (this.chosen !== null && this.chosen >= (this.found?.features.length ?? 0)) this.chosen = null;
    if (!compared && app.look.coloring === 'deviation') app.setLook({ coloring: 'plain' });
    const job = this.report && app.state.jobs.find((one) => one.number === this.report?.job);
    if (!this.report || !job || job.state === 'waiting' || job.state === 'running') return;
    const { name } = this.report;
    this.report = null;
    if (job.state === 'done') void this.exporting.download(name);
  }
}
