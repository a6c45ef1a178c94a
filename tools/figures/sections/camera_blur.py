"""What the blur of a camera does at edges of paint, and what its correction leaves."""
import functools

import numpy as np

import distance_renderer as renderer
from distance_renderer import Rig
from surfaces import points_of, read_ply, rms

TITLE = "The blur of a camera"
PAGE = "figures-capture.md"

VIEWS = 8
SQUARES_MM = 6
PAINTS = {
    "white": renderer.white,
    "painted": lambda p: np.where(np.floor(p / SQUARES_MM).sum(axis=1) % 2 == 0, 0.85, 0.1),
}
BLURS_PX = [0, 0.7, 1.2]
CASES = {f"{part}, {paint}, {blur}": 1 for part in ("ball bar", "bust") for paint in PAINTS for blur in BLURS_PX}


@functools.lru_cache(maxsize=1)
def samples_of(part, paint):
    angles = 360.0 * np.arange(VIEWS) / VIEWS
    return angles, [renderer.seen(renderer.PARTS[part], Rig(), angle, paint=PAINTS[paint]) for angle in angles]


def errors(study, part, scan, *options):
    mesh = study.fresh("mesh.ply")
    answer = study.run("reconstruct", scan, "-o", mesh, *options, allowed=(0, 4, 5))
    vertices = read_ply(mesh)
    error = renderer.errors(renderer.PARTS[part], points_of(vertices))
    return {
        "trusted": answer["trustworthy"],
        "vertices": len(error),
        "rms_mm": float(rms(error)),
        "over_sigma": float(rms(error / vertices["sigma_mm"])),
    }


def measure(study, case, seed):
    part, paint, blur = case.split(", ")
    angles, samples = samples_of(part, paint)
    views = [
        renderer.frames(one, np.random.default_rng([seed, k]), blur_px=float(blur)) for k, one in enumerate(samples)
    ]
    scan = study.fresh("scan")
    renderer.write_scan(scan, Rig(), angles, views)
    return {"corrected": errors(study, part, scan), "ignored": errors(study, part, scan, "--ignore-blur")}


def report(text, results):
    text.add(
        "`./run figures camera_blur`: the parts of `moved_parts`, white and with cubes of 6 mm painted in 0.10 and 0.85 of the light; "
        "8 views of 480 x 384 pixels by a camera of a normal blur.\n"
    )
    text.table(
        "part",
        "blur, px",
        "RMS, mm",
        "over that without blur",
        "error over sigma",
        "vertices",
        "RMS with `--ignore-blur`, mm",
    )
    for case, (one,) in results.items():
        part, paint, blur = case.split(", ")
        sharp = results[f"{part}, {paint}, 0"][0]["corrected"]
        found, ignored = one["corrected"], one["ignored"]
        text.row(
            f"{part}, {paint}",
            blur,
            f"{found['rms_mm']:.4f}",
            f"{found['rms_mm'] / sharp['rms_mm']:.2f}",
            f"{found['over_sigma']:.2f}" if found["trusted"] else "not trusted",
            found["vertices"],
            f"{ignored['rms_mm']:.4f}{'' if ignored['trusted'] else ', not trusted'}",
        )
