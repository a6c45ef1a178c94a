"""A scan over GigE Vision with packets lost on purpose."""
PAGE = "figures-capture.md"
TITLE = "Over GigE Vision, 0.5 % of the packets lost"


def measure(study, case, seed):
    study.build("test_devices")
    return study.tested("test_devices", "GigeScan.*")


def report(text, results):
    figure = results["gige"][0]
    text.add(
        "`test_devices --gtest_filter='GigeScan.*'`: Aravis' fake camera on 127.0.0.1 shows the simulated interferometer, 256 x 256 pixels, 6 views.\n"
    )
    text.table("", "measured")
    text.row("frames, all complete", figure["frames"])
    text.row("frames captured again", figure["retries"])
    text.row("95 % of the mesh has an error within, mm", f"{figure['captured_mm']:.4f}")
    text.row("the same for a rendered scan", f"{figure['rendered_mm']:.4f}")
