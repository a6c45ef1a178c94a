"""Peak memory and processor time of `reconstruct` against the number of views."""
import os
import subprocess
import sys

from campaign import ROOT, Answer

sys.path.append(str(ROOT / "tools"))

from half_rig import half_rig  # noqa: E402

VIEWS_SHORT, VIEWS_LONG = (6, 12), (6, 24, 96)
MAX_GROWTH = 1.5  # of memory, from the fewest views to the most


def peak(command):
    """Peak memory in MB, processor seconds, and exit status."""
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime, status


def run(campaign):
    numbers = VIEWS_LONG if campaign.is_long else VIEWS_SHORT
    answer = Answer(
        "memory", f"`reconstruct` of {', '.join(map(str, numbers))} views of 480 × 384 pixels", len(numbers)
    )
    rig, figures = half_rig(campaign.program, campaign.work), []
    for views in numbers:
        scan = campaign.fresh("views")
        subprocess.run(
            [campaign.program, "--quiet", "simulate", "bust", "--rig", rig, "--views", str(views), "-o", scan],
            check=True,
        )
        megabytes, seconds, status = peak(
            [campaign.program, "--quiet", "reconstruct", scan, "-o", scan.parent / "mesh.ply"]
        )
        if status != 0:
            answer.failures.append(f"{views} views: exit status {status}")
        figures.append((views, megabytes, seconds))
    answer.measured = "; ".join(
        f"{views} views: {megabytes:.0f} MB, {seconds:.1f} processor s" for views, megabytes, seconds in figures
    )
    first, last = figures[0], figures[-1]
    if last[1] > MAX_GROWTH * first[1] + 50:
        answer.failures.append(
            f"memory grows from {first[1]:.0f} MB at {first[0]} views to {last[1]:.0f} MB at {last[0]}"
        )
    # Up to 24 views, the registration compares all pairs, so the time of the short run grows faster than the number of views.
    if campaign.is_long and last[2] > 1.25 * first[2] * last[0] / first[0]:
        answer.failures.append(
            f"time grows from {first[2]:.1f} s at {first[0]} views to {last[2]:.1f} s at {last[0]}, faster than the number of views"
        )
    return answer
