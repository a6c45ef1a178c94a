"""Sizes of the features of simulated scans against the drawing, and how often their intervals cover it."""
import time

import numpy

TITLE = "Features"
PAGE = "inspection.md"

FIRST = 40
# Diameters of the shaft's cylinders that the rig sees, and where along the axis they lie; that of 44 mm is in the shade
# of the flange. The model has 512 facets.
SHAFT = [(36.0, 1, 18), (52.0, 22, 37), (36.0, 38, 79), (28.0, 83, 99)]
FACETS = 512
# Heights of its faces that the rig sees, and distances between them.
FACES = [38.0, 80.0, 100.0]
DISTANCES = [(38.0, 80.0), (38.0, 100.0), (80.0, 100.0)]

# A turntable that is not where rig.toml states, so that registration finds it.
MISALIGNED = ("--axis-offset", 0.3, "--axis-tilt", 0.2, "--angle-error", 0.05)

# 4 diameters and 3 distances of each shaft: 420 results in full.
CASES = {"shaft": 60, "misaligned": 12, "ball bar": 1, "fine shaft": 1}
PART = {"shaft": 30, "misaligned": 6}


def faces_of(features):
    """The largest plane at each height, and the uncertainty of its place."""
    planes = [f for f in features if f["kind"] == "plane" and abs(f["axis"][2]) > 0.999]
    found = {}
    for height in FACES:
        near = [f for f in planes if abs(f["center_mm"][2] - height) < 0.5]
        if near:
            found[height] = max(near, key=lambda f: f["points"])
    return found


def modelled(diameter):
    """The diameter whose cylinder fits the facets best: their mean distance from the axis."""
    half = numpy.pi / FACETS
    return diameter * (2.0 * numpy.cos(half) + 1.0) / 3.0


def cylinder_at(features, diameter, low, high):
    """The cylinder of a nominal size whose center lies between two heights."""
    found = [
        f
        for f in features
        if f["kind"] == "cylinder" and low < f["center_mm"][2] < high and abs(f["diameter_mm"] - diameter) < 1
    ]
    return max(found, key=lambda f: f["points"], default=None)


def write_fine_shaft(path, step_mm=0.13, noise_mm=0.005):
    """A turned part of 2 million triangles with noise, without sigma."""
    corners = numpy.array(
        [(0.2, 0), (18, 0), (18, 20), (26, 20), (26, 38), (18, 38), (18, 80), (14, 80), (14, 100), (0.2, 100)], float
    )
    profile = [corners[:1]]
    for begin, end in zip(corners[:-1], corners[1:]):
        steps = int(round(numpy.linalg.norm(end - begin) / step_mm))
        profile.append(begin + (end - begin) * (numpy.arange(1, steps + 1) / steps)[:, None])
    profile = numpy.concatenate(profile)
    around = int(2 * numpy.pi * 18 / step_mm)
    angle = 2 * numpy.pi * numpy.arange(around) / around
    height = numpy.broadcast_to(profile[:, 1, None], (len(profile), around))
    points = numpy.stack([profile[:, :1] * numpy.cos(angle), profile[:, :1] * numpy.sin(angle), height], -1)
    points += numpy.random.default_rng(1).normal(0, noise_mm, points.shape)
    index = numpy.arange(points.shape[0] * around).reshape(-1, around)
    below, above, next_below, next_above = (
        index[:-1],
        index[1:],
        numpy.roll(index, -1, axis=1)[:-1],
        numpy.roll(index, -1, axis=1)[1:],
    )
    triangles = numpy.concatenate(
        [numpy.stack([below, next_below, next_above], -1), numpy.stack([below, next_above, above], -1)]
    ).reshape(-1, 3)
    faces = numpy.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {index.size}\n" + "".join(
        f"property float {axis}\n" for axis in "xyz"
    )
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(head.encode() + points.reshape(-1, 3).astype("<f4").tobytes() + faces.tobytes())
    return len(triangles)


def sizes_of(features):
    """Error and U95 of the sizes of a shaft that are found; a size is an index of SHAFT + DISTANCES."""
    found = {}
    for number, cylinder in enumerate(SHAFT):
        feature = cylinder_at(features, *cylinder)
        if feature:
            found[number] = [feature["diameter_mm"] - modelled(cylinder[0]), feature["u95_mm"]]
    faces = faces_of(features)
    for number, (low, high) in enumerate(DISTANCES, len(SHAFT)):
        if low in faces and high in faces:
            found[number] = [
                faces[high]["center_mm"][2] - faces[low]["center_mm"][2] - (high - low),
                numpy.hypot(faces[low]["u95_mm"], faces[high]["u95_mm"]),
            ]
    return found


def balls_of(study):
    mesh, _ = study.reconstructed(study.shared("balls"))
    begin = time.monotonic()
    features = study.run("inspect", mesh, "--features")["features"]
    return {
        "seconds": time.monotonic() - begin,
        "spheres": [f for f in features if f["kind"] == "sphere" and abs(f["diameter_mm"] - 40) < 1],
    }


def fine_shaft(study):
    """The best of three."""
    mesh = study.work / "fine-shaft.ply"
    triangles = write_fine_shaft(mesh)
    searches = [study.run("inspect", mesh, "--features") for _ in range(3)]
    return {
        "triangles": triangles,
        "kinds": [feature["kind"] for feature in searches[0]["features"]],
        "seconds": min(search["seconds"]["features"] for search in searches),
    }


def measure(study, case, seed):
    if case == "ball bar":
        return balls_of(study)
    if case == "fine shaft":
        return fine_shaft(study)
    mesh, _ = study.reconstructed(
        study.simulated("shaft", "--seed", seed, *(MISALIGNED if case == "misaligned" else ()))
    )
    return sizes_of(study.run("inspect", mesh, "--features")["features"])


def of_size(found, number):
    """Errors and U95 of a size, from the results of the seeds."""
    return numpy.array([one[str(number)] for one in found if str(number) in one]).reshape(-1, 2).T


def report(text, results):
    found = results["shaft"]
    text.add(
        f"`frangia simulate shaft --seed N -o SCAN`, `frangia reconstruct SCAN -o MESH.ply`, `frangia inspect MESH.ply --features`; {len(found)} seeds. The truth of a diameter is the cylinder that fits the facets of the simulated part.\n"
    )
    text.table(
        "size, mm",
        "found",
        f"within its interval, first {min(FIRST, len(found))}",
        "within its interval",
        "mean error, mm",
        "spread, mm",
        "mean U95, mm",
        "U95 over 1.96 spread",
    )
    covered = total = 0
    ratios = []
    for number, size in enumerate(SHAFT + DISTANCES):
        error, u95 = of_size(found, number)
        held = abs(error) <= u95
        inside = int(held.sum())
        covered, total = covered + inside, total + len(error)
        spread = error.std(ddof=1)
        ratios.append(u95.mean() / (1.96 * spread))
        name = (
            f"diameter {size[0]:.0f} at z = {size[1]} to {size[2]}"
            if size in SHAFT
            else f"distance of the faces at z = {size[0]:.0f} and {size[1]:.0f}"
        )
        text.row(
            name,
            len(error),
            f"{int(held[:FIRST].sum())} of {len(held[:FIRST])}",
            f"{inside} of {len(error)}",
            f"{error.mean():+.4f}",
            f"{spread:.4f}",
            f"{u95.mean():.4f}",
            f"{ratios[-1]:.2f}",
        )
    text.add(
        f"\nPooled: {covered} of {total} ({100 * covered / max(total, 1):.1f} %), wanted 92 to 98 %; intervals {numpy.mean(ratios):.2f} times those from the spread, wanted at most 1.2."
    )

    error, u95 = numpy.concatenate([of_size(results["misaligned"], number) for number in range(len(SHAFT))], axis=1)
    inside = int((abs(error) <= u95).sum())
    text.add(
        f"\nWith a turntable that is not where rig.toml states (`simulate {' '.join(map(str, MISALIGNED))}`), {len(results['misaligned'])} seeds: errors of the diameters {numpy.sqrt(numpy.mean(error**2)):.4f} mm RMS, mean U95 {u95.mean():.4f} mm; {inside} of {len(error)} within their intervals ({100 * inside / max(len(error), 1):.1f} %), wanted 92 % or more."
    )

    text.add("\n`frangia inspect balls.ply --features` on the mesh of ../shared/scans/balls:\n")
    text.table("", "measured, mm", "wanted, mm")
    spheres = results["ball bar"][0]["spheres"]
    for sphere in spheres:
        text.row("sphere", f"{sphere['diameter_mm']:.4f} ± {sphere['u95_mm']:.4f}", "40 within 0.01")
    if len(spheres) == 2:
        text.row(
            "spacing",
            f"{numpy.linalg.norm(numpy.subtract(*(sphere['center_mm'] for sphere in spheres))):.4f}",
            "70 within 0.01",
        )
    text.add(f"\nSeconds with reading: {results['ball bar'][0]['seconds']:.1f}.")

    (fine,) = results["fine shaft"]
    text.add(
        f"\nA turned part of {fine['triangles']} triangles with noise of 0.005 mm: {fine['kinds'].count('cylinder')} of 4 cylinders and {fine['kinds'].count('plane')} of 5 planes in {fine['seconds']:.1f} s, wanted 5 s; the best of three."
    )
