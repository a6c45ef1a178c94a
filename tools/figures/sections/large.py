"""Twenty views of 5 Mpx: time of each stage and memory."""
from study import ROOT

TITLE = "Twenty views of 5 Mpx with 12 frames each"


def measure(study, case, seed):
    scan = study.simulated("bust", "--rig", ROOT / "benchmarks" / "large_rig.toml", "--views", 20)
    return study.reconstructed(scan)[1]


def report(text, results):
    answer = results["large"][0]
    text.add("The bust, a digital projector, three periods of four frames: `frangia reconstruct large -o large.ply`.\n")
    text.table("stage", "s")
    for stage, time in answer["seconds"].items():
        text.row(stage, f"{time:.2f}")
    text.add(
        f"\n{answer['points']} points, {answer['triangles']} triangles, peak {answer['peak_memory_mb']:.0f} MB (wanted 3000)."
    )
