"""The time that an import of 36 frames takes."""
import time

import cv2

TITLE = "Importing frames of another program"


def measure(study, case, seed):
    scan = study.simulated("bust", "--views", 1, "--periods", "1280,160,20", "--shifts", 12)
    folder = study.work / "import-bmp"
    folder.mkdir()
    for frame in sorted((scan / "views/000").glob("*.png")):
        pattern, number = frame.stem.rsplit("-", 1)
        cv2.imwrite(str(folder / f"{pattern}_{int(number):02}.bmp"), cv2.imread(str(frame), cv2.IMREAD_UNCHANGED))
    begin = time.monotonic()
    answer = study.run(
        "import",
        folder,
        "--names",
        "{pattern}_{frame:02}.bmp",
        "--patterns",
        scan / "scan.toml",
        "--rig",
        scan / "rig.toml",
        "-o",
        study.work / "imported",
    )
    seconds = time.monotonic() - begin
    same = all(
        (study.work / "imported/views/000" / frame.name).exists()
        and (cv2.imread(str(frame), -1) == cv2.imread(str(study.work / "imported/views/000" / frame.name), -1)).all()
        for frame in (scan / "views/000").glob("*.png")
    )
    decoded = study.run("decode", study.work / "imported", "-o", study.work / "imported-stages")
    return {
        "frames": answer["frames"],
        "size_px": answer["size_px"],
        "seconds": seconds,
        "same": same,
        "measured": decoded["pixels"]["measured"],
    }


def report(text, results):
    result = results["import_frames"][0]
    text.add(
        '`frangia import FOLDER -o SCAN --names "{pattern}_{frame:02}.bmp" --patterns scan.toml --rig rig.toml` on the '
        f"BMP frames of a simulated scan, {result['size_px'][0]} x {result['size_px'][1]} pixels, then `frangia decode SCAN`.\n"
    )
    text.table("", "measured", "wanted")
    text.row("frames", result["frames"], 36)
    text.row("seconds of the import", f"{result['seconds']:.2f}", "at most 10")
    text.row("pixels equal to the original", "all" if result["same"] else "NOT ALL", "all")
    text.row("measured pixels of the decoded view", result["measured"], "")
