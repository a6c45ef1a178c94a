"""Faults of frames: which causes are named, what the others cost, and whether sound frames are blamed."""
import json

import cv2
import numpy as np

import faulty_frames as made
from faulty_frames import FIELD, Frames

PAGE = "figures-capture.md"
TITLE = "What explains the frames of a pattern"

STEPS = [3, 4, 5, 6, 8, 12]
PERIOD_PX, COARSER_PX = 24, [1280, 150]
COARSEST_BINARY_PX = 40  # no lens blurs coarser lines to fringes
STRIPE_PX, BITS = 12, 7
SCENES = list(made.SCENES)
SEEDS = 20


def uneven(generator, steps):
    return 4 * generator.normal(size=steps)


def stretched(generator, steps):
    return 0.05 * 360 / steps * np.arange(steps)


# Faults of fringes: what changes the frames; the causes and kinds of fault that name it rightly.
# A fault is a function of the frames, a function of the shifts, a period, options of `record`, or a movement.
ORDER = {"exchanged", "order", "direction", "start", "late", "repeated"}
FRINGE_FAULTS = {
    "black frame": (made.black, {"lost"}),
    "frame of 5 % of the light": (made.dim, {"lost", "gain"}),
    "white frame": (made.white, {"lost"}),
    "frame of full light": (made.full, {"lost"}),
    "frame of half the light": (made.half, {"gain"}),
    "frame of 0.8 of the light": (made.weaker, {"gain"}),
    "repeated frame": (made.repeated, {"repeated", "late"}),
    "exchanged frames": (made.exchanged, ORDER),
    "frames late by one": (made.late, {"late", "repeated"}),
    "all frames in reversed order": (made.reversed_order, ORDER),
    "torn frame": (made.torn, {"lost", "covered"}),
    "frame of something else": (made.something_else, {"lost"}),
    "mean of the frames": (made.mean, {"lost"}),
    "no fringes at all": (made.no_fringes, {"unexplained", "no fringes"}),
    "lamp from a frame on": (made.lamp, {"lamp"}),
    "lamp in one frame": (made.flash, {"lamp", "gain"}),
    "steps off by 4 degrees": (uneven, {"steps"}),
    "steps 5 % longer": (stretched, {"steps"}),
    "start of 180 degrees": (lambda generator, steps: 180 + np.zeros(steps), {"start", "order", "direction"}),
    "start of 37 degrees": (lambda generator, steps: 37 + np.zeros(steps), {"start"}),
    "opposite direction": (None, {"direction", "order", "exchanged"}),
    "period of 27 px": (27, {"period"}),
    "cut off at 200 counts": ({"level": 1.35, "ceiling": 200}, {"ceiling"}),
    "video levels": ({"level": 1.5, "levels": (16, 235), "ceiling": 235}, {"ceiling"}),
    "part moved by 0.6 mm": ("moved", {"moved"}),
    "part moved by 0.2 mm": ("moved a little", {"moved"}),
}
GRAY_FAULTS = {
    "black frame": (made.black, {"missing", "inverses"}),
    "white frame": (made.white, {"missing", "inverses"}),
    "repeated frame": (made.repeated, {"missing", "inverses"}),
    "frames late by one": (made.late, {"missing", "inverses"}),
    "exchanged frames": (made.exchanged, {"order", "inverses"}),
    "inverted frame": (made.inverted, {"inversion", "inverses"}),
    "reversed order": (made.reversed_order, {"order", "inverses"}),
    "binary code": (None, {"code"}),
}
SOUND = {
    "linear": lambda seed, generator: ({}, {}),
    "gamma 1 to 2.5": lambda seed, generator: ({"gamma": generator.uniform(1, 2.5)}, {}),
    "binary, blur 0.5 to 4 px": lambda seed, generator: (
        {"waveform": made.binary, "blur_px": [0.5, 1, 2, 4][seed % 4]},
        {},
    ),
    "dithered": lambda seed, generator: ({"waveform": made.dithered, "blur_px": [1.5, 2.5][seed % 2]}, {}),
    "flicker of 3 %": lambda seed, generator: ({}, {"flicker": 0.03}),
    "declared video levels": lambda seed, generator: ({}, {"level": 1.3, "ceiling": 235}),
    "ambient light": lambda seed, generator: ({}, {"ambient": 0.4, "level": 0.6}),
    "0.02 to 1 of full light": lambda seed, generator: ({}, {"level": [0.02, 0.1, 0.3, 1][seed % 4]}),
}
SETS = ["alone", "with coarser patterns", "with Gray code"]
GRAY_SETS = [("with Gray code", 4), ("Gray code alone", 0)]
DAMAGE, HONEST = 3.0, 1.5  # error over sigma
WRONG_ORDERS = 0.02  # share of the pixels
CASES = {f"{fault} | {one} | {n}": SEEDS for fault in FRINGE_FAULTS for one in SETS for n in STEPS}
CASES |= {f"Gray code: {fault} | {one} | {n}": SEEDS for fault in GRAY_FAULTS for one, n in GRAY_SETS}
CASES |= {f"sound: {name} | {one} | {n}": SEEDS for name in SOUND for one in SETS for n in STEPS}
CASES |= {f"sound: {name} | Gray code alone | 0": SEEDS for name in SOUND}
# Of the part: sets of which the number of steps differs.
PART_SETS = [("alone", 4), ("with coarser patterns", 3), ("with coarser patterns", 5), ("with Gray code", 6)]
IN_PART = {f"| {of_set} | {n}" for of_set, n in PART_SETS}
PART = {
    case: int("Gray code: " in case or "code alone" in case or case[case.index("|") :] in IN_PART) for case in CASES
}


class Lot:
    """What is drawn for a case."""

    def __init__(self, case, seed):
        self.generator = np.random.default_rng([seed, len(case), sum((i + 1) * c for i, c in enumerate(case.encode()))])
        self.scene = SCENES[int(self.generator.integers(len(SCENES)))]
        self.states_noise = bool(self.generator.integers(2))
        self.is_decidable = True


def fringe_frames(lot, period, steps, fault, projector, camera):
    generator, shifts = lot.generator, 360 * np.arange(steps) / steps
    k = 1 + int(generator.integers(steps - 1))
    motion = [None] * steps
    if fault in (uneven, stretched) or getattr(fault, "__name__", "") == "<lambda>":
        shifts, fault = shifts + fault(generator, steps), False
    elif fault is None:
        shifts, fault = -shifts, False
    elif fault is not False and isinstance(fault, int):
        period, fault = fault, False
    elif isinstance(fault, dict):
        camera, fault = camera | fault, False
    elif isinstance(fault, str):
        motion, fault = [None] * k + [fault] * (steps - k), False
    if period > COARSEST_BINARY_PX and projector.get("waveform") is made.binary:
        projector = {}
    light = [
        made.at_camera(made.shown_light(made.fringes(period, shift), **projector), lot.scene, moved)
        for shift, moved in zip(shifts, motion)
    ]
    frames = Frames(light, made.seen(lot.scene)[1].mean(axis=0))
    if fault is not False:
        fault(frames, k, generator)
    return made.record(frames, generator, **camera)


def gray_frames(lot, bits, stripe, fault, projector, camera, inverses=False):
    generator, frames = lot.generator, []
    projector = projector if projector.get("waveform") is not made.dithered else {"blur_px": projector["blur_px"]}
    for is_inverted in [False, True][: 1 + inverses]:
        light = [
            made.at_camera(
                made.shown_light(made.stripes(bits, stripe, bit, fault is None, is_inverted), **projector), lot.scene
            )
            for bit in range(bits)
        ]
        one = Frames(light, made.seen(lot.scene)[1].mean(axis=0))
        if fault and not is_inverted:
            fault(one, 1 + int(generator.integers(bits - 1)), generator)
        frames += made.record(one, generator, **camera)[0]
    return frames


def fringe_pattern(name, period, steps):
    return {"name": name, "kind": "fringe", "period_px": period, "shifts_deg": [360 * k / steps for k in range(steps)]}


WITNESSES = 50  # of what is left: it may be one smooth field
FLICKER = 0.03  # standard deviation of the gain of a sound frame


def left_by_sound_frames(clean, residual, shifts_deg, over):
    """The log likelihood that sound frames lack: by their residuals, after the gains of a lamp that explain most of it."""
    design = made.fringe_design(shifts_deg)
    rest = np.eye(len(design)) - design @ np.linalg.pinv(design)
    effects = rest[:, :, None] * clean[None]  # residual of each frame by the gain of each frame, at each pixel
    left = residual
    for _ in range(3):  # outliers count by five standard deviations
        weight = 1 / over**2 / np.maximum(1, np.sqrt((left**2).sum(axis=0)) / over / 5)
        scale = WITNESSES / clean.shape[1] * weight
        normal = np.einsum("fgi,fhi,i->gh", effects, effects, scale) + np.eye(len(clean)) / FLICKER**2
        gains = np.linalg.solve(normal, np.einsum("fgi,fi,i->g", effects, residual, scale))
        left = residual - np.einsum("fgi,g->fi", effects, gains)
    squares = np.minimum((left**2).sum(axis=0) / over**2, 25)
    return WITNESSES / 2 * squares.mean() + 0.5 * ((gains / FLICKER) ** 2).sum()


def is_decidable(lot, clean, period, steps, of_set):
    """Whether the frames without noise leave more than those of a sound set of another surface.

    By themselves: a residual of the fringe fit that 50 witnesses tell from noise and flicker by 100 : 1. Beside other
    patterns, which tell the phase: an error of the phase of 10 degrees.
    """
    truth = made.truth(lot.scene)
    lit = np.isfinite(truth) & (clean.max(axis=0) < 254) & (np.ptp(clean, axis=0) > 10)
    if not lit.any():
        return True
    shifts_deg = [360 * k / steps for k in range(steps)]
    phase, residual = made.fitted(clean[:, lit], shifts_deg)
    over = made.noise_of(clean[:, lit].mean(axis=0))
    by_residual = steps > 3 and (
        left_by_sound_frames(clean[:, lit], residual, shifts_deg, over) > np.log(100) + np.log(steps)
    )
    error = np.angle(np.exp(1j * (phase - 2 * np.pi * truth[lit] / period)))
    return bool(by_residual or (of_set != "alone" and np.sqrt(np.mean(error**2)) > np.radians(10)))


def write(folder, case, seed):
    """The scan of a case; its lot, and the period of the final phase."""
    name, of_set, steps = case.split(" | ")
    lot, steps = Lot(case, seed), int(steps)
    projector, camera, fault, gray_fault = {}, {}, False, False
    if name.startswith("sound: "):
        projector, camera = SOUND[name.removeprefix("sound: ")](seed, lot.generator)
    elif name.startswith("Gray code: "):
        gray_fault = GRAY_FAULTS[name.removeprefix("Gray code: ")][0]
    else:
        fault = FRINGE_FAULTS[name][0]
    patterns, images = [], {}
    if of_set != "Gray code alone":
        periods = [*COARSER_PX, PERIOD_PX] if of_set == "with coarser patterns" else [PERIOD_PX]
        at_fault = periods[-1] if lot.generator.uniform() < 0.7 or not isinstance(fault, dict) else periods[0]
        for period in periods:
            patterns.append(fringe_pattern(f"f{period}", period, steps))
            of_pattern = fault if period == at_fault or isinstance(fault, dict) else False
            images[f"f{period}"], clean = fringe_frames(lot, period, steps, of_pattern, projector, camera)
            if fault is not False and of_pattern is not False:
                lot.is_decidable = is_decidable(lot, clean, period, steps, of_set)
    if "Gray" in of_set:
        alone = of_set == "Gray code alone"
        bits, stripe = (8, 5) if alone else (BITS, STRIPE_PX)
        patterns.append({"name": "gray", "kind": "gray", "bits": bits, "stripe_px": stripe})
        if alone:
            patterns[-1]["inverted"] = "after"
        images["gray"] = gray_frames(
            lot, bits, stripe, gray_fault, projector, camera | (fault if isinstance(fault, dict) else {}), alone
        )
    made.write(folder, patterns, images, camera.get("ceiling", 255), lot.states_noise)
    return lot, 0 if of_set == "Gray code alone" else PERIOD_PX


def named_causes(answer, warnings):
    """What the program says is wrong, in the words of JSON."""
    causes = [cause for one in answer["explanations"] if one["text"] for cause in one["causes"]]
    causes += ["no fringes" for one in answer["explanations"] if "show no fringes with its shifts" in one["text"]]
    causes += [fit["kind"] for check in answer["checks"] if not check["consistent"] for fit in check["fits"]]
    causes += ["unexplained" for check in answer["checks"] if not check["consistent"] and not check["fits"]]
    reason = answer.get("reason", "")
    if "falls where the rig makes it rise" in reason:
        causes.append("direction")
    if "complement each other" in reason:
        causes.append("inverses")
    if any("cut off at" in one for one in warnings):
        causes.append("ceiling")
    return causes


def maps_of(folder, is_fringe):
    """The final phase and its sigma; of a Gray code alone, of which it is the phase of one fringe, the columns."""
    phase, sigma = (
        cv2.imread(str(folder / f"{one}.tiff"), cv2.IMREAD_UNCHANGED) for one in ("absolute", "absolute-sigma")
    )
    return (phase, sigma) if is_fringe else (phase * FIELD / (2 * np.pi), sigma * FIELD / (2 * np.pi))


def measure(study, case, seed):
    name, of_set, _ = case.split(" | ")
    folder, maps = study.fresh("scan"), study.fresh("maps")
    lot, period = write(folder, case, seed)
    run = study.process("--json", "decode", folder, "-o", maps, allowed=(0, 3, 5))
    if run.returncode == 3:
        return {"exit": 3, "named": [], "text": run.stderr[-300:]}
    answer = json.loads(run.stdout)
    result = {
        "exit": run.returncode,
        "scene": lot.scene,
        "decidable": lot.is_decidable,
        "named": named_causes(answer, answer["warnings"]),
        "text": answer.get("reason") or "; ".join(answer["warnings"]),
        "decided": [one["decided"] for one in answer["explanations"]],
    }
    truth = made.truth(lot.scene)
    phase, sigma = maps_of(maps, period)
    scale = 2 * np.pi / period if period else 1.0
    error = phase - scale * truth
    kept = np.isfinite(error) & np.isfinite(sigma)
    result["kept"] = int(kept.sum()) / int(np.isfinite(truth).sum())
    if not kept.any():
        return result
    error, sigma = error[kept], sigma[kept]
    if of_set == "alone":  # the order of fringes is open
        error = np.angle(np.exp(1j * (error - np.angle(np.exp(1j * error).mean()))))
    limit = np.pi if period else 5.0
    result["wrong_orders"] = float((np.abs(error) > limit).mean())
    right = np.abs(error) <= limit
    if right.any():
        over = (error[right] / sigma[right]) ** 2
        result |= {
            "rms": float(np.sqrt((error[right] ** 2).mean())),
            "sigma": float(np.median(sigma[right])),
            "over": float(np.sqrt(over.mean())),
            "over_95": float(np.sqrt(np.quantile(over, 0.95))),
            "over_median": float(np.sqrt(np.median(over)) / 0.6745),
        }
    return result


def is_silent_damage(found):
    return found["exit"] == 0 and (found.get("over", 0) > DAMAGE or found.get("wrong_orders", 0) > WRONG_ORDERS)


def causes_of(name):
    faults = GRAY_FAULTS if name.startswith("Gray code: ") else FRINGE_FAULTS
    return faults[name.removeprefix("Gray code: ")][1]


def cell(name, results):
    """What became of a cell: the right cause, another one, no result, or a result with its error over sigma."""
    words = []
    for found in results:
        over = f"{found.get('over', 0):.1f}"
        if set(found["named"]) & causes_of(name):
            word = "named"
        elif is_silent_damage(found):
            word = f"**{over}**" if found.get("wrong_orders", 0) <= WRONG_ORDERS else "**wrong orders**"
        elif found["named"]:
            word = "as " + found["named"][0]
        elif found["exit"]:
            word = "refused"
        else:
            word = over
        words.append(word if found.get("decidable", True) else f"({word})")
    return ", ".join(
        f"{words.count(word)} × {word}" if words.count(word) > 1 else word for word in dict.fromkeys(words)
    )


def add_matrix(text, results, of_set, faults, prefix=""):
    steps = [n for n in [0, *STEPS] if any(f"{prefix}{fault} | {of_set} | {n}" in results for fault in faults)]
    text.table(f"fault, {of_set}", *[f"{n} steps" if n else "" for n in steps])
    for fault in faults:
        text.row(fault, *[cell(prefix + fault, results[f"{prefix}{fault} | {of_set} | {n}"]) for n in steps])
    text.add("")


def add_sound(text, results):
    measured = [n for n in STEPS if any(case.startswith("sound") and case.endswith(f"| {n}") for case in results)]
    text.table("sound sets", *[f"{n} steps" for n in measured], "Gray code alone")
    for name in SOUND:
        cells = []
        for n in [*measured, 0]:
            sets = SETS if n else ["Gray code alone"]
            known = [
                one for of_set in sets for one in results.get(f"sound: {name} | {of_set} | {n}", []) if "over" in one
            ]
            cells.append(f"{np.sqrt(np.mean([one['over'] ** 2 for one in known])):.2f}" if known else "none kept")
        text.row(name, *cells)


def report(text, results):
    text.add(
        "`./run figures explanations`: the parts `bust`, `bracket` and a relief of distance_renderer.py, 320 x 256 pixels of 8 bits; fringes "
        f"of {PERIOD_PX} px alone, with coarser ones of {' and '.join(map(str, COARSER_PX))} px, or with a Gray code. Frame, part and "
        "noise are drawn by lot; rig.toml states the noise of every other scan. *named*: the cause, by 100 : 1. A number is the error over "
        f"sigma (RMS) of a result that is given; **bold** where that exceeds {DAMAGE:g} and the exit code is 0. In parentheses: the frames "
        "without noise are within those of a sound set.\n"
    )
    faults = {case: found for case, found in results.items() if not case.startswith("sound")}
    decidable = [
        (case.split(" | ")[0], one) for case, found in faults.items() for one in found if one.get("decidable", True)
    ]
    named = sum(bool(set(one["named"]) & causes_of(name)) for name, one in decidable)
    silent = sum(is_silent_damage(one) for _, one in decidable)
    count = sum(map(len, faults.values()))
    text.add(
        f"Of {count} sets with a fault {len(decidable)} are decidable; of these {named} are named rightly, and {silent} give a result "
        f"whose error exceeds {DAMAGE:g} sigma with exit code 0.\n"
    )
    for of_set in SETS:
        add_matrix(text, results, of_set, FRINGE_FAULTS)
    for of_set, _ in GRAY_SETS:
        add_matrix(text, results, of_set, GRAY_FAULTS, "Gray code: ")
    sound = [one for case, found in results.items() if case.startswith("sound") for one in found]
    blamed = sum(bool(one["named"]) or one["exit"] != 0 for one in sound)
    text.add(
        f"Of {len(sound)} sound sets {blamed} are blamed or refused (wanted: at most 1 %). Error over sigma, RMS over all kept pixels "
        "of the sets (wanted: 0.7 to 1.5):\n"
    )
    add_sound(text, results)
