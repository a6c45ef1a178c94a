"""The digital rig with half the pixels of its camera on a side, 480 x 384, for studies that need many small scans."""
import re
import subprocess


def halved(text):
    """The text of a rig.toml whose first camera has half the pixels on a side."""

    def half(match):
        numbers = [0.5 * float(number) for number in match[2].split(",")]
        numbers = [int(number) for number in numbers] if match[1] == "size_px" else numbers
        return f"{match[1]} = [{', '.join(map(str, numbers))}]"

    return re.sub(r"(size_px|focal_px|principal_point_px) = \[([^\]]*)\]", half, text, count=3)


def half_rig(program, folder):
    """The path of the rig in `folder`, written when it is missing."""
    rig = folder / "digital-half.toml"
    if not rig.exists():
        scan = folder / "digital"
        subprocess.run(
            [program, "--quiet", "simulate", "plate", "--rig", "digital", "--views", "1", "-o", scan], check=True
        )
        rig.write_text(halved((scan / "rig.toml").read_text()))
    return rig
