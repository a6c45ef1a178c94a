"""Phase shifts of a piezo with a wrong gain, with and without step control."""
PAGE = "figures-capture.md"
TITLE = "A piezo with a gain error of 5 % and a phase-shift jitter of 1 degree"


def measure(study):
    study.build("test_acquisition")
    figure = study.tested("test_acquisition", "StepControl.PiezoFive*")
    study.add(
        "`test_acquisition --gtest_filter='StepControl.PiezoFive*'`: RMS phase error without its mean, divided by the noise limit; 8 frames per set.\n"
    )
    study.table("", "error over the noise limit", "wanted")
    study.row("without step control, nominal steps", f"{figure['first']:.2f}", "")
    study.row(
        "with step control, the worst of three sets, steps estimated (AIA)",
        f"{figure['corrected']:.2f}",
        "at most 1.20",
    )
    study.row("the same, nominal steps", f"{figure['corrected_plain']:.2f}", "")
