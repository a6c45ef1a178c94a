"""The sections of the figures, in the order in which they stand on their pages, and what each depends on."""
from inputs import Inputs

SCAN = "simulate reconstruct inspect"

SECTIONS = {
    "skull": Inputs("reconstruct", shared="skull", case_s=28),
    "balls": Inputs("reconstruct", shared="balls", case_s=2),
    "paper_block": Inputs("reconstruct", shared="block", case_s=3),
    "simulated": Inputs(SCAN, case_s=16),
    "sharp_edges": Inputs("simulate reconstruct", case_s=15),
    "misaligned_turntable": Inputs(SCAN, case_s=30),
    "large": Inputs("simulate reconstruct", files="benchmarks/large_rig.toml", case_s=180),
    "views": Inputs(SCAN, case_s=20),
    "poses": Inputs(
        modules="registration simulate",
        files="benchmarks/pose_study.cpp benchmarks/pose_reach.h benchmarks/study.h tests/support",
        case_s=9,
    ),
    "moved_parts": Inputs("reconstruct", case_s=20),
    "targets": Inputs("reconstruct", case_s=10),
    "edits": Inputs(SCAN + " edit", case_s=25),
    "decimation": Inputs("simulate reconstruct", modules="mesh", files="benchmarks/mesh_bench.cpp", case_s=200),
    "calibration": Inputs("simulate reconstruct calibrate", shared="skull skull-calibration", case_s=8),
    "calibration_doctor": Inputs("simulate calibrate", case_s=3),
    "calibration_angular": Inputs("simulate calibrate", case_s=50),
    "maker_path": Inputs(
        "calibrate scan reconstruct", files="examples/simulated-maker.toml examples/simulated-digital.toml", case_s=60
    ),
    "refine_rig": Inputs("simulate reconstruct", case_s=30),
    "captured_scan": Inputs(
        SCAN + " scan", files="examples/simulated-digital.toml examples/simulated-interferometer.toml", case_s=20
    ),
    "gige": Inputs(modules="acquisition simulate reconstruct", files="tests/devices tests/support", case_s=20),
    "step_control": Inputs(modules="acquisition simulate", files="tests/acquisition tests/support", case_s=10),
    "polished_blade": Inputs(SCAN + " scan", files="examples/simulated-digital.toml", case_s=12),
    "capture_overhead": Inputs("scan", files="examples/simulated-digital.toml", case_s=6),
    "import_frames": Inputs("simulate import decode", case_s=8),
    "batch": Inputs("simulate reconstruct batch", case_s=350),
    "files": Inputs("edit", files="tools/check_files.py tools/measured_files.py", case_s=200),
    "harmonics": Inputs(SCAN + " decode response", case_s=6),
    "indirect_light": Inputs(SCAN + " plan", case_s=40),
    "sequence_faults": Inputs("simulate decode", case_s=1),
    "explanations": Inputs("decode", case_s=1),
    "camera_blur": Inputs("reconstruct", case_s=20),
    "two_cameras": Inputs(SCAN, case_s=15),
    "app": Inputs("serve", files="web/src tests/app benchmarks/service_bench.cpp", case_s=300),
    "features": Inputs(SCAN, shared="balls", case_s=7),
    "drawn_rig": Inputs(SCAN + " calibrate", case_s=12),
    "alignment": Inputs(SCAN, case_s=60),
    "deviation": Inputs("inspect", case_s=25),
    "blade": Inputs(SCAN, case_s=7),
    "verdict": Inputs(SCAN, case_s=1),
    "plan_scan": Inputs(SCAN + " plan", case_s=40),
    "cad": Inputs("inspect", files="tests/cad", case_s=15),
    "edit_pictures": Inputs("simulate reconstruct edit picture", files="tools/edit_pictures.py", case_s=60),
    "surface_pictures": Inputs(SCAN + " decode", files="tools/surface_pictures.py", case_s=90),
    "phase_plots": Inputs("simulate decode algorithms", files="tools/plot_phase.py tools/plot_fusion.py", case_s=30),
    "sensitivity": Inputs(
        "simulate", modules="fusion reconstruct", files="benchmarks/fusion_sensitivity.cpp", case_s=180
    ),
}
