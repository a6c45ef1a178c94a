"""Many scans: the gain by two at a time, and a real Slurm of one node whose daemon and tasks are killed."""
import csv
import json
import random
import shutil
import subprocess
import time

from slurm_node import SlurmNode, is_installed

TITLE = "Many scans"
SCANS = 60
PARTS = ["plate", "shaft", "bracket", "ball-bar"]


def make_scans(study):
    """Sixty folders of four small scans: copies share their frames by hard links."""
    folder = study.work / "scans"
    folder.mkdir()
    made = [study.simulated(part, "--rig", study.half_rig, "--views", 6) for part in PARTS]
    for i in range(SCANS):
        subprocess.run(["cp", "-rl", made[i % len(made)], folder / f"{i:02}"], check=True)
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


def in_slurm(study, folder):
    """Seconds of an undisturbed array, and what a disturbed one leaves, against the meshes of `--jobs 1`."""
    out = study.work / "batch-slurm"
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
    same = all(
        (out / f"{i:02}" / "mesh.ply").read_bytes() == (study.work / "batch-one" / f"{i:02}" / "mesh.ply").read_bytes()
        for i in range(SCANS)
    )
    return {
        "calm": calm,
        "kills": kills,
        "requeued": requeued,
        "done": sum(row["state"] == "done" for row in table),
        "same": same,
    }


def measure(study, case, seed):
    folder = make_scans(study)
    one, rows = timed(study, folder, "batch-one", "--jobs", "1", "--threads", "1")
    two, _ = timed(study, folder, "batch-two", "--jobs", "2", "--threads", "1")
    wide, _ = timed(study, folder, "batch-wide", "--jobs", "1", "--threads", "2")
    return {
        "one": one,
        "two": two,
        "wide": wide,
        "rows": rows,
        "limit": side_by_side(study, folder, 1) / side_by_side(study, folder, 2),
        "slurm": in_slurm(study, folder) if is_installed() else None,
    }


def report(text, results):
    result = results["batch"][0]
    one, two, rows, slurm = (result[key] for key in ("one", "two", "rows", "slurm"))
    text.add(f"`frangia batch` on {SCANS} small scans (480 x 384 pixels, 6 views).\n")
    text.table("", "measured", "wanted")
    text.row("scans done", sum(row["state"] == "done" for row in rows), SCANS)
    text.row("`--jobs 1 --threads 1`, seconds", f"{one:.1f}", "")
    text.row("its ratio to `--jobs 2 --threads 1`", f"{one / two:.2f}", "at least 1.8")
    text.row(
        "the same ratio of bare `reconstruct`, one after the other and two beside each other: the limit of the machine",
        f"{result['limit']:.2f}",
        "",
    )
    text.row("`--jobs 1 --threads 2` over `--jobs 2 --threads 1`", f"{result['wide'] / two:.2f}", "at least 1")
    text.row("most memory of a scan, MB", f"{max(row['memory_mb'] for row in rows):.0f}", "")
    text.row("scans an hour and core", f"{3600 * len(rows) / sum(row['processor_s'] for row in rows):.0f}", "")
    if slurm is None:
        text.add("\nSlurm is not installed here, or this is not root: not tried.")
        return
    text.row("Slurm: seconds more a scan than `--jobs 2`", f"{(slurm['calm'] - two) / SCANS:.2f}", "below 1")
    text.row(
        f"scans done with {slurm['kills']} kills of the controller and {slurm['requeued']} tasks requeued",
        slurm["done"],
        SCANS,
    )
    text.row("meshes with the bytes of the undisturbed ones", "all" if slurm["same"] else "NOT ALL", "all")
