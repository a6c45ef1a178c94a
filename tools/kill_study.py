"""Kills `frangia scan` with SIGKILL at random moments and repeats the command until the scan is complete.

Usage: kill_study.py PROGRAM RIG KILLS [VIEWS]. Counts acknowledged frames that were lost, and scans
whose frames or mesh differ from those of a scan that was not killed. Prints one line of JSON; fails when a
frame was lost or a scan differs.
"""
import hashlib
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import zlib

program, rig, kills = sys.argv[1], sys.argv[2], int(sys.argv[3])
views = sys.argv[4] if len(sys.argv) > 4 else "4"


def command(scan):
    return [program, "--quiet", "scan", rig, "--views", views, "-o", str(scan)]


def digest(scan):
    """A hash of all frames and of the mesh."""
    mesh = scan.parent / "mesh.ply"
    subprocess.run([program, "--quiet", "reconstruct", str(scan), "-o", str(mesh)], check=True, stderr=subprocess.DEVNULL)
    found = hashlib.sha256(mesh.read_bytes())
    for frame in sorted(scan.rglob("*.png")):
        found.update(str(frame.relative_to(scan)).encode() + frame.read_bytes())
    return found.hexdigest()


def count_lost(scan):
    """The number of acknowledged frames that are missing or changed."""
    manifest = scan / "capture" / "manifest.txt"
    lines = manifest.read_text().splitlines(keepends=True) if manifest.exists() else []
    lost = 0
    for words in (line.split() for line in lines if line.startswith("frame ") and line.endswith("\n")):
        frame = scan / words[1]
        lost += not frame.exists() or zlib.crc32(frame.read_bytes()) != int(words[2], 16)
    return lost


random.seed(1)
with tempfile.TemporaryDirectory(prefix="frangia-kills-") as name:
    folder = pathlib.Path(name)
    begin = time.monotonic()
    subprocess.run(command(folder / "whole" / "scan"), check=True)
    seconds = time.monotonic() - begin
    whole = digest(folder / "whole" / "scan")
    killed = lost = different = scans = 0
    while killed < kills:
        scans += 1
        scan = folder / str(scans) / "scan"
        while True:
            process = subprocess.Popen(command(scan))
            try:
                process.wait(timeout=random.uniform(0.0, seconds) if killed < kills else None)
                break
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                killed += 1
            lost += count_lost(scan)
        lost += count_lost(scan)
        different += digest(scan) != whole
print(json.dumps({"kills": killed, "scans": scans, "lost": lost, "different": different}))
sys.exit(bool(lost or different))
