#!/usr/bin/env python3
"""Measures how time, memory and accuracy of a reconstruction depend on the number of views.

usage: views_scaling.py PROGRAM FOLDER [VIEWS ...]

Simulates scans of the bracket with 6, 24 and 96 views, or with the numbers given, on a misaligned turntable:
the digital rig with half the pixels of its camera on a side, 480 x 384. Each scan is reconstructed with and
without registration. The table has the processor time, the largest resident memory, the error of the
refined axis and the RMS deviation of the mesh from the truth. The exit code is 1 when 96 views take more
than 20 times the processor time of 6, or more than 300 MB.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import time

AXIS_OFFSET_MM = 0.5
AXIS_TILT_DEG = 0.2
FAULTS = ["--axis-offset", f"{AXIS_OFFSET_MM}mm", "--axis-tilt", str(AXIS_TILT_DEG), "--angle-error", "0.05"]
MOST_TIMES = 20.0  # processor time of 96 views, per that of 6
MOST_MB = 300.0


def half_rig(program, folder):
    """The digital rig with half the pixels of its camera on a side."""
    rig = folder / "digital-half.toml"
    if not rig.exists():
        scan = folder / "digital"
        subprocess.run([program, "--quiet", "simulate", "plate", "--rig", "digital", "--views", "1", "-o", scan], check=True)

        def halved(match):
            numbers = [0.5 * float(number) for number in match[2].split(",")]
            numbers = [int(number) for number in numbers] if match[1] == "size_px" else numbers
            return f"{match[1]} = [{', '.join(map(str, numbers))}]"

        text = (scan / "rig.toml").read_text()
        rig.write_text(re.sub(r"(size_px|focal_px|principal_point_px) = \[([^\]]*)\]", halved, text, count=3))
    return rig


def reconstruct(program, scan, *options):
    """The program's answer, its processor time in seconds and its largest resident memory in MB."""
    mesh = scan.with_suffix(".ply")
    begin = time.monotonic()
    process = subprocess.Popen([program, "--json", "reconstruct", scan, "-o", mesh, *options], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status != 0:
        sys.exit(f"views_scaling: {scan} could not be reconstructed")
    answer = json.loads(output)
    return {"answer": answer, "elapsed_s": time.monotonic() - begin, "time_s": usage.ru_utime + usage.ru_stime,
            "peak_mb": usage.ru_maxrss / 1024.0, "mesh": mesh}


def rms_um(program, mesh, scan):
    answer = subprocess.run([program, "--json", "inspect", mesh, "--reference", scan / "truth.ply"], check=True,
                            capture_output=True).stdout
    return 1e3 * json.loads(answer)["rms_mm"]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    numbers = [int(number) for number in sys.argv[3:]] or [6, 24, 96]
    folder.mkdir(parents=True, exist_ok=True)
    rig = half_rig(program, folder)
    print("| views | registration | processor s | elapsed s | peak MB | axis moved, of 0.5 mm | axis turned, of 0.2 degrees | RMS um |")
    print("|---|---|---|---|---|---|---|---|")
    figures = {}
    for number in numbers:
        scan = folder / f"bracket-{number}"
        if not (scan / "scan.toml").exists():
            subprocess.run([program, "--quiet", "simulate", "bracket", "--rig", rig, "--views", str(number), *FAULTS, "-o", scan],
                           check=True)
        for options in ["--no-register"], []:
            done = reconstruct(program, scan, *options)
            found = done["answer"].get("registration") or {}
            moved = f"{found['axis_moved_mm']:.4f}" if found else "-"
            turned = f"{found['axis_turned_deg']:.5f}" if found else "-"
            print(f"| {number} | {'no' if options else 'yes'} | {done['time_s']:.1f} | {done['elapsed_s']:.1f} | {done['peak_mb']:.0f} "
                  f"| {moved} | {turned} | {rms_um(program, done['mesh'], scan):.1f} |", flush=True)
            figures[number] = done
    if 6 in figures and 96 in figures:
        times = figures[96]["time_s"] / figures[6]["time_s"]
        print(f"\n96 views take {times:.1f} times the processor time of 6 views, and {figures[96]['peak_mb']:.0f} MB.")
        if times > MOST_TIMES or figures[96]["peak_mb"] > MOST_MB:
            sys.exit(f"views_scaling: more than {MOST_TIMES:.0f} times, or more than {MOST_MB:.0f} MB")


if __name__ == "__main__":
    main()
