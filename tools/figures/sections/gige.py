"""A scan over GigE Vision with packets lost on purpose."""
PAGE = "figures-capture.md"
TITLE = "Over GigE Vision, 0.5 % of the packets lost"


def measure(study):
    study.build("test_devices")
    figure = study.tested("test_devices", "GigeScan.*")
    study.add(
        "`test_devices --gtest_filter='GigeScan.*'`: Aravis' fake camera on 127.0.0.1 shows the simulated interferometer, 256 x 256 pixels, 6 views.\n"
    )
    study.table("", "measured")
    study.row("frames, all complete", figure["frames"])
    study.row("frames captured again", figure["retries"])
    study.row("95 % of the mesh has an error within, mm", f"{figure['captured_mm']:.4f}")
    study.row("the same for a rendered scan", f"{figure['rendered_mm']:.4f}")
