"""The uncertainty that a planned scan predicts, and the one that the scan reaches, of four parts and two rigs."""
from study import NotAsWanted

TITLE = "The predicted uncertainty of a scan"
PAGE = "inspection.md"

RIGS = ("digital, half the pixels", "angular")
PARTS = ("shaft", "bracket", "bust", "blade")
CASES = {f"{part}, {rig}": 1 for rig in RIGS for part in PARTS}
LEAST, MOST = 0.7, 1.4  # predicted over achieved
TOLERANCE_MM = 0.2
VIEWS = 8


def measure(study, case, seed):
    part, rig = case.split(", ", 1)
    rig = study.half_rig if rig.startswith("digital") else rig
    scan = study.simulated(part, "--rig", rig, "--samples", 4, "--views", VIEWS, "--seed", seed)
    mesh, truth = study.reconstructed(scan)[0], scan / "truth.ply"
    plan = study.work / "inspection.toml"
    plan.write_text(
        f'format = "frangia-inspection"\nversion = 1\ntolerance_mm = [{-TOLERANCE_MM}, {TOLERANCE_MM}]\n'
        '[[excluded]]\nname = "base"\nmin_mm = [-1000, -1000, -1]\nmax_mm = [1000, 1000, 0.01]\n'
    )
    found = study.run("inspect", mesh, "--reference", truth, "--plan", plan, "--align", "best-fit", "--start", 1)
    wanted = study.run(
        "plan",
        "scan",
        truth,
        "--rig",
        scan / "rig.toml",
        "--plan",
        plan,
        "--views",
        VIEWS,
        "--no-search",
        "--seed",
        seed + 100,
    )
    achieved, predicted = found["deviation"], wanted["surface"]
    return {
        "achieved_mm": 1.96 * achieved["median_u_mm"],
        "predicted_mm": predicted["median_u95_mm"],
        "covered": achieved["coverage"],
        "predicted_covered": predicted["decidable_share"],
    }


def report(text, results):
    text.add(
        f"`frangia plan scan PART --rig RIG --views {VIEWS} --no-search` before, and `frangia simulate`, `reconstruct`, `inspect` after: one "
        f"setup of {VIEWS} stations, the base excluded. Median U95 of a vertex with the pose on the reference; the decided share of the area is "
        f"that for a tolerance of ± {TOLERANCE_MM} mm.\n"
    )
    text.table(
        "part",
        "rig",
        "predicted U95, mm",
        "achieved U95, mm",
        "predicted over achieved",
        "predicted share",
        "achieved share",
    )
    wrong = []
    for rig in RIGS:
        for part in PARTS:
            for one in results[f"{part}, {rig}"]:
                ratio = one["predicted_mm"] / one["achieved_mm"]
                text.row(
                    part,
                    rig,
                    f"{one['predicted_mm']:.4f}",
                    f"{one['achieved_mm']:.4f}",
                    f"{ratio:.2f}",
                    f"{100 * one['predicted_covered']:.1f} %",
                    f"{100 * one['covered']:.1f} %",
                )
                if not LEAST <= ratio <= MOST:
                    wrong.append(f"{part}, {rig}: predicted over achieved is {ratio:.2f}")
    text.add(f"\nWanted: predicted over achieved from {LEAST} to {MOST}.")
    if wrong:
        raise NotAsWanted("; ".join(wrong))
