"""Twenty views of 5 Mpx: time of each stage and memory."""
from study import ROOT

TITLE = "Twenty views of 5 Mpx with 12 frames each"


def measure(study):
    scan = study.made("large", "simulate", "bust", "--rig", ROOT / "benchmarks" / "large_rig.toml", "--views", 20)
    answer = study.run("reconstruct", scan, "-o", study.work / "large.ply")
    study.add(
        "The bust, a digital projector, three periods of four frames: `frangia reconstruct large -o large.ply`.\n"
    )
    study.table("stage", "s")
    for stage, time in answer["seconds"].items():
        study.row(stage, f"{time:.2f}")
    study.add(
        f"\n{answer['points']} points, {answer['triangles']} triangles, peak {answer['peak_memory_mb']:.0f} MB (wanted 3000)."
    )
