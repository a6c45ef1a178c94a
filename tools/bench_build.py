"""Measures how long the project takes to compile: python3 tools/bench_build.py [FOLDER]

From nothing, without a compiler cache, in a build tree of its own (default: build/bench): the program, then the libraries
and the Python module, then one changed source of several modules. Processor time counts, user and system, since wall time
depends on what else the machine does; the wall time of each step stands beside it. Prints a table and writes it as JSON to
out/bench/build.json. The limits are those that CONTRIBUTING.md states.
"""

import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHANGED = {  # module -> the source that is changed, one of the longest of its module
    "phase": "src/frangia/phase/temporal/unwrap_sequence.cpp",
    "fusion": "src/frangia/fusion/fuse_views.cpp",
    "service": "src/frangia/service/internal/scan_commands.cpp",
    "apps": "apps/frangia/reconstruct_verb.cpp",
}
LIMITS_S = {"program": 600, "everything": 780}
LIMIT_OF_CHANGE_S = 25


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def timed(command):
    """Runs a command and returns its processor and wall time in seconds."""
    begin, wall = processor_seconds(), time.monotonic()
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"bench_build: {' '.join(command)} failed:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return {"processor_s": round(processor_seconds() - begin, 1), "wall_s": round(time.monotonic() - wall, 1)}


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/bench").resolve()
    shutil.rmtree(folder, ignore_errors=True)
    os.environ["CCACHE_DISABLE"] = "1"
    configure = ["cmake", "--preset", "release", "-B", str(folder)]
    timed(configure + ["-DFRANGIA_BENCHMARKS=OFF", "-DFRANGIA_TESTS=OFF"])
    if (ROOT / "build/release/web/node_modules").is_dir():  # downloads do not count
        (folder / "web").mkdir(exist_ok=True)
        timed(["cp", "-a", str(ROOT / "build/release/web"), str(folder)])
    build = ["cmake", "--build", str(folder)]
    rows = {"program": timed(build + ["--target", "frangia"])}
    rest = timed(build)
    rows["everything"] = {key: round(rows["program"][key] + rest[key], 1) for key in rest}
    for module, source in CHANGED.items():
        (ROOT / source).touch()
        rows[f"one changed source of {module}"] = timed(build + ["--target", "frangia"])
    for name, row in rows.items():
        row["limit_s"] = LIMITS_S.get(name, LIMIT_OF_CHANGE_S)
        limited = "processor" if name in LIMITS_S else "wall"
        print(
            f"{name:32} {row['processor_s']:8.1f} s processor {row['wall_s']:8.1f} s wall; limit {row['limit_s']} s {limited}"
        )
    out = ROOT / "out/bench/build.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
