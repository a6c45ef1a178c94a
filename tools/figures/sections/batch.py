"""Many scans: the gain by two at a time, and a real Slurm of one node whose daemon and tasks are killed."""
import csv
import json
import random
import shutil
import subprocess
import sys
import time

from study import ROOT

sys.path.insert(0, str(ROOT / "tools"))
from half_rig import half_rig  # noqa: E402
from slurm_node import SlurmNode, is_installed  # noqa: E402

TITLE = "Many scans"
SCANS = 60
PARTS = ["plate", "shaft", "bracket", "ball-bar"]


def make_scans(study):
    """Sixty folders of four small scans: copies share their frames by hard links."""
    folder = study.work / "batch-scans"
    rig = half_rig(study.program, study.work)
    made = [study.made(f"batch-{part}", "simulate", part, "--rig", rig, "--views", 6) for part in PARTS]
    if not folder.exists():
        unfinished = folder.with_name("unfinished-batch-scans")
        shutil.rmtree(unfinished, ignore_errors=True)
        for i in range(SCANS):
            subprocess.run(
                ["cp", "-rl", made[i % len(made)], unfinished / f"{i:02}"]
                if i
                else ["sh", "-c", f"mkdir -p {unfinished} && cp -rl {made[0]} {unfinished}/00"],
                check=True,
            )
        unfinished.rename(folder)
    return folder


def timed(study, folder, name, *options):
    shutil.rmtree(study.work / name, ignore_errors=True)
    begin = time.monotonic()
    subprocess.run(
        [study.program, "--quiet", *options[2:], "batch", folder, "-o", study.work / name, *options[:2]],
        check=False,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    seconds = time.monotonic() - begin
    return seconds, json.loads((study.work / name / "table.json").read_text())


def side_by_side(study, folder, lanes):
    """Seconds of bare `reconstruct` of all scans, one process after the other in each lane: the limit of the machine."""

    def commands(lane):
        return " && ".join(
            f"{study.program} --quiet --threads 1 reconstruct {folder / f'{i:02}'} -o {study.work / f'lane-{lane}.ply'}"
            for i in range(lane, SCANS, lanes)
        )

    begin = time.monotonic()
    running = [
        subprocess.Popen(["sh", "-c", commands(lane)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for lane in range(lanes)
    ]
    if any(process.wait() for process in running):
        raise RuntimeError("a scan cannot be reconstructed")
    return time.monotonic() - begin


def kill_at_random(node, done):
    """Kills the controller five times and requeues tasks while the array runs."""
    randomly = random.Random(1)
    kills = requeued = 0
    while node.is_busy():
        time.sleep(randomly.uniform(0.5, 2.0))
        if kills < 5 and randomly.random() < 0.3:
            node.kill_controller()
            kills += 1
        elif requeued < 20:
            for job in node.running()[:1]:
                node.requeue(job)
                requeued += 1
        if time.monotonic() > done:
            raise RuntimeError("the array does not end")
    return kills, requeued


def measure(study):
    folder = make_scans(study)
    one, rows = timed(study, folder, "batch-one", "--jobs", "1", "--threads", "1")
    two, _ = timed(study, folder, "batch-two", "--jobs", "2", "--threads", "1")
    wide, _ = timed(study, folder, "batch-wide", "--jobs", "1", "--threads", "2")
    study.add(f"`frangia batch` on {SCANS} small scans (480 x 384 pixels, 6 views).\n")
    study.table("", "measured", "wanted")
    study.row("scans done", sum(row["state"] == "done" for row in rows), SCANS)
    study.row("`--jobs 1 --threads 1`, seconds", f"{one:.1f}", "")
    study.row("its ratio to `--jobs 2 --threads 1`", f"{one / two:.2f}", "at least 1.8")
    floor = side_by_side(study, folder, 1) / side_by_side(study, folder, 2)
    study.row(
        "the same ratio of bare `reconstruct`, one after the other and two beside each other: the limit of the machine",
        f"{floor:.2f}",
        "",
    )
    study.row("`--jobs 1 --threads 2` over `--jobs 2 --threads 1`", f"{wide / two:.2f}", "at least 1")
    study.row("most memory of a scan, MB", f"{max(row['memory_mb'] for row in rows):.0f}", "")
    study.row("scans an hour and core", f"{3600 * len(rows) / sum(row['processor_s'] for row in rows):.0f}", "")
    if not is_installed():
        study.add("\nSlurm is not installed here, or this is not root: not tried.")
        return
    out = study.work / "batch-slurm"
    shutil.rmtree(out, ignore_errors=True)
    command = [study.program, "--quiet", "--threads", "1", "batch", folder, "-o", out, "--slurm"]
    with SlurmNode(study.work / "slurm") as node:
        begin = time.monotonic()
        subprocess.run(command, check=True, env=node.environment)
        while node.is_busy():
            time.sleep(0.2)
        calm = time.monotonic() - begin
        shutil.rmtree(out)
        subprocess.run(command, check=True, env=node.environment)
        kills, requeued = kill_at_random(node, time.monotonic() + 1200)
    table = list(csv.DictReader((out / "table.csv").open()))
    study.row("Slurm: seconds more a scan than `--jobs 2`", f"{(calm - two) / SCANS:.2f}", "below 1")
    study.row(
        f"scans done with {kills} kills of the controller and {requeued} tasks requeued",
        sum(row["state"] == "done" for row in table),
        SCANS,
    )
    same = all(
        (out / f"{i:02}" / "mesh.ply").read_bytes() == (study.work / "batch-one" / f"{i:02}" / "mesh.ply").read_bytes()
        for i in range(SCANS)
    )
    study.row("meshes with the bytes of the undisturbed ones", "all" if same else "NOT ALL", "all")
