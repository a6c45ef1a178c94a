"""Time, memory and accuracy of a reconstruction against the number of views."""
import json
import os
import subprocess
import sys

from study import NotAsWanted

TITLE = "Time and memory against the number of views"

VIEWS = (6, 24, 96)
CASES = {str(views): 1 for views in VIEWS}
AXIS_OFFSET_MM = 0.5
AXIS_TILT_DEG = 0.2
ERRORS = ("--axis-offset", f"{AXIS_OFFSET_MM}mm", "--axis-tilt", AXIS_TILT_DEG, "--angle-error", 0.05)
MOST_TIMES = 20.0  # processor time of 96 views, per that of 6
MOST_MB = 300.0


def reconstruct(program, scan, mesh, *options):
    """The program's answer, its processor time in seconds and its largest resident memory in MB."""
    process = subprocess.Popen(
        [program, "--json", "reconstruct", scan, "-o", mesh, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"figures: {scan} could not be reconstructed")
    return json.loads(output), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0


def measure(study, case, seed):
    scan = study.simulated("bracket", "--rig", study.half_rig, "--views", case, *ERRORS)
    mesh, rows = study.work / "mesh.ply", {}
    for registered, options in (("no", ["--no-register"]), ("yes", [])):
        answer, processor_s, peak_mb = reconstruct(study.program, scan, mesh, *options)
        rms_mm = study.run("inspect", mesh, "--reference", scan / "truth.ply")["rms_mm"]
        rows[registered] = {
            "registration": answer.get("registration"),
            "processor_s": processor_s,
            "peak_mb": peak_mb,
            "rms_mm": rms_mm,
        }
    return rows


def report(text, results):
    text.add(
        f"The bracket on a misaligned turntable (`{' '.join(map(str, ERRORS))}`), digital rig with half its pixels on a side, 480 x 384; wanted: 96 views take at most {MOST_TIMES:.0f} times the processor time of 6, and at most {MOST_MB:.0f} MB.\n"
    )
    text.table(
        "views",
        "registration",
        "processor s",
        "peak MB",
        f"axis moved, of {AXIS_OFFSET_MM} mm",
        f"axis turned, of {AXIS_TILT_DEG} degrees",
        "RMS mm",
    )
    for views, (rows,) in results.items():
        for registered, row in rows.items():
            found = row["registration"] or {}
            text.row(
                views,
                registered,
                f"{row['processor_s']:.1f}",
                f"{row['peak_mb']:.0f}",
                f"{found['axis_moved_mm']:.4f}" if found else "",
                f"{found['axis_turned_deg']:.5f}" if found else "",
                f"{row['rms_mm']:.4f}",
            )
    few, many = (results[str(views)][0]["yes"] for views in (VIEWS[0], VIEWS[-1]))
    ratio = many["processor_s"] / few["processor_s"]
    text.add(f"\nWith registration, {VIEWS[-1]} views take {ratio:.1f} times the processor time of {VIEWS[0]}.")
    if ratio > MOST_TIMES or many["peak_mb"] > MOST_MB:
        raise NotAsWanted(
            f"{VIEWS[-1]} views take more than {MOST_TIMES:.0f} times the processor time of {VIEWS[0]}, or more than {MOST_MB:.0f} MB"
        )
