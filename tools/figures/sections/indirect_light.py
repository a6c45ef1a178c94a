"""Indirect light: a part that lights its own concave sides, with coarse, mixed and fine sequences of fringes."""
TITLE = "Indirect light"

ALBEDO = 0.8
VIEWS = 6
PARTS = ("groove", "bracket")
SEQUENCES = {
    "1, 8, 64 fringes": (1, 8, 64),
    "1, 4, 16 fringes": (1, 4, 16),
    "53, 58, 64 fringes": (53, 58, 64),
    "16 fringes and Gray code": None,
    "proposed": None,
}
CASES = {f"{part}: {sequence}": 1 for part in PARTS for sequence in SEQUENCES}
MOST_OVER_SIGMA = 1.3
MOST_OVER_DIRECT = 1.5  # RMS of the proposed sequence over that without the bounce


def periods(values):
    return ",".join(f"{value:.6g}" for value in values)


def sequence_options(sequence, plan):
    """The options of `frangia simulate` for a sequence; `plan` is what `frangia plan` proposes."""
    if sequence == "proposed":
        return "--periods", periods(plan["period_px"])
    if SEQUENCES[sequence] is None:
        return "--sequence", "gray", "--fringes", 16
    width = plan["period_px"][0] * plan["fringes"][0]
    return "--periods", periods(width / n for n in SEQUENCES[sequence])


def measure(study, case, seed):
    part, sequence = case.split(": ")
    plan = study.run("plan", "--rig", study.half_rig, "--indirect", "--sigma", 0.05)
    found = {"plan": plan}
    bounce = ("--bounces", 1, "--albedo", ALBEDO)
    for name, options, reconstruction in (
        ("direct", (), ()),
        ("bounced", bounce, ()),
        ("ignored", bounce, ("--ignore-indirect-light",)),
    ):
        scan = study.simulated(
            part, "--rig", study.half_rig, "--views", VIEWS, *sequence_options(sequence, plan), *options
        )
        mesh, answer = study.reconstructed(scan, *reconstruction)
        comparison = study.run("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan)
        found[name] = {
            **{key: comparison[key] for key in ("rms_mm", "p99_mm", "sigma_ratio")},
            "light": answer.get("indirect_light"),
        }
    return found


def report(text, results):
    failures, plan = [], next(iter(results.values()))[0]["plan"]
    fringes = ", ".join(f"{count:g}" for count in plan["fringes"])
    text.add(
        f"Bracket and groove of 90°, {VIEWS} views, digital rig with half the pixels of its camera on a side, rendered without and with one diffuse bounce (`--bounces 1 --albedo {ALBEDO}`). The proposed sequence is that of `frangia plan --indirect --sigma 0.05`: {fringes} fringes, probability of a wrong order {plan['wrong_order']:.0e}. Errors of the vertices in mm; `frangia reconstruct` finds the reflectance and corrects what the surface predicts; the ignored error is that of `--ignore-indirect-light`. Wanted: error over sigma at most {MOST_OVER_SIGMA}; RMS of the proposed sequence at most {MOST_OVER_DIRECT} times that without the bounce.\n"
    )
    text.table(
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
    for case, (one,) in results.items():
        part, sequence = case.split(": ")
        direct, bounced, ignored = one["direct"], one["bounced"], one["ignored"]
        ratio, over, light = bounced["rms_mm"] / direct["rms_mm"], bounced["sigma_ratio"], bounced["light"]
        found = f"{light['reflectance']:.2f}" if light else "none"
        text.row(
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
        if direct["light"]:
            failures.append(f"indirect light where there is none, {part}, {sequence}")
        if sequence == "proposed" and ratio > MOST_OVER_DIRECT:
            failures.append(f"the proposed sequence on {part}")
    if failures:
        text.add("\nNot reached: " + ", ".join(failures) + ".")
