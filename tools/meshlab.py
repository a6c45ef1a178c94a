"""One filter of MeshLab's, as a program that we did not write: for figures and benchmarks."""
import pathlib
import shutil
import subprocess
import tempfile


def is_missing():
    """The programs that are needed and absent. Debian: meshlab, xvfb."""
    return [name for name in ("meshlabserver", "xvfb-run") if not shutil.which(name)]


def apply(name, parameters, meshes):
    """What MeshLab says while its filter `name` works on the meshes, laid over each other.

    parameters   rows of a type, a name and a value; MeshLab takes the default of none: list all
    """
    rows = "".join(
        f'<Param type="{kind}" name="{key}" value="{value}" min="0" max="100"/>' for kind, key, value in parameters
    )
    with tempfile.TemporaryDirectory() as work:
        script = pathlib.Path(work, "filter.mlx")
        script.write_text(f'<!DOCTYPE FilterScript><FilterScript><filter name="{name}">{rows}</filter></FilterScript>')
        command = [
            "xvfb-run",
            "-a",
            "meshlabserver",
            "-i",
            *map(lambda path: str(pathlib.Path(path).resolve()), meshes),
            "-s",
            str(script),
            "-o",
            "out.ply",
        ]
        answer = subprocess.run(command, cwd=work, check=False, capture_output=True, text=True)
    return answer.stdout + answer.stderr
