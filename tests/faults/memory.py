"""Peak memory of `reconstruct` against the number of views, and of every reader against hostile sizes (study `inputs`)."""
import os
import subprocess

from campaign import Answer

VIEWS_SHORT, VIEWS_LONG = (6, 12), (6, 24, 96)
SMALL_RIG_PX = (480, 384)  # half the pixels of the digital rig on a side
MAX_GROWTH = 1.5  # of memory, from the fewest views to the most


def half_rig(campaign):
    """The digital rig with half the pixels of its camera on a side."""
    import re

    scan = campaign.fresh("preset")
    subprocess.run([campaign.program, "--quiet", "simulate", "plate", "--rig", "digital", "--views", "1", "-o", scan], check=True)

    def halved(match):
        numbers = [0.5 * float(number) for number in match[2].split(",")]
        numbers = [int(number) for number in numbers] if match[1] == "size_px" else numbers
        return f"{match[1]} = [{', '.join(map(str, numbers))}]"

    rig = scan.parent / "half.toml"
    rig.write_text(re.sub(r"(size_px|focal_px|principal_point_px) = \[([^\]]*)\]", halved, (scan / "rig.toml").read_text(), count=3))
    return rig


def peak(command):
    """Peak memory in MB and processor seconds."""
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime, status


def run(campaign):
    numbers = VIEWS_LONG if campaign.is_long else VIEWS_SHORT
    answer = Answer("memory", f"`reconstruct` of {', '.join(map(str, numbers))} views of {SMALL_RIG_PX[0]} × {SMALL_RIG_PX[1]} pixels", len(numbers))
    rig, figures = half_rig(campaign), []
    for views in numbers:
        scan = campaign.fresh("views")
        subprocess.run([campaign.program, "--quiet", "simulate", "bust", "--rig", rig, "--views", str(views), "-o", scan], check=True)
        megabytes, seconds, status = peak([campaign.program, "--quiet", "reconstruct", scan, "-o", scan.parent / "mesh.ply"])
        if status != 0:
            answer.failures.append(f"{views} views: exit status {status}")
        figures.append((views, megabytes, seconds))
    answer.measured = "; ".join(f"{views} views: {megabytes:.0f} MB, {seconds:.1f} processor s" for views, megabytes, seconds in figures)
    first, last = figures[0], figures[-1]
    if last[1] > MAX_GROWTH * first[1] + 50:
        answer.failures.append(f"memory grows from {first[1]:.0f} MB at {first[0]} views to {last[1]:.0f} MB at {last[0]}")
    # Up to 24 views are all compared with each other.
    if campaign.is_long and last[2] > 1.25 * first[2] * last[0] / first[0]:
        answer.failures.append(f"time grows from {first[2]:.1f} s at {first[0]} views to {last[2]:.1f} s at {last[0]}, faster than the number of views")
    return answer
