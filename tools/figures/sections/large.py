"""Twenty views of 5 Mpx: time of each stage and memory."""
TITLE = "Twenty views of 5 Mpx with 12 frames each"

RIG_5MPX = """format = "frangia-rig"
version = 1
[camera]
size_px = [2560, 2048]
focal_px = [4800.0, 4800.0]
principal_point_px = [1308.7, 1007.1]
distortion = [-0.09, 0.05, 4e-4, -3e-4, 0.0]
white_level = 255
[projector]
model = "pinhole"
position_mm = [-180.0, -20.0, 30.0]
rotation = [[0.931242779706, 0, -0.364399348581], [-0.0147420196862, 0.999181334288, -0.0376740503092], [0.364101027328, 0.0404556697031, 0.930480403172]]
size_px = [1280, 800]
focal_px = [1900.0, 1900.0]
principal_point_px = [639.5, 399.5]
[turntable]
point_mm = [3.5, 50.0, 516.0]
axis = [-0.0094, -0.8829, -0.4694]
"""


def measure(study):
    rig = study.work / "large-rig.toml"
    rig.write_text(RIG_5MPX)
    scan = study.made("large", "simulate", "bust", "--rig", rig, "--views", 20)
    answer = study.run("reconstruct", scan, "-o", study.work / "large.ply")
    study.add("The bust, a digital projector, three periods of four frames: `frangia reconstruct large -o large.ply`.\n")
    study.table("stage", "s")
    for stage, time in answer["seconds"].items():
        study.row(stage, f"{time:.2f}")
    study.add(f"\n{answer['points']} points, {answer['triangles']} triangles, peak {answer['peak_memory_mb']:.0f} MB (wanted 3000).")
