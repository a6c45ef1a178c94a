"""Kills `frangia scan` with SIGKILL at random moments until it is done, and compares the bytes with
those of a scan that was left alone. Usage: kill_study.py PROGRAM RIG KILLS FOLDER"""
import pathlib
import random
import subprocess
import sys
import time

program, rig, kills, folder = sys.argv[1], sys.argv[2], int(sys.argv[3]), pathlib.Path(sys.argv[4])


def command(out):
    return [program, "--quiet", "scan", "--rig", rig, "--views", "4", "-o", str(out)]


def frames(out):
    return {str(p.relative_to(out)): p.read_bytes() for p in out.rglob("*.png")}


def acknowledged(out):
    manifest = out / "capture-manifest.txt"
    lines = manifest.read_text().splitlines(keepends=True) if manifest.exists() else []
    return [line.split()[1] for line in lines if line.startswith("frame ") and line.endswith("\n")]


random.seed(1)
begin = time.monotonic()
subprocess.run(command(folder / "whole" / "scan"), check=True)
seconds = time.monotonic() - begin
whole = frames(folder / "whole" / "scan")
killed = lost = different = scans = 0
while killed < kills:
    scans += 1
    out = folder / str(scans) / "scan"
    while True:
        process = subprocess.Popen(command(out))
        try:
            process.wait(timeout=random.uniform(0.0, seconds) if killed < kills else None)
            break
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            killed += 1
        lost += sum(not (out / name).exists() for name in acknowledged(out))
    different += frames(out) != whole
print(f"{killed} kills over {scans} scans: {lost} acknowledged frames lost, "
      f"{different} scans differ from the uninterrupted one")
sys.exit(bool(lost or different))
