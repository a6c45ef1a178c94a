"""Faults of rig, table and part in scans that another renderer made: what is named, and whether sigma holds the error."""
import functools

import numpy as np

import distance_renderer as renderer
from distance_renderer import NO_MOTION, Rig, turned, unit
from study import NotAsWanted
from surfaces import points_of, read_ply, rms

TITLE = "What moved, in scans of another renderer"

VIEWS = 8
SOUND = "none"
ALONG = unit([0.8, 0.5, 0])


def moved_from(view, length_mm):
    return [(np.eye(3), length_mm * ALONG * (k >= view)) for k in range(VIEWS)]


def moved_alone(views, length_mm):
    return [(np.eye(3), length_mm * ALONG * (k in views)) for k in range(VIEWS)]


def warmed_up(rig, angle_deg, length_mm, views=3):
    share = [1 - np.exp(-k / views) for k in range(VIEWS)]
    return [rig.with_projector_moved(angle_deg * one, length_mm * one) for one in share]


def wobbling(generator, angle_deg, length_mm):
    return [
        (
            turned(unit(generator.normal(size=3)), np.radians(angle_deg) * generator.normal()),
            length_mm * generator.normal(size=3),
        )
        for _ in range(VIEWS)
    ]


def with_camera(rig, **changes):
    for name, value in changes.items():
        setattr(rig, name, value)
    return [rig] * VIEWS


class StatedOtherwise(Rig):
    """The same rig by a rig.toml that states the distortion k1 of its camera."""

    def __init__(self, k1):
        super().__init__()
        self.k1 = k1

    def toml(self):
        return super().toml().replace("distortion = [0, ", f"distortion = [{self.k1}, ", 1)


# What is true instead of what rig.toml and scan.toml state, and the causes that are right.
FAULTS = {
    SOUND: (lambda angles, generator: {}, {"as-stated"}),
    "the part slides by 0.4 mm": (lambda *_: {"part": moved_from(4, 0.4)}, {"part-moved"}),
    "the part slides by 0.15 mm": (lambda *_: {"part": moved_from(4, 0.15)}, {"part-moved"}),
    "two views moved by 0.4 mm": (lambda *_: {"part": moved_alone((2, 5), 0.4)}, {"views-moved"}),
    "the projector warms up, 0.05° and 0.1 mm": (lambda *_: {"rigs": warmed_up(Rig(), 0.05, 0.1)}, {"rig-drift"}),
    "the projector stands 0.1° and 0.5 mm off": (
        lambda *_: {"rigs": [Rig().with_projector_moved(0.1, 0.5)] * VIEWS},
        {"rig"},
    ),
    "the projector's focal length is 0.6 % off": (
        lambda *_: {"rigs": with_camera(Rig(), shown_focal=2100 * 1.006)},
        {"rig"},
    ),
    "the table wobbles by 0.03° and 0.03 mm": (
        lambda angles, generator: {"table": wobbling(generator, 0.03, 0.03)},
        {"wobble"},
    ),
    "the table turns by 0.98 of each angle": (lambda angles, _: {"angles": 0.98 * angles}, {"angles-scaled"}),
    "a step of 2.8° is lost": (
        lambda angles, _: {"angles": angles - 2.8125 * (np.arange(VIEWS) >= 4)},
        {"turned"},
    ),
    "the camera's k1 is 0.03 off": (lambda *_: {"stated": StatedOtherwise(0.03)}, {"rig"}),
}
# A tenth of the light, so that each fault changes the distance of one pair of points by less than their noise.
NOISY = ", noisy camera"


def by_noisy_camera(true):
    return lambda angles, generator: {**true(angles, generator), "camera": {"light": 150.0, "read": 5.0}}


CLEAR = list(FAULTS)
FAULTS.update(
    {
        fault + NOISY: (by_noisy_camera(FAULTS[fault][0]), FAULTS[fault][1])
        for fault in (
            SOUND,
            "the projector stands 0.1° and 0.5 mm off",
            "the table wobbles by 0.03° and 0.03 mm",
            "a step of 2.8° is lost",
        )
    }
)
CASES = {f"{part}: {fault}": 3 for part in ("bust", "bracket", "shaft", "gear", "cup", "ball bar") for fault in FAULTS}
IN_PART = {"bust": FAULTS, "bracket": CLEAR, "shaft": CLEAR[:1] + CLEAR[4:5] + CLEAR[7:]}
PART = {case: int(case.split(": ")[1] in IN_PART.get(case.split(": ")[0], ())) for case in CASES}
ANGLES = 360.0 * np.arange(VIEWS) / VIEWS


@functools.lru_cache(maxsize=1)
def rendered(part, fault):
    """What is true, and the samples of all views; only the noise of the camera differs between seeds."""
    true = FAULTS[fault][0](ANGLES, np.random.default_rng(6))
    rigs = true.get("rigs", [Rig()] * VIEWS)
    views = []
    for k in range(VIEWS):
        motions = true.get("part", [NO_MOTION] * VIEWS)[k], true.get("table", [NO_MOTION] * VIEWS)[k]
        views.append(renderer.seen(renderer.PARTS[part], rigs[k], true.get("angles", ANGLES)[k], *motions))
    return true, views


def render(folder, part, fault, seed):
    true, views = rendered(part, fault)
    camera = true.get("camera", {})
    frames = [renderer.frames(one, np.random.default_rng([seed, k]), **camera) for k, one in enumerate(views)]
    renderer.write_scan(folder, true.get("stated", Rig()), ANGLES, frames)


def measure(study, case, seed):
    part, fault = case.split(": ", 1)
    scan, mesh = study.fresh("scan"), study.fresh("mesh.ply")
    render(scan, part, fault, seed)
    answer = study.run("reconstruct", scan, "-o", mesh, allowed=(0, 4, 5))
    found = answer["registration"]["explanation"]
    named = found["best"] if found["decided"] else "undecided"
    return {
        "trusted": answer["trustworthy"],
        # A rig that was found to be another one is refined, and the views are registered again.
        "named": named if answer.get("refinement") is None else "rig",
        "left_out": len(answer["registration"]["left_out"]),
        **compared(part, mesh),
    }


def compared(part, mesh):
    vertices = read_ply(mesh)
    error = renderer.errors(renderer.PARTS[part], points_of(vertices))
    over = np.abs(error) / vertices["sigma_mm"]
    return {
        "rms_mm": float(rms(error)),
        "over_sigma": float(rms(over)),
        "over_sigma_95": float(np.quantile(over, 0.95)),
        "beyond_3": float(np.mean(over > 3)),
    }


def is_sound(case):
    return case.removesuffix(NOISY).endswith(f": {SOUND}")


def report(text, results):
    text.add(
        "`./run figures moved_parts`: distance functions, frames of 480 x 384 pixels by marched rays, 8 views with fringes of 1280, 160 "
        "and 20 px; nothing of the program's own rendering. The error is the distance of the vertices to the part after the best "
        "rigid fit, over the sigma of each vertex (RMS, and 95th percentile).\n"
    )
    text.table(
        "part",
        "what is not as stated",
        "named",
        "views left out",
        "trusted",
        "RMS, mm",
        "over that without",
        "error over sigma",
        "95 %",
    )
    found = {case: all_seeds for case, all_seeds in results.items() if all_seeds}
    for case, seeds in found.items():
        part, fault = case.split(": ", 1)
        right = [one["named"] in FAULTS[fault][1] for one in seeds]
        wrong = sorted({one["named"] for one, is_right in zip(seeds, right) if not is_right})
        trusted = [one for one in seeds if one["trusted"]]
        without = found.get(f"{part}: {SOUND}{NOISY if fault.endswith(NOISY) else ''}")
        text.row(
            part,
            fault,
            f"{sum(right)} of {len(seeds)}" + (f" (else {', '.join(wrong)})" if wrong else ""),
            max(one["left_out"] for one in seeds),
            f"{len(trusted)} of {len(seeds)}",
            f"{mean(seeds, 'rms_mm'):.4f}",
            f"{mean(seeds, 'rms_mm') / mean(without, 'rms_mm'):.2f}" if without else "",
            f"{mean(trusted, 'over_sigma'):.2f}" if trusted else "",
            f"{mean(trusted, 'over_sigma_95'):.2f}" if trusted else "",
        )
    faulty = [(case, one) for case, seeds in found.items() for one in seeds if not is_sound(case)]
    sound = [(case, one) for case, seeds in found.items() for one in seeds if is_sound(case)]
    named = sum(one["named"] in FAULTS[case.split(": ", 1)[1]][1] for case, one in faulty)
    refused = sum(not one["trusted"] for _, one in faulty)
    text.add(
        f"\nOf {len(faulty)} scans with a fault {named} are named right and {refused} are not trusted; of {len(sound)} sound ones "
        f"{sum(not one['trusted'] for _, one in sound)} are not trusted.\n"
    )
    silent = [case for case, one in faulty if one["trusted"] and one["beyond_3"] > 0.05]
    if silent:
        text.add(f"\nTrusted, with more than 5 % of the vertices off by more than 3 sigma: {'; '.join(silent)}.\n")
    blamed = [case for case, one in sound if one["named"] != "as-stated"]
    if blamed:
        raise NotAsWanted(f"a sound scan is blamed: {', '.join(blamed)}")


def mean(seeds, key):
    return np.sqrt(np.mean(np.square([one[key] for one in seeds])))
