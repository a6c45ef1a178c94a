"""Faults of the poses of views: which cause is named, and what remains of the error."""
import json
import subprocess

from study import ROOT, NotAsWanted

TITLE = "What moved between views"

CASES = {part: 1 for part in ("bracket", "bust", "shaft", "ball-bar")}
SEEDS = 3
OF_RIG = ("rig not as stated", "principal point", "focal length")


def measure(study, case, seed):
    """The rows of the benchmark pose_study."""
    study.build("pose_study")
    program = ROOT / "build/release/bin/pose_study"
    answer = subprocess.run([program, case, str(SEEDS)], check=True, capture_output=True, text=True)
    return json.loads(answer.stdout)


def report(text, results):
    text.add(
        f"`build/release/bin/pose_study bracket {SEEDS}`: 8 views of the digital rig with a quarter of the pixels on a side, "
        f"points by the true rig and pose with noise of the phase, {SEEDS} seeds; RMS error of blocks of points after the best rigid fit, over that of the scan without the fault. "
        "A size is the largest motion of the fault in multiples of the noise of a pair of surfels. "
        "Refused: not trustworthy, exit code 5. "
        "Silent: more than 5 % of the blocks off by more than 3 sigma of the poses, with exit code 0. "
        "Where the rig is not as stated, its open parameters enter sigma when the surface is fused, which this study does not do: "
        "`./run figures moved_parts` measures those.\n"
    )
    text.table(
        "part",
        "fault",
        "size",
        "named right",
        "named wrong",
        "views left out",
        "refused",
        "silent",
        "RMS over that without",
        "error over sigma",
    )
    for part, (cells,) in results.items():
        for cell in cells:
            of_poses = cell["fault"] not in OF_RIG
            text.row(
                part,
                cell["fault"],
                cell["size"],
                f"{cell['right']} of {cell['seeds']}",
                f"{cell['wrong']}",
                f"{cell['left_out']}",
                f"{cell['refused']}",
                f"{cell['silent']}" if of_poses else "",
                f"{cell['ratio']:.2f}",
                f"{cell['over_sigma']:.2f}" if of_poses else "",
            )
    blamed = [part for part, (cells,) in results.items() for cell in cells if cell["fault"] == "none" and cell["wrong"]]
    if blamed:
        raise NotAsWanted(f"a sound scan is blamed: {', '.join(blamed)}")
