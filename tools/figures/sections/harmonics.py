"""Harmonics of a projector, flicker and false steps: errors of the phase, and its stated uncertainty."""
import numpy
from skimage import io

from half_rig import half_rig

TITLE = "Harmonics and flicker"

GAMMA = 1.8
STEPS = (3, 4, 5, 6)
SEEDS = (1, 2, 3)
LEAST, MOST = 0.7, 1.5  # of error over sigma
MOST_CORRECTED = 1.5  # times the error of a linear projector
MOST_FLICKER = 1.3  # times the error without flicker


class Phases:
    """Absolute phases of one view of the bust, decoded with options, against those without noise and faults."""

    def __init__(self, study):
        self.study, self.rig = study, half_rig(study.program, study.work)
        self.truth = self.decoded(self.scan("bust-exact", "--shifts", 12, "--no-noise", "--bits", 16))[0]

    def scan(self, name, *options):
        return self.study.made(name, "simulate", "bust", "--rig", self.rig, "--views", 1, *options)

    def decoded(self, scan, *options):
        folder = self.study.work / "harmonics-decoded"
        self.study.run("decode", scan, "--view", 0, "-o", folder, *options)
        return tuple(io.imread(folder / f"{name}.tiff").astype(float) for name in ("absolute", "absolute-sigma"))

    def errors(self, scan, *options):
        """RMS error in rad, and RMS of error over sigma."""
        phase, sigma = self.decoded(scan, *options)
        error = phase - self.truth
        both = numpy.isfinite(error) & numpy.isfinite(sigma)
        return float(numpy.sqrt(numpy.mean(error[both] ** 2))), float(
            numpy.sqrt(numpy.mean((error[both] / sigma[both]) ** 2))
        )


def mesh_ratio(study, scan, *options):
    """RMS of error over sigma of the vertices of a mesh."""
    mesh = study.work / "harmonics.ply"
    study.run("reconstruct", scan, "-o", mesh, *options)
    return study.run("inspect", mesh, "--reference", scan / "truth.ply", "--scan", scan)["sigma_ratio"]


def measure(study):
    phases, failures = Phases(study), []

    def wanted(condition, what):
        if not condition:
            failures.append(what)

    study.add(
        f"The bust, one view, digital rig with half its pixels on a side; phases against those of an exact scan. `frangia simulate bust --display-gamma {GAMMA} --shifts N`, decoded as it is, with `--undo-response auto`, and with the rig.toml that `frangia response` writes. Wanted: error over sigma {LEAST} to {MOST}; corrected at most {MOST_CORRECTED} times the error of a linear projector.\n"
    )
    study.table(
        "steps",
        "linear, rad RMS",
        f"gamma {GAMMA}, rad RMS",
        "error over sigma",
        "auto, over linear",
        "error over sigma",
        "response, over linear",
    )
    for steps in STEPS:
        linear = phases.errors(phases.scan(f"bust-linear-{steps}", "--shifts", steps))[0]
        scan = phases.scan(f"bust-gamma-{steps}", "--shifts", steps, "--display-gamma", GAMMA)
        response = study.work / "response.toml"
        study.run("response", scan, "-o", response)
        plain, auto = phases.errors(scan), phases.errors(scan, "--undo-response", "auto")
        filed = phases.errors(scan, "--undo-response", response)
        study.row(
            steps,
            f"{linear:.4f}",
            f"{plain[0]:.4f}",
            f"{plain[1]:.2f}",
            f"{auto[0] / linear:.2f}",
            f"{auto[1]:.2f}",
            f"{filed[0] / linear:.2f}",
        )
        wanted(LEAST < plain[1] < MOST and LEAST < auto[1] < MOST, f"error over sigma with {steps} steps")
        wanted(max(auto[0], filed[0]) < MOST_CORRECTED * linear, f"the correction with {steps} steps")

    study.add(
        "\nThe same with the light of the projector blurred (`--projector-blur 3`), which weakens the harmonics of fine fringes, three steps:\n"
    )
    blurred = ("--shifts", 3, "--projector-blur", 3, "--periods", "1280,160,20")
    linear = phases.errors(phases.scan("bust-blurred", *blurred))[0]
    scan = phases.scan("bust-blurred-gamma", *blurred, "--display-gamma", GAMMA)
    response = study.work / "response.toml"
    study.run("response", scan, "-o", response)
    pooled = study.work / "pooled.toml"
    pooled.write_text(response.read_text().split("[[projector.response.waveform]]")[0])
    study.table("correction", "rad RMS", "over linear")
    for name, options in (
        ("none", ()),
        ("one response for all periods", ("--undo-response", pooled)),
        ("one waveform per period", ("--undo-response", response)),
        ("auto", ("--undo-response", "auto")),
    ):
        error = phases.errors(scan, *options)[0]
        study.row(name, f"{error:.4f}", f"{error / linear:.2f}")
    wanted(error < MOST_CORRECTED * linear, "the correction of blurred fringes")

    study.add("\nFlicker of 2 % RMS per frame (`--flicker 0.02`), mean of three scans:\n")
    study.table("steps", "none, rad RMS", "flicker, over none", "error over sigma")
    for steps in (3, 4, 5, 6, 12):
        none = phases.errors(phases.scan(f"bust-steps-{steps}", "--shifts", steps))[0]
        found = [
            phases.errors(
                phases.scan(f"bust-flicker-{steps}-{seed}", "--shifts", steps, "--flicker", 0.02, "--seed", seed)
            )
            for seed in SEEDS
        ]
        ratio, over_sigma = (float(numpy.sqrt(numpy.mean([one[i] ** 2 for one in found]))) for i in (0, 1))
        study.row(steps, f"{none:.4f}", f"{ratio / none:.2f}", f"{over_sigma:.2f}")
        if steps == 12:
            wanted(ratio < MOST_FLICKER * none, "flicker of 12 steps")

    study.add("\nSteps estimated under a second harmonic of 25 % (gamma 2), 12 steps:\n")
    scan = phases.scan("bust-steps-gamma", "--shifts", 12, "--display-gamma", 2.0)
    nominal = phases.errors(scan)[0]
    estimated = phases.errors(scan, "--algorithm", "global-carre")[0]
    study.add(f"nominal steps {nominal:.4f} rad RMS, estimated steps {estimated:.4f} rad RMS.")
    wanted(estimated < 1.05 * nominal, "estimated steps")

    study.add("\nMeshes of four views, gamma 1.8, not corrected: error over sigma of the vertices.\n")
    study.table("steps", "error over sigma")
    for steps in STEPS:
        scan = study.made(
            f"bust-mesh-{steps}",
            "simulate",
            "bust",
            "--rig",
            phases.rig,
            "--views",
            4,
            "--shifts",
            steps,
            "--display-gamma",
            GAMMA,
        )
        ratio = mesh_ratio(study, scan)
        study.row(steps, f"{ratio:.2f}")
    if failures:
        raise SystemExit("figures: not as wanted: " + ", ".join(failures))
