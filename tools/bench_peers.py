#!/usr/bin/env python3
"""Compares Frangia with NumPy, OpenCV contrib and scikit-image on the data of the phase benchmark, on one core.

usage: bench_peers.py FOLDER    the folder of phase.json and data/ that `./run bench` writes

Prints how many times longer each peer takes, and how many fringe orders each gets wrong; writes peers.json.
Decoding by NumPy is measured in two states, each against Frangia in the same state:

cold  results go to memory that is touched for the first time, as in a single call
warm  results go to memory that an earlier call used, as in a loop over views: NumPy with `out=` on preallocated
      arrays, in blocks of rows that stay in the cache; Frangia with the map of the previous call

Only the warm figure compares the computations; docs/phase.md quotes it. A peer that is not installed is named and
skipped. Debian: python3-numpy, python3-skimage, python3-opencv.
"""

import json
import math
import os
import sys
import time

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")


WARM_RUNS = 4  # the first one warms memory and caches
ROWS = 64  # of a block of the warm NumPy decoder; 4 to 4500 rows differ by less than 10 %


def ours(folder):
    """Seconds of Frangia's 20 Mpx benchmarks, by name."""
    with open(os.path.join(folder, "phase.json"), encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    return {run["name"]: run["cpu_time"] * 1e-3 for run in runs}


def seconds(work, runs=2):
    """The fastest of some runs, and the result of the last."""
    best = math.inf
    for _ in range(runs):
        begin = time.process_time()
        result = work()
        best = min(best, time.process_time() - begin)
    return best, result


def adds_per_ns(np):
    """Current speed of a core: additions of floats in the cache."""
    a = np.ones(4096, np.float32)
    begin = time.process_time()
    for _ in range(20000):
        a += 1
    return 20000 * 4096 / (time.process_time() - begin) * 1e-9


def connected_components(np, phase):
    """Connected components of a phase without regions, numbered from 1; 0 where it is missing."""
    from scipy import ndimage

    return ndimage.label(np.isfinite(phase))[0]


def separate_fraction(np, components, phase):
    """Fraction of the pixels that are connected to others but belong to a smaller region."""
    whole = connected_components(np, phase)
    known = components > 0
    span = int(components.max()) + 1
    pairs, sizes = np.unique(whole[known] * np.int64(span) + components[known], return_counts=True)
    largest = np.zeros(int(whole.max()) + 1, np.int64)
    np.maximum.at(largest, pairs // span, sizes)
    return 1.0 - largest.sum() / known.sum()


def wrong_fraction(np, components, phase, truth):
    """Fraction of the pixels whose order differs from the majority of their component."""
    count = int(components.max())
    known = components > 0
    orders = np.rint((phase[known] - truth[known]) / (2 * np.pi)).astype(np.int64)
    orders -= orders.min()
    span = int(orders.max()) + 1
    pairs, votes = np.unique(components[known] * np.int64(span) + orders, return_counts=True)
    best = np.zeros(count + 1, np.int64)
    np.maximum.at(best, pairs // span, votes)
    return 1.0 - best.sum() / known.sum()


def decode_cold(np, frames):
    """Schwider's algorithm with new arrays for every step, as it is usually written."""
    a, b, c, d = (frame.astype(np.float32) for frame in frames)
    sine, cosine = a - 3 * b + c + d, a + b - 3 * c + d
    modulation = np.hypot(sine, cosine) / 4
    mean = (a + b + c + d) / 4
    sigma = 0.866 * np.sqrt(4.08 + 0.2 * mean) / np.maximum(modulation, 1e-9)
    mask = (sigma < 0.1) & (np.maximum.reduce([a, b, c, d]) < 255)
    return np.where(mask, np.arctan2(sine, cosine), np.nan), modulation, mean, sigma


def warm_decoder(np, frames):
    """The same computation on preallocated arrays, in blocks of rows; call the result to decode."""
    height, width = frames[0].shape
    phase, modulation, mean, sigma = (np.ones((height, width), np.float32) for _ in range(4))
    block = [np.ones((ROWS, width), np.float32) for _ in range(6)]
    counts8 = np.ones((ROWS, width), np.uint8)
    flags = [np.ones((ROWS, width), bool) for _ in range(2)]
    constant = np.float32

    def decode():
        for begin in range(0, height, ROWS):
            rows = slice(begin, min(height, begin + ROWS))
            count = rows.stop - begin
            a, b, c, d, sine, cosine = (array[:count] for array in block)
            brightest, bad, saturated = counts8[:count], flags[0][:count], flags[1][:count]
            for counts, frame in zip((a, b, c, d), frames):
                np.copyto(counts, frame[rows])
            mean_, modulation_, sigma_ = mean[rows], modulation[rows], sigma[rows]
            np.add(a, b, out=mean_)
            mean_ += c
            mean_ += d
            np.multiply(b, constant(4), out=sine)
            np.subtract(mean_, sine, out=sine)
            np.multiply(c, constant(4), out=cosine)
            np.subtract(mean_, cosine, out=cosine)
            mean_ *= constant(0.25)
            np.multiply(sine, sine, out=a)
            np.multiply(cosine, cosine, out=b)
            a += b
            np.sqrt(a, out=modulation_)
            modulation_ *= constant(0.25)
            np.multiply(mean_, constant(0.2), out=sigma_)
            sigma_ += constant(4.08)
            np.sqrt(sigma_, out=sigma_)
            sigma_ *= constant(0.866)
            np.maximum(modulation_, constant(1e-9), out=a)
            sigma_ /= a
            np.maximum(frames[0][rows], frames[1][rows], out=brightest)
            np.maximum(brightest, frames[2][rows], out=brightest)
            np.maximum(brightest, frames[3][rows], out=brightest)
            np.greater_equal(sigma_, constant(0.1), out=bad)
            np.greater_equal(brightest, 255, out=saturated)
            np.logical_or(bad, saturated, out=bad)
            np.arctan2(sine, cosine, out=phase[rows])
            np.copyto(phase[rows], np.nan, where=bad)
        return phase, modulation, mean, sigma

    return decode


def main(folder):
    times = ours(folder)
    try:
        import numpy as np
    except ImportError:
        print("NumPy is absent (python3-numpy): nothing to compare with")
        return
    data = os.path.join(folder, "data")
    side = math.isqrt(os.path.getsize(os.path.join(data, "frame-0.u8")))

    def load(name, kind):
        return np.fromfile(os.path.join(data, name), kind).reshape(side, side)

    frames = [load(f"frame-{k}.u8", np.uint8) for k in range(4)]
    wrapped, truth = load("wrapped.f32", np.float32), load("truth.f32", np.float32)
    results = {"megapixels": side * side / 1e6}

    def met(name, value, limit, unit, at_most):
        """Prints a figure, its limit and whether the limit holds."""
        holds = value <= limit if at_most else value >= limit
        results[name] = {"value": value, "limit": limit, "met": bool(holds)}
        print(
            f"{name:<44}{value:10.3g} {unit:<6} {'at most' if at_most else 'at least'} {limit:<6g} "
            f"{'met' if holds else 'MISSED'}"
        )

    def compare(task, peer, theirs, mine, wanted=None):
        """Prints how many times longer a peer takes; with a limit, whether it holds."""
        results[f"{task}: {peer}"] = {"seconds": theirs, "ours": mine, "ratio": theirs / mine}
        if wanted is None:
            print(f"{f'{task}: {peer}, times ours':<44}{theirs / mine:10.3g} times")
        else:
            met(f"{task}: {peer}, times ours", theirs / mine, wanted, "times", False)

    pixels = side * side
    # Limits in seconds hold for an idle machine; the speed of the core shows how idle it was.
    results["adds_per_ns"] = adds_per_ns(np)
    print(f"one core currently adds {results['adds_per_ns']:.2f} floats per ns")
    met("decode, ns per pixel", times["decode/schwider/20"] * 1e9 / pixels, 3.0, "ns", True)
    for name in ("doubling", "negative_exponential"):
        met(f"seven maps {name}, ns per pixel", times[f"decode_maps/{name}/20"] * 1e9 / pixels, 12.0, "ns", True)
    met("spatial unwrapping, s", times["unwrap_space/20"], 1.0, "s", True)

    decode_ours = times["decode/schwider/20"]
    if "decode_cold/schwider/20" in times:
        compare(
            "decode", "NumPy, both cold", seconds(lambda: decode_cold(np, frames))[0], times["decode_cold/schwider/20"]
        )
    warm = warm_decoder(np, frames)
    warm_seconds, decoded = seconds(warm, WARM_RUNS)
    for name, one, other in zip(("phase", "modulation", "mean", "sigma"), decoded, decode_cold(np, frames)):
        if not np.allclose(one, other, rtol=1e-4, atol=1e-3, equal_nan=True):
            sys.exit(f"the two NumPy decoders differ in {name}")
    compare("decode", "NumPy, both warm", warm_seconds, decode_ours, 4)
    results["decode, NumPy warm, ns per pixel"] = warm_seconds * 1e9 / pixels
    print(f"NumPy warm takes {warm_seconds * 1e9 / pixels:.3g} ns per pixel")
    try:
        import cv2

        cv2.setNumThreads(1)
        parameters = cv2.structured_light_SinusoidalPattern_Params()
        parameters.height, parameters.width = side, side
        parameters.nbrOfPeriods, parameters.horizontal = 40, False
        parameters.methodId = cv2.structured_light.PSP
        parameters.setMarkers = False
        parameters.shiftValue = math.pi / 2
        pattern = cv2.structured_light.SinusoidalPattern_create(parameters)
        # It filters each frame by Fourier transforms and fails for sides that are not products of small primes;
        # the benchmark's side is one.
        compare(
            "decode", "OpenCV, warm", seconds(lambda: pattern.computePhaseMap(frames[:3]), WARM_RUNS)[0], decode_ours, 8
        )
    except (ImportError, AttributeError) as error:
        print(f"OpenCV contrib is absent (python3-opencv): {error}")
    except Exception as error:  # the bindings differ between versions
        print(f"OpenCV contrib's decoder does not run: {error}")
    try:
        from skimage.restoration import unwrap_phase

        # Its sort does not terminate on NaN, even if masked.
        masked = np.ma.array(np.nan_to_num(wrapped), mask=np.isnan(wrapped))
        taken, unwrapped = seconds(lambda: unwrap_phase(masked))
        compare("spatial unwrapping", "scikit-image", taken, times["unwrap_space/20"], 8)
        mine = load("unwrapped.f32", np.float32)
        regions = load("region.i32", np.int32) + 1
        own_fraction = wrong_fraction(np, regions, mine, truth)
        results["wrong fraction, ours"] = own_fraction
        results["fraction kept separate, ours"] = separate_fraction(np, regions, mine)
        other = np.ma.filled(unwrapped, np.nan)
        theirs = wrong_fraction(np, connected_components(np, other), other, truth)
        results["wrong fraction, scikit-image"] = theirs
        met("wrong fringe order, fraction of pixels", own_fraction, theirs, "", True)
        print(f"kept as separate regions: {results['fraction kept separate, ours']:.2e} of pixels")
    except ImportError:
        print("scikit-image is absent (python3-skimage)")
    with open(os.path.join(folder, "peers.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=2)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
