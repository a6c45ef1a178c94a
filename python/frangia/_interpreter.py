"""Why the extension module cannot be imported, in one sentence; in the syntax of old Pythons, too."""

import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).parent


def explained(error: ImportError, folder: pathlib.Path = FOLDER) -> ImportError:
    """The error to raise in place of one of `import frangia._frangia` or `import numpy`."""
    this = f"{sys.executable} (Python {sys.version_info.major}.{sys.version_info.minor})"
    names = [re.search(r"cpython-3(\d+)", path.name) for path in folder.glob("_frangia.*.so")]
    built = {found.group(1) for found in names if found}
    if not built:
        return ImportError(f"{folder} holds no compiled module; build it: ./run build")
    if str(sys.version_info.minor) not in built:
        versions = " and ".join(f"3.{minor}" for minor in sorted(built, key=int))
        return ImportError(
            f"frangia was compiled for Python {versions}, and this is {this}; use Debian's interpreter: /usr/bin/python3"
        )
    if error.name == "numpy":
        return ImportError(
            f"frangia needs NumPy, which {this} does not have; use Debian's interpreter, /usr/bin/python3, with its "
            "package python3-numpy"
        )
    return ImportError(f"frangia cannot be loaded by {this}: {error}")
