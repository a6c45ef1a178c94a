"""Phase shifts of a piezo with a wrong gain, with and without step control."""
PAGE = "figures-capture.md"
TITLE = "A piezo with a gain error of 5 % and a phase-shift jitter of 1 degree"


def measure(study, case, seed):
    study.build("test_acquisition")
    return study.tested("test_acquisition", "StepControl.PiezoFive*")


def report(text, results):
    figure = results["step_control"][0]
    text.add(
        "`test_acquisition --gtest_filter='StepControl.PiezoFive*'`: RMS phase error without its mean, divided by the noise limit; 8 frames per set.\n"
    )
    text.table("", "error over the noise limit", "wanted")
    text.row("without step control, nominal steps", f"{figure['first']:.2f}", "")
    text.row(
        "with step control, the worst of three sets, steps estimated (AIA)",
        f"{figure['corrected']:.2f}",
        "at most 1.20",
    )
    text.row("the same, nominal steps", f"{figure['corrected_plain']:.2f}", "")
