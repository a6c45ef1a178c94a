"""Measures the figures of the documentation: python3 tools/figures PROGRAM [NAME...], or `./run figures [NAME...]`.

Each section is a file of `sections` and one part of a page in docs; a section that is not named, or that needs something
missing on this machine, stays as it is. Without names all are measured; `list` prints them. An interrupted section goes
on with the scans that it has made.
"""
import importlib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "sections"), str(HERE.parent)]

from page import write_section  # noqa: E402
from study import ROOT, NotMeasured, Study  # noqa: E402

# In the order in which they stand on their pages.
SECTIONS = [
    "skull",
    "balls",
    "paper_block",
    "simulated",
    "sharp_edges",
    "misaligned_turntable",
    "large",
    "views",
    "edits",
    "decimation",
    "calibration",
    "calibration_doctor",
    "calibration_angular",
    "maker_path",
    "refine_rig",
    "captured_scan",
    "gige",
    "step_control",
    "polished_blade",
    "capture_overhead",
    "import_frames",
    "batch",
    "file_readers",
    "harmonics",
    "indirect_light",
    "sequence_faults",
    "two_cameras",
    "app",
    "features",
    "alignment",
    "deviation",
    "blade",
    "cad",
    "edit_pictures",
    "surface_pictures",
    "phase_plots",
    "sensitivity",
]


def measure(program, name):
    section = importlib.import_module(name)
    print(f"\n==> figures {name}: {section.__doc__.splitlines()[0]}", flush=True)
    study = Study(program)
    try:
        section.measure(study)
    except NotMeasured as reason:
        print(f"figures: {name} is not measured: {reason}", flush=True)
        return
    title = getattr(section, "TITLE", None)
    if title:  # the others write their pictures and tables themselves
        page = ROOT / "docs" / getattr(section, "PAGE", "figures.md")
        write_section(page, SECTIONS, name, f"## {title}\n\n" + "\n".join(study.lines))


def main(program, names):
    for name in names or SECTIONS:
        if name not in SECTIONS:
            sys.exit(f"figures: there is no section '{name}'; the sections are {', '.join(SECTIONS)}")
    for name in names or SECTIONS:
        measure(program, name)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[2:] == ["list"]:
        print("\n".join(SECTIONS))
    else:
        main(sys.argv[1], sys.argv[2:])
