"""Faults of the poses of views: which cause is named, and what remains of the error."""
import os

TITLE = "What moved between views"

CASES = {part: 1 for part in ("bracket", "bust", "shaft", "ball-bar")}


def measure(study, case, seed):
    study.build("test_registration")
    os.environ["FRANGIA_POSE_PART"] = case
    os.environ["FRANGIA_POSE_SEEDS"] = "5"
    return study.tested("test_registration", "PoseStudy.NamesTheFault")


def report(text, results):
    text.add(
        "`FRANGIA_POSE_PART=bracket FRANGIA_POSE_SEEDS=5 test_registration --gtest_filter=PoseStudy.NamesTheFault`: 8 views of the digital rig with a quarter of the pixels on a side, "
        "points by the true rig and pose with noise of the phase, 5 seeds; RMS error of blocks of points after the best rigid fit, over that of the scan without the fault. "
        "A size is the largest motion of the fault in multiples of the noise of a pair of surfels.\n"
    )
    text.table("part", "fault", "size", "named right", "named wrong", "views left out", "RMS over that without")
    for part, (cells,) in results.items():
        for cell in cells:
            text.row(
                part,
                cell["fault"],
                cell["size"],
                f"{cell['right']} of {cell['seeds']}",
                f"{cell['wrong']}",
                f"{cell['left_out']}",
                f"{cell['ratio']:.2f}",
            )
