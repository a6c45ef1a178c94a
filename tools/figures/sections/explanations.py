"""Faults of single frames: which causes are named, and whether sound frames are blamed."""
import functools
import shutil

import cv2
import numpy as np

from fringe_scenes import FIELD, GAIN_E, READ_E, Scene, fringes, small_rig, toml_of, wall

PAGE = "figures-capture.md"
TITLE = "What explains the frames of a pattern"

STEPS = [3, 4, 5, 6, 12]
SEEDS = 20
PART_SEEDS = 3
PARTS = ["plate", "bracket", "blade"]
COUNT = 24  # fringes of the pattern with the fault


def black(light, k, generator):
    light[k] = 0 * light[k]


def dim(light, k, generator):
    light[k] = 0.05 * light[k]


def white(light, k, generator):
    light[k] = 0 * light[k] + 9


def half(light, k, generator):
    light[k] = 0.5 * light[k]


def repeated(light, k, generator):
    light[k] = light[k - 1]


def exchanged(light, k, generator):
    light[k], light[k - 1] = light[k - 1], light[k]


def late(light, k, generator):
    light[k:] = light[k - 1 : -1]


def torn(light, k, generator):
    rows = len(light[k]) // 2
    light[k] = np.concatenate([light[k - 1][:rows], light[k][rows:]])


def something_else(light, k, generator):
    y, x = np.mgrid[0 : light[k].shape[0], 0 : light[k].shape[1]]
    light[k] = 0.5 + 0.4 * np.sin(0.09 * x + 0.05 * y + generator.uniform(0, 6))


def mean(light, k, generator):
    light[k] = sum(light) / len(light)


def lamp(light, k, generator):
    for one in range(max(k, 2), len(light)):
        light[one] = light[one] + 0.15


def flash(light, k, generator):
    light[k] = light[k] + 0.15


def moved(light, k, generator):
    for one in range(k, len(light)):
        light[one] = 0.4 * light[one] + 0.6 * np.roll(light[one], 1, 1)


# The fault, the causes that are right, and the numbers of steps whose frames decide it: with three steps an exchange is a
# direction, and with four or fewer no residual tells a repeated frame from a late set.
FAULTS = {
    "black frame": (black, {"lost"}, STEPS),
    "frame of 5 % of the light": (dim, {"lost", "gain"}, STEPS),
    "white frame": (white, {"lost"}, STEPS),
    "frame of half the light": (half, {"gain"}, [5, 6, 12]),
    "repeated frame": (repeated, {"repeated"}, [5, 6, 12]),
    "exchanged frames": (exchanged, {"exchanged"}, [5, 6, 12]),
    "frames late by one": (late, {"late"}, [5, 6, 12]),
    "torn frame": (torn, {"lost"}, [6, 12]),
    "frame of something else": (something_else, {"lost"}, [6, 12]),
    "mean of the frames": (mean, {"lost"}, [4, 5, 6, 12]),
    "lamp of 15 %, from a frame on": (lamp, {"lamp"}, [5, 6, 12]),
    "lamp of 15 % in one frame": (flash, {"lamp"}, [4, 5, 6, 12]),
    "image moved by 0.6 px": (moved, {"moved"}, [6, 12]),
}
SOUND = {
    "linear": {},
    "gamma 1.6": {"gamma": 1.6},
    "gamma 2.5": {"gamma": 2.5},
    "binary, blurred": {"binary": True},
    "flicker of 3 %": {"flicker": 0.03},
    "ambient light": {"ambient": 60},
    "0.1 of the light": {"level": 0.1},
    "0.02 of the light": {"level": 0.02},
}
CASES = {f"{fault}, {steps} steps": SEEDS for fault, (_, _, decided) in FAULTS.items() for steps in decided}
CASES |= {f"sound, {name}, {steps} steps": SEEDS for name in SOUND for steps in STEPS}
PART = PART_SEEDS


@functools.cache
def rig_and_scenes(study):
    rig = small_rig(study)
    return rig, [Scene(study, rig, part) for part in PARTS]


def shown(wave, gamma=1.0, binary=False, **_):
    """The light of a projector, 0 to 1, for a wave of -1 to 1."""
    if binary:
        return 0.5 + 0.5 * np.clip(2.5 * wave, -1, 1)
    return (0.5 + 0.5 * wave) ** gamma


def write(folder, scene, steps, rig, generator, change=None, ambient=0, level=1.0, flicker=0.0, **projector):
    """A scan of 1 and COUNT fringes; the fault is one of the finer ones."""
    patterns = fringes([1, COUNT], steps)
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "views" / "000").mkdir(parents=True)
    (folder / "rig.toml").write_text(rig.read_text())
    (folder / "scan.toml").write_text(toml_of(patterns))
    dark = np.maximum(scene.mean - scene.modulation, 0)
    for pattern in patterns:
        period = pattern["shown"]["period"]
        light = [
            shown(np.cos(2 * np.pi * scene.column / period + np.radians(shift)), **projector)
            for shift in pattern["shown"]["shifts"]
        ]
        if change is not None and pattern is patterns[-1]:
            change(light, 1 + int(generator.integers(steps - 1)), generator)
        for k, one in enumerate(light):
            gain = 1 + flicker * generator.normal()
            image = gain * (ambient + level * (dark + 2 * scene.modulation * one))
            sigma = np.sqrt(np.maximum(image, 0) / GAIN_E + (READ_E / GAIN_E) ** 2)
            noisy = np.clip(np.rint(image + sigma * generator.normal(size=image.shape)), 0, 255).astype(np.uint8)
            name = folder / "views" / "000" / f"{pattern['keys']['name']}-{k}.png"
            cv2.imwrite(str(name), noisy, [cv2.IMWRITE_PNG_COMPRESSION, 1])


def decode(study, folder):
    return study.run("decode", folder, "--undo-response", "auto", "-o", study.work / "explained", allowed=(0, 5))


def explained(answer):
    return next(one for one in answer["explanations"] if one["pattern"] == f"f{COUNT}")


def measure(study, case, seed):
    rig, scenes = rig_and_scenes(study)
    generator = np.random.default_rng([seed, len(case), sum(case.encode())])
    scene = wall(generator) if seed % 4 == 0 else scenes[seed % len(scenes)]
    folder = study.work / "explained-scan"
    name, steps = case.rsplit(", ", 1)
    steps = int(steps.split()[0])
    if not name.startswith("sound"):
        change, causes, _ = FAULTS[name]
        write(folder, scene, steps, rig, generator, change)
        found = explained(decode(study, folder))
        return {
            "named": found["cause"] in causes and bool(found["text"]),
            "text": found["text"],
            "cause": found["cause"],
        }
    write(folder, scene, steps, rig, generator, **SOUND[name.removeprefix("sound, ")])
    answer = decode(study, folder)
    found = explained(answer)
    phase = cv2.imread(str(study.work / "explained" / "absolute.tiff"), cv2.IMREAD_UNCHANGED)
    error = phase - 2 * np.pi * scene.column * COUNT / FIELD
    measured = np.isfinite(phase) & (scene.modulation > 20) & (np.abs(error) < np.pi)
    return {
        "blamed": bool(found["text"]) or not answer["trustworthy"],
        "text": found["text"] or answer.get("reason"),
        "rms_rad": float(np.sqrt((error[measured] ** 2).mean())) if measured.any() else None,
        "sigma_rad": answer["phase_sigma_rad"],
        "unexplained_rad": found["unexplained_rad"],
    }


def report(text, results):
    text.add(
        f"`./run figures explanations`: {', '.join(PARTS)} and bumpy walls, 320 x 256 pixels, rendered once; 1 and {COUNT} fringes, "
        "noise as in the sample scans. The fault is one of the finer pattern, in a frame drawn by lot. A cell is the number of scans in "
        "which the cause is named with odds of 100 : 1.\n"
    )
    text.table("fault", *[f"{steps} steps" for steps in STEPS])
    for fault in FAULTS:
        cells = []
        for steps in STEPS:
            one = results.get(f"{fault}, {steps} steps")
            cells.append(
                f"{sum(found['named'] for found in one)} of {len(one)}" if one else "not decided by these frames"
            )
        text.row(fault, *cells)
    text.add("\nSound scans that are blamed for a fault, and the median of what counts as unexplained, rad:\n")
    text.table("projector and light", *[f"{steps} steps" for steps in STEPS])
    for name in SOUND:
        cells = []
        for steps in STEPS:
            one = results[f"sound, {name}, {steps} steps"]
            rest = np.median([found["unexplained_rad"] for found in one])
            cells.append(f"{sum(found['blamed'] for found in one)} of {len(one)}; {rest:.3f}")
        text.row(name, *cells)
