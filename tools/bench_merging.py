#!/usr/bin/env python3
"""Times MeshLab's merging of range maps (VCG) on the data of the benchmark of the fusion.

usage: bench_merging.py FOLDER    which holds fuse_views.json and data/range-*.ply, as `./run bench`
                                  leaves them

Prints how many times longer MeshLab takes, by its own clock and without reading and preparing the files,
and writes merging.json. It takes minutes. Without MeshLab it prints a message. Debian: meshlab, xvfb.
"""
import json
import pathlib
import re
import sys

import meshlab

WANTED = 20
MERGE = [
    ("RichAbsPerc", "voxSize", 0.2),
    ("RichInt", "subdiv", 1),
    ("RichFloat", "geodesic", 2),
    ("RichBool", "openResult", "true"),
    ("RichInt", "smoothNum", 1),
    ("RichInt", "wideNum", 3),
    ("RichBool", "mergeColor", "false"),
    ("RichBool", "simplification", "false"),
    ("RichInt", "normalSmooth", 3),
]


def merged_by_meshlab(maps):
    """Returns MeshLab's own time in seconds and the number of triangles."""
    log = meshlab.apply("Surface Reconstruction: VCG", MERGE, maps)
    totals = re.findall(r"^Total\s+(\d+)", log, re.M)  # microseconds of its processor, one a stage
    saved = re.search(r"saved as .*\((\d+) vn (\d+) fn\)", log)
    if not totals or saved is None:
        sys.exit(f"MeshLab did not merge the range maps:\n{log[-2000:]}")
    return max(map(int, totals)) * 1e-6, int(saved[2])


def main(folder):
    maps = sorted((folder / "data").glob("range-*.ply"))
    if meshlab.is_missing():
        print("MeshLab is not installed (meshlab, xvfb): the fusion is not compared")
        return
    if len(maps) != 12:
        sys.exit(f"{folder}/data does not hold the 12 range maps; run ./run bench first")
    runs = json.loads((folder / "fuse_views.json").read_text())["benchmarks"]
    ours = next(run for run in runs if run["name"].startswith("fuse_twelve_views/1200"))
    seconds, triangles = merged_by_meshlab(maps)
    ratio = seconds / (ours["real_time"] * 1e-3)
    print(
        f"fusing 12 views of 1200 x 1200: MeshLab's VCG merging takes {ratio:.1f} times as long ({seconds:.1f} s for "
        f"{triangles} triangles; {ours['real_time'] * 1e-3:.2f} s, the mean of seven, for {ours['triangles']:.0f}), wanted {WANTED}: "
        f"{'met' if ratio >= WANTED else 'MISSED'}"
    )
    (folder / "merging.json").write_text(json.dumps({"seconds": seconds, "ratio": ratio, "wanted": WANTED}, indent=2))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
