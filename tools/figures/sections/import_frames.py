"""The time that an import of 36 frames takes."""
import time

TITLE = "Importing frames of another program"


def measure(study):
    import cv2

    scan = study.made("import-original", "simulate", "bust", "--views", 1, "--periods", "1280,160,20", "--shifts", 12)
    folder = study.work / "import-bmp"
    folder.mkdir(exist_ok=True)
    for frame in sorted((scan / "views/000").glob("*.png")):
        pattern, number = frame.stem.rsplit("-", 1)
        cv2.imwrite(str(folder / f"{pattern}_{int(number):02}.bmp"), cv2.imread(str(frame), cv2.IMREAD_UNCHANGED))
    begin = time.monotonic()
    answer = study.run_in_new_folder(
        "imported",
        "import",
        folder,
        "--names",
        "{pattern}_{frame:02}.bmp",
        "--patterns",
        scan / "scan.toml",
        "--rig",
        scan / "rig.toml",
    )
    seconds = time.monotonic() - begin
    same = all(
        (study.work / "imported/views/000" / frame.name).exists()
        and (cv2.imread(str(frame), -1) == cv2.imread(str(study.work / "imported/views/000" / frame.name), -1)).all()
        for frame in (scan / "views/000").glob("*.png")
    )
    decoded = study.run_in_new_folder("imported-stages", "decode", study.work / "imported")
    measured = decoded["pixels"]["measured"]
    study.add(
        '`frangia import FOLDER -o SCAN --names "{pattern}_{frame:02}.bmp" --patterns scan.toml --rig rig.toml` on the '
        f"BMP frames of a simulated scan, {answer['size_px'][0]} x {answer['size_px'][1]} pixels, then `frangia decode SCAN`.\n"
    )
    study.table("", "measured", "wanted")
    study.row("frames", answer["frames"], 36)
    study.row("seconds of the import", f"{seconds:.2f}", "at most 10")
    study.row("pixels equal to the original", "all" if same else "NOT ALL", "all")
    study.row("measured pixels of the decoded view", measured, "")
