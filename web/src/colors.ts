export type Rgb = [number, number, number];

/** Samples of viridis (van der Walt, Smith 2015), sRGB. */
const VIRIDIS: Rgb[] = [
  [68, 1, 84],
  [72, 36, 117],
  [65, 68, 135],
  [53, 95, 141],
  [42, 120, 142],
  [33, 145, 140],
  [34, 168, 132],
  [68, 191, 112],
  [122, 209, 81],
  [189, 223, 38],
  [253, 231, 37],
];
/** Light grey, yellow, blue: as the program's pictures show marks. */
export const MARK_COLORS: Rgb[] = [
  [231, 228, 223],
  [231, 199, 97],
  [97, 160, 220],
];

/** Blue and orange for the first two setups, told apart without colour vision; grey where several measured. */
const SETUP_COLORS: Rgb[] = [
  [92, 156, 224],
  [240, 158, 66],
  [120, 190, 130],
  [200, 130, 190],
];
export const SEVERAL_SETUPS: Rgb[] = [[205, 203, 196]];
export const setupColor = (setup: number): Rgb => SETUP_COLORS[setup % SETUP_COLORS.length] as Rgb;

export function viridis(share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (VIRIDIS.length - 1);
  const low = Math.min(VIRIDIS.length - 2, Math.floor(at));
  const t = at - low;
  const a = VIRIDIS[low] as Rgb;
  const b = VIRIDIS[low + 1] as Rgb;
  return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
}

/**
 * Deviations: green within the tolerance, to blue below and to red above it, up to the ends of the scale. The order is that of metrology's usual
 * legends; lightness falls to both sides, so that it is read without colour vision as well.
 */
export function deviationColor(
  value: number,
  [lower, upper]: readonly [number, number],
  [low, high]: readonly [number, number],
): Rgb {
  const ramp = (share: number, colors: readonly Rgb[]): Rgb => {
    const at = Math.min(1, Math.max(0, share)) * (colors.length - 1);
    const low = Math.min(colors.length - 2, Math.floor(at));
    const [a, b] = [colors[low] as Rgb, colors[low + 1] as Rgb];
    return [0, 1, 2].map((i) => (a[i] as number) + ((b[i] as number) - (a[i] as number)) * (at - low)) as Rgb;
  };
  if (value > upper)
    return ramp((value - upper) / (high - upper || 1), [
      [250, 214, 92],
      [240, 134, 55],
      [190, 35, 45],
    ]);
  if (value < lower)
    return ramp((lower - value) / (lower - low || 1), [
      [120, 214, 226],
      [62, 138, 214],
      [44, 52, 150],
    ]);
  const within = value >= 0 ? value / (upper || 1) : value / (lower || 1);
  return ramp(
    within,
    value >= 0
      ? [
          [112, 190, 118],
          [176, 208, 110],
        ]
      : [
          [112, 190, 118],
          [112, 205, 166],
        ],
  );
}

export const css = ([r, g, b]: Rgb): string => `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;

/** The value below which a share of the finite values lies. */
export function quantile(values: ArrayLike<number>, share: number): number {
  const step = Math.max(1, Math.floor(values.length / 50_000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += step) {
    const value = values[i] as number;
    if (Number.isFinite(value)) sample.push(value);
  }
  sample.sort((a, b) => a - b);
  return sample.length ? (sample[Math.floor(share * (sample.length - 1))] as number) : NaN;
}
