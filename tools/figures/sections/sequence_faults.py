"""Faults of a projected sequence, declared wrongly in scan.toml: which are named rightly."""
import base64
import functools
import math
import re
import shutil

import cv2
import numpy as np

from fringe_scenes import FIELD, GAIN_E, READ_E, Scene, fringes, gray, small_rig, toml_of, wall, write_scan

PAGE = "figures-capture.md"
TITLE = "Sequences that do not fit scan.toml"

SCANS = 20
PARTS = ["plate", "bracket", "ball-bar", "blade"]


SEQUENCES = [
    lambda: fringes([1, 8, 64]),
    lambda: fringes([53, 58, 64]),
    lambda: fringes([1, 8, 40], 5),
    lambda: fringes([1, 4, 16, 64]),
]


def start(i, patterns, generator):
    """90, 180 or 270 degrees late."""
    late = [180, 90, 270][i % 3]
    # The start of the coarsest fringes only moves the field if it is a multiple of what the finer ones see.
    pattern = patterns[1 + i % (len(patterns) - 1)]
    pattern["shown"]["shifts"] = [shift + late for shift in pattern["shown"]["shifts"]]
    return "start", [pattern["keys"]["name"]], f"a start of {late} degrees"


def any_start(i, patterns, generator):
    """45 to 315 degrees late (not 53, 58, 64)."""
    late = int(generator.integers(45, 315))
    pattern = patterns[-1 - i % 2]
    pattern["shown"]["shifts"] = [shift + late for shift in pattern["shown"]["shifts"]]
    return "start", [pattern["keys"]["name"]], late


def direction(i, patterns, generator):
    """shifts in the opposite direction."""
    pattern = patterns[1 + i % (len(patterns) - 1)]  # the start of the coarsest one is not seen by the others
    pattern["shown"]["shifts"] = [-shift for shift in pattern["shown"]["shifts"]]
    return "direction", [pattern["keys"]["name"]], "shifts in the opposite direction"


def exchanged_frames(i, patterns, generator):
    """two frames of a pattern exchanged."""
    pattern = patterns[i % len(patterns)]
    shifts = pattern["shown"]["shifts"]
    a = i % (len(shifts) - 1)
    shifts[a], shifts[a + 1] = shifts[a + 1], shifts[a]
    return "order", [pattern["keys"]["name"]], f"frames {a} and {a + 1} exchanged"


def period(i, patterns, generator):
    """another period of the finest fringes."""
    pattern = max(patterns, key=lambda one: -one["keys"]["period_px"])
    shown = [16, 24, 25, 12, 18][i % 5]
    if abs(shown - pattern["keys"]["period_px"]) < 1e-6:
        shown = 30
    pattern["shown"]["period"] = shown
    return "period", [pattern["keys"]["name"]], f"a period of {shown} px"


def exchanged_patterns(i, patterns, generator):
    """the frames of two patterns exchanged."""
    a, b = [(0, 1), (0, 2), (1, 2)][i % 3]
    patterns[a]["shown"], patterns[b]["shown"] = patterns[b]["shown"], patterns[a]["shown"]
    return "exchanged", [patterns[a]["keys"]["name"], patterns[b]["keys"]["name"]], ""


def gray_exchanged(i, patterns, generator):
    """Gray code: two frames exchanged."""
    a = i % 6
    b = (a + 1 + i // 6 % 5) % 6
    a, b = min(a, b), max(a, b)
    frames = patterns[1]["shown"]["frames"]
    frames[a], frames[b] = frames[b], frames[a]
    return "order", ["gray"], f"frames {a} and {b} exchanged"


def gray_inverted(i, patterns, generator):
    """Gray code: a frame inverted."""
    a = i % 6
    bit = patterns[1]["shown"]["frames"][a]
    patterns[1]["shown"]["frames"][a] = (bit[0], bit[1], True)
    return "inversion", ["gray"], f"frame {a} inverted"


def gray_missing(i, patterns, generator):
    """Gray code: a dark frame, or one recorded twice."""
    a = 2 + i % 4
    patterns[1]["shown"]["frames"][a] = None if i % 2 else patterns[1]["shown"]["frames"][a - 1]
    return "missing", ["gray"], f"frame {a}"


def gray_order(i, patterns, generator):
    """Gray code: bits in the opposite order."""
    if i % 2:
        patterns[1]["keys"]["order"] = "lsb-first"
    else:
        patterns[1]["shown"]["frames"].reverse()
    return "order", ["gray"], "its bits in the opposite order"


def gray_binary(i, patterns, generator):
    """binary code declared as Gray code, and the reverse."""
    if i % 2:
        patterns[1]["keys"]["code"] = "binary"
    else:
        patterns[1]["shown"]["frames"] = [(bit, True, False) for bit in range(6)]
    return "code", ["gray"], "the other code"


def gray_alternating(i, patterns, generator):
    """Gray code: inverted frames that alternate, or follow."""
    alternating = [(bit, False, inverse) for bit in range(6) for inverse in (False, True)]
    after = [(bit, False, inverse) for inverse in (False, True) for bit in range(6)]
    patterns[1]["shown"]["frames"] = alternating if i % 2 else after
    patterns[1]["keys"]["inverted"] = "after" if i % 2 else "alternating"
    return "order", ["gray"], "inverted frames"


def gray_start(i, patterns, generator):
    """fringes with a Gray code that begin late."""
    late = [180, 90, 270][i % 3]
    patterns[0]["shown"]["shifts"] = [shift + late for shift in patterns[0]["shown"]["shifts"]]
    return "start", ["f32"], f"a start of {late} degrees"


def all_reversed(i, patterns, generator):
    """all shifts in the opposite direction, decided by the rig."""
    for pattern in patterns:
        pattern["shown"]["shifts"] = [-shift for shift in pattern["shown"]["shifts"]]
    return "rig", [], "opposite direction fit in all their patterns"


FRINGE_FAULTS = [start, any_start, direction, exchanged_frames, period, exchanged_patterns, all_reversed]
GRAY_FAULTS = [gray_exchanged, gray_inverted, gray_missing, gray_order, gray_binary, gray_alternating, gray_start]


def decode(study, folder):
    return study.run("decode", folder, "-o", study.work / "fault-stages", allowed=(0, 5))


def is_named(answer, kind, names, what):
    """Whether the answer names the fault, and nothing else."""
    if answer["trustworthy"]:
        return False
    if kind == "rig":
        return what in answer["reason"]
    fits = [fit for check in answer["checks"] for fit in check.get("fits", [])]
    if len(fits) != 1 or sorted(fits[0]["patterns"]) != sorted(names):
        return False
    if isinstance(what, int):
        found = re.match(r"a start of ([\d.]+) degrees", fits[0]["what"])
        return bool(found) and abs(float(found[1]) - what) <= 5
    described = [fits[0]["what"]] + fits[0]["same_as"]
    return any(what in one for one in described) and (fits[0]["kind"] == kind or len(described) > 1)


FAULTS = {fault.__doc__.splitlines()[0].rstrip("."): fault for fault in FRINGE_FAULTS + GRAY_FAULTS}
CASES = {**{name: SCANS for name in FAULTS}, "none": SCANS, "64, 58 and 53 fringes": 10, "tilted plate": 60}


@functools.cache
def rig_and_scenes(study):
    rig = small_rig(study)
    return rig, [Scene(study, rig, part) for part in PARTS]


def answer_to_fault(study, fault, i):
    """Whether a fault is named and nothing else, and what was wanted and said."""
    rig, scenes = rig_and_scenes(study)
    generator = np.random.default_rng(1000 + i)
    # Without levels, a start of any angle is the same as another start of another pattern and a shift in the field.
    sequences = SEQUENCES[:1] + SEQUENCES[2:] if fault is any_start else SEQUENCES
    patterns = gray() if fault in GRAY_FAULTS else sequences[i // 2 % len(sequences)]()
    wanted = fault(i, patterns, generator)
    scene = wall(generator) if fault in GRAY_FAULTS else scenes[i % len(scenes)]
    write_scan(study.work / "fault", scene, patterns, rig, generator)
    answer = decode(study, study.work / "fault")
    return {"named": is_named(answer, *wanted), "wanted": wanted, "reason": answer.get("reason")}


def is_blamed(study, i):
    """Whether a sound scan is called faulty."""
    rig, scenes = rig_and_scenes(study)
    generator = np.random.default_rng(2000 + i)
    patterns = gray() if i % 5 == 4 else SEQUENCES[i % 5]()
    write_scan(study.work / "fault", scenes[i % len(scenes)], patterns, rig, generator)
    return not decode(study, study.work / "fault")["trustworthy"]


def wrong_orders(study, i):
    """Numbers of wrong and of all well-modulated pixels with 64, 58 and 53 fringes."""
    rig, scenes = rig_and_scenes(study)
    scene = scenes[i % len(scenes)]
    write_scan(study.work / "fault", scene, fringes([53, 58, 64]), rig, np.random.default_rng(3000 + i))
    decode(study, study.work / "fault")
    phase = cv2.imread(str(study.work / "fault-stages" / "absolute.tiff"), cv2.IMREAD_UNCHANGED)
    error = phase - 2 * math.pi * scene.column * 64 / FIELD
    measured = np.isfinite(phase) & (scene.modulation > 20)
    return [int((np.abs(error[measured]) > math.pi).sum()), int(measured.sum())]


CHOICES = ("vertical", "horizontal", "fused", "best")
INNER = (slice(8, -8), slice(8, -8))


def packed(array):
    """An array as text, for a result in JSON."""
    return base64.b64encode(array.astype("<f4").tobytes()).decode()


def unpacked(text):
    return np.frombuffer(base64.b64decode(text), "<f4").astype(float)


def tilted_plate(study, seed):
    """Depth errors by direction of fringes on a plate that is tilted about two axes, by the equations of two pinholes."""
    width, height = 160, 120
    angle = math.atan2(200, 500)
    c, s = math.cos(angle), math.sin(angle)
    rig = study.work / "plate-rig.toml"
    rig.write_text(
        f"""format = "frangia-rig"
version = 1
[camera]
size_px = [{width}, {height}]
focal_px = [300, 300]
principal_point_px = [80, 60]
[camera.noise]
gain_e_per_count = {GAIN_E}
read_e = {READ_E}
[projector]
model = "pinhole"
position_mm = [200, 90, 0]
rotation = [[{c:.12f}, 0, {s:.12f}], [0, 1, 0], [{-s:.12f}, 0, {c:.12f}]]
size_px = [640, 480]
focal_px = [900, 900]
principal_point_px = [320, 400]
"""
    )
    x, y = np.meshgrid((np.arange(width) - 80) / 300, (np.arange(height) - 60) / 300)
    z = 500 / (1 - 0.35 * x - 0.25 * y)  # the plane z = 500 + 0.35 X + 0.25 Y
    px, py = z * x - 200, z * y - 90
    depth = -s * px + c * z
    scene = Scene.__new__(Scene)
    coordinates = {"vertical": 320 + 900 * (c * px + s * z) / depth, "horizontal": 400 + 900 * py / depth}
    scene.mean, scene.modulation = np.full(z.shape, 110.0), np.linspace(30, 90, width)[None, :] * np.ones(z.shape)
    errors = {}
    generator = np.random.default_rng(3999 + seed)
    folder = study.work / "tilted"
    every = []
    for run, (way, side) in enumerate((("vertical", 640), ("horizontal", 480))):
        scene.column = coordinates[way]
        patterns = []
        for one in (side, 80, 20):
            pattern = {
                "keys": {
                    "name": f"{way[0]}{one}",
                    "kind": "fringe",
                    "direction": way,
                    "period_px": one,
                    "shifts_deg": [0, 90, 180, 270],
                },
                "shown": {"period": one, "shifts": [0, 90, 180, 270]},
            }
            patterns.append(pattern)
        if run == 0:
            write_scan(folder, scene, patterns, rig, generator)
        else:
            write_scan(study.work / "tilted-rows", scene, patterns, rig, generator)
            for file in (study.work / "tilted-rows" / "views" / "000").iterdir():
                shutil.copy(file, folder / "views" / "000")
        every += patterns
    (folder / "scan.toml").write_text(toml_of(every))
    for choice in CHOICES:
        study.run("decode", folder, "--directions", choice, "-o", study.work / "fault-stages")
        found = cv2.imread(str(study.work / "fault-stages" / "depth.tiff"), cv2.IMREAD_UNCHANGED)
        errors[choice] = packed((found - z)[INNER])
    return errors


def measure(study, case, seed):
    if case in FAULTS:
        return answer_to_fault(study, FAULTS[case], seed - 1)
    if case == "none":
        return is_blamed(study, seed - 1)
    return tilted_plate(study, seed) if case == "tilted plate" else wrong_orders(study, seed - 1)


def report(text, results):
    scans = len(results["none"])
    text.add(
        f"`./run figures sequence_faults`: {', '.join(PARTS)}, rendered at 320 x 256 pixels; {scans} scans of each fault, over the parts, "
        "sequences of 1, 8, 64; 53, 58, 64; 1, 8, 40 (five frames); and 1, 4, 16, 64 fringes, and a Gray code of six bits, on walls "
        "that fill the field; noise as in the sample scans.\n"
    )
    text.table("fault", "named, and nothing else", "wanted")
    for fault in FAULTS:
        text.row(fault, f"{sum(one['named'] for one in results[fault])} of {len(results[fault])}", "at least 19")
    text.row("none", f"{sum(results['none'])} of {scans} blamed", "0")
    wrong, kept = np.sum(results["64, 58 and 53 fringes"], axis=0)
    text.add(
        f"\nHeterodyne, 64, 58 and 53 fringes, four steps: {wrong} wrong orders among {kept} well-modulated pixels of {len(results['64, 58 and 53 fringes'])} scans "
        f"({wrong / kept:.1e}; wanted: below 1e-4)."
    )

    plates = results["tilted plate"]
    seeds = len(plates)
    rms = {choice: np.sqrt(np.mean([unpacked(one[choice]) ** 2 for one in plates], axis=0)) for choice in CHOICES}
    better = np.minimum(rms["vertical"], rms["horizontal"])
    ratio = rms["fused"] / better
    noise = 1 / math.sqrt(2 * seeds)  # relative standard error of each RMS
    text.add(
        f"\nA tilted plate with both directions of fringes, {seeds} seeds, RMS depth error: vertical {np.nanmean(rms['vertical']):.4f} mm, "
        f"horizontal {np.nanmean(rms['horizontal']):.4f} mm, the better one of each pixel {np.nanmean(better):.4f} mm, best "
        f"{np.nanmean(rms['best']):.4f} mm, fused {np.nanmean(rms['fused']):.4f} mm. Fused over the better direction, pixel by pixel: median "
        f"{np.nanmedian(ratio):.3f}, 99 % below {np.nanpercentile(ratio, 99):.3f} (an RMS of {seeds} seeds is uncertain by {100 * noise:.0f} %; wanted: no "
        "worse)."
    )
