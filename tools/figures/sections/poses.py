"""Faults of the poses of views: which cause is named, and what remains of the error."""
import os

TITLE = "What moved between views"

CASES = {part: 1 for part in ("bracket", "bust", "shaft", "ball-bar")}


def measure(study, case, seed):
    study.build("test_registration")
    os.environ["FRANGIA_POSE_PART"] = case
    os.environ["FRANGIA_POSE_SEEDS"] = "3"
    return study.tested("test_registration", "PoseStudy.NamesTheFault")


def report(text, results):
    text.add(
        "`FRANGIA_POSE_PART=bracket FRANGIA_POSE_SEEDS=3 test_registration --gtest_filter=PoseStudy.NamesTheFault`: 8 views of the digital rig with a quarter of the pixels on a side, "
        "points by the true rig and pose with noise of the phase, 3 seeds; RMS error of blocks of points after the best rigid fit, over that of the scan without the fault. "
        "A size is the largest motion of the fault in multiples of the noise of a pair of surfels. Refused: not trustworthy, exit code 5. "
        "Silent: more than 5 % of the blocks off by more than 3 sigma of the poses, with exit code 0.\n"
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
            text.row(
                part,
                cell["fault"],
                cell["size"],
                f"{cell['right']} of {cell['seeds']}",
                f"{cell['wrong']}",
                f"{cell['left_out']}",
                f"{cell['refused']}",
                f"{cell['silent']}",
                f"{cell['ratio']:.2f}",
                f"{cell['over_sigma']:.2f}",
            )
