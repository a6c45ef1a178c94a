"""The operator's app: first paint, live preview, large meshes."""
import json
import os
import shutil
import subprocess

from study import ROOT, NotMeasured

TITLE = "The operator's app"


def by_node(study, script, *arguments):
    """The JSON that a script of tests/app prints in its last line; nothing where that script is missing."""
    path = ROOT / "tests" / "app" / script
    if not path.exists():
        return {}
    done = subprocess.run(
        ["node", path, study.program, *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "FRANGIA_WEB": str(study.program.parent.parent / "web")},
    )
    if done.returncode == 77:
        raise NotMeasured(done.stdout.strip())
    if done.returncode != 0:
        raise RuntimeError(done.stdout + done.stderr)
    return json.loads(done.stdout.strip().splitlines()[-1])


def previews(study):
    """Figures of bench_service by the name of the benchmark."""
    bench = study.program.parent / "bench_service"
    if not bench.exists():
        raise NotMeasured("bench_service is not built: configure with -DFRANGIA_BENCHMARKS=ON")
    done = subprocess.run(
        [bench, "--benchmark_format=json", "--benchmark_min_time=2"], check=True, capture_output=True, text=True
    )
    return {one["name"].split("/")[0]: one for one in json.loads(done.stdout)["benchmarks"]}


# Seconds from the last frame to the surface that are wanted, for sizes of the camera up to so many megapixels.
WANTED_S = ((2, 3), (6, 8))

LARGE = {
    "first_picture_s": ("a mesh of 1.7 M triangles on screen, in a window of 1280 x 720", "s", "3 s"),
    "orbit_frames_per_s": ("while a hand orbits it, at a reduced level", "frames a second", "10"),
    "orbit_frame_ms": ("drawing such a frame", "ms", ""),
    "detail_s": ("from the end of that to the finest picture, of 500 000 triangles", "s", "1 s"),
    "rest_frame_ms": ("drawing it at rest", "ms", ""),
    "lasso_ms": ("lasso over a tenth of the triangles, to its picture", "ms", "500 ms"),
    "undo_ms": ("undo of deleting them, to its picture", "ms", "400 ms"),
    "redo_ms": ("redo", "ms", "400 ms"),
}


def measure(study, case, seed):
    if not shutil.which("node"):
        raise NotMeasured("node is missing")
    page, decoded = by_node(study, "figures.mjs"), previews(study)
    return {
        "cores": os.cpu_count(),
        "page": page,
        "decoded": decoded,
        "large": by_node(study, "large_mesh.mjs", "--json"),
        "surface": by_node(study, "last_frame.mjs", "--json"),
    }


def report(text, results):
    result = results["app"][0]
    page, decoded, large = result["page"], result["decoded"], result["large"]
    text.add(f"Measured on {result['cores']} cores, in Debian's Chromium with software rendering.\n")
    text.table("", "measured", "wanted")
    paint = page["first_paint_s"]
    text.row(
        "first paint after `frangia serve`, in a browser that is running",
        f"{paint['median']:.2f} s ({paint['least']:.2f} to {paint['most']:.2f})",
        "1 s",
    )
    for layer, what in (("depth", "depth"), ("points", "points in 3D")):
        live = page["live"][layer]
        text.row(
            f"live preview of recorded frames, 640 x 512, shown as {what}: decoded previews",
            f"{live['decodes_per_s']:.1f} a second",
            "5 a second",
        )
    for name, what, wanted in (
        ("preview_simulated_rig", "12 frames of 640 x 512 to points and message, without a browser", "200 ms"),
        ("preview_four_frames_1_3_mpx", "4 frames of 1280 x 1024 to points and message, without a browser", "125 ms"),
    ):
        one = decoded[name]
        text.row(what, f"{one['real_time']:.0f} ms, {one['processor_ms']:.0f} ms of processor", wanted)
    for one in result.get("surface", []):
        wanted = next(wanted for most, wanted in WANTED_S if one["megapixels"] < most)
        text.row(
            f"surface after the last frame, 8 views of {one['megapixels']:.1f} Mpx, of which the scan ends after "
            f"{one['complete_s']:.1f} s",
            f"{one['surface_s']:.1f} s",
            f"{wanted} s",
        )
    for key, (what, unit, wanted) in LARGE.items():
        if key in large:
            text.row(what, f"{large[key]:.3g} {unit}", wanted)
