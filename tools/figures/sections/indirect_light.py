"""Indirect light: a part that lights its own concave sides, with coarse, mixed and fine sequences of fringes."""
from half_rig import half_rig

TITLE = "Indirect light"

ALBEDO = 0.8
VIEWS = 6
MOST_OVER_SIGMA = 1.3
MOST_OVER_DIRECT = 1.5  # RMS of the proposed sequence over that without the bounce


def periods(values):
    return ",".join(f"{value:.6g}" for value in values)


class Scans:
    """Scans of a part, with one bounce or none."""

    def __init__(self, study):
        self.study, self.rig = study, half_rig(study.program, study.work)
        self.plan = study.run("plan", "--rig", self.rig, "--indirect", "--sigma", 0.05)
        width = self.plan["period_px"][0] * self.plan["fringes"][0]
        self.sequences = {
            "1, 8, 64 fringes": ("--periods", periods(width / n for n in (1, 8, 64))),
            "1, 4, 16 fringes": ("--periods", periods(width / n for n in (1, 4, 16))),
            "53, 58, 64 fringes": ("--periods", periods(width / n for n in (53, 58, 64))),
            "16 fringes and Gray code": ("--sequence", "gray", "--fringes", 16),
            "proposed": ("--periods", periods(self.plan["period_px"])),
        }

    def mesh(self, part, sequence, *options, ignore=False):
        """The comparison with the true surface, and what the program says about indirect light."""
        name = f"{part}-{sequence}-{'-'.join(map(str, options))}".replace(" ", "").replace(",", "_")
        scan = self.study.made(
            name, "simulate", part, "--rig", self.rig, "--views", VIEWS, *self.sequences[sequence], *options
        )
        mesh = self.study.work / "indirect.ply"
        found = self.study.run("reconstruct", scan, "-o", mesh, *(("--ignore-indirect-light",) if ignore else ()))
        return self.study.run("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan), found.get(
            "indirect_light"
        )


def measure(study):
    scans, failures = Scans(study), []
    fringes = ", ".join(f"{count:g}" for count in scans.plan["fringes"])
    study.add(
        f"Bracket and groove of 90°, {VIEWS} views, digital rig with half the pixels of its camera on a side, rendered without and with one diffuse bounce (`--bounces 1 --albedo {ALBEDO}`). The proposed sequence is that of `frangia plan --indirect --sigma 0.05`: {fringes} fringes, probability of a wrong order {scans.plan['wrong_order']:.0e}. Errors of the vertices in mm; `frangia reconstruct` finds the reflectance and corrects what the surface predicts; the ignored error is that of `--ignore-indirect-light`. Wanted: error over sigma at most {MOST_OVER_SIGMA}; RMS of the proposed sequence at most {MOST_OVER_DIRECT} times that without the bounce.\n"
    )
    study.table(
        "part",
        "sequence",
        "RMS direct",
        "ignored",
        "RMS with bounce",
        "ratio",
        "99 %",
        "error over sigma",
        "reflectance found",
    )
    for part in ("groove", "bracket"):
        for sequence in scans.sequences:
            direct, none = scans.mesh(part, sequence)
            bounced, light = scans.mesh(part, sequence, "--bounces", 1, "--albedo", ALBEDO)
            ignored = scans.mesh(part, sequence, "--bounces", 1, "--albedo", ALBEDO, ignore=True)[0]
            ratio, over = bounced["rms_mm"] / direct["rms_mm"], bounced["sigma_ratio"]
            found = f"{light['reflectance']:.2f}" if light else "none"
            study.row(
                part,
                sequence,
                f"{direct['rms_mm']:.4f}",
                f"{ignored['rms_mm']:.4f}",
                f"{bounced['rms_mm']:.4f}",
                f"{ratio:.2f}",
                f"{bounced['p99_mm']:.4f}",
                f"{over:.2f} ({direct['sigma_ratio']:.2f} direct)",
                found,
            )
            if over > MOST_OVER_SIGMA:
                failures.append(f"error over sigma of {part}, {sequence}")
            if none:
                failures.append(f"indirect light where there is none, {part}, {sequence}")
            if sequence == "proposed" and ratio > MOST_OVER_DIRECT:
                failures.append(f"the proposed sequence on {part}")
    if failures:
        study.add("\nNot reached: " + ", ".join(failures) + ".")
