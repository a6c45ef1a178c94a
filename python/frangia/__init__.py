"""Fringe-projection scanning: from frames to phase, points and one measured surface.

    import frangia

    scan = frangia.read_scan("bust-scan")
    view = frangia.decode(scan, 0)              # view.phase.phase, view.phase.sigma, view.order, ...
    mesh = frangia.reconstruct(scan).mesh       # mesh.vertices, mesh.triangles, mesh.sigma_mm, ...

Lengths are in millimetres, phases in radians, images height x width. Missing values are NaN. Arrays
are views of the library's memory where that is possible; copy an array before you change it.

Each stage works on plain arrays, without a scan folder:

    shifts_rad = [0, pi / 2, pi, 3 * pi / 2]                # frames: 4 x height x width, uint8 or uint16
    wrapped = frangia.wrap_phase(frames, shifts_rad)        # wrapped.phase, .sigma, .modulation
    relative = frangia.unwrap_spatial(wrapped, "reliability-sorted")

Rigs are calibrated and captured with:

    calibration = frangia.calibrate(frangia.read_scan("poses", rig="start-values"))
    frangia.write_rig("rig.toml", calibration.rig)
    frangia.capture("rig.toml", "part-scan", views=8)

A stage of `decode` and `reconstruct` can be a function of yours:

    wrap(stack, algorithm, noise) -> phase, sigma, modulation, mean      or a WrappedPhase
    unwrap_spatially(map)         -> phase, region                       or a RelativePhase
    unwrap(maps)                  -> phase, sigma                        or an AbsolutePhase

Notes and warnings go to the logger "frangia". Long work stops at Ctrl-C. `progress` is a function
of the share that is done and the name of the stage, for example `frangia.progress_bar()`.

Errors are `frangia.Error`: InputError (also a ValueError), FileError (OSError), DeviceError
(RuntimeError) and NumericError (ArithmeticError). ArgumentError (InputError and TypeError) is a call
with arguments of other types. Their text says what to do.
"""

from typing import TYPE_CHECKING as _TYPE_CHECKING

try:
    import numpy as _numpy  # noqa: F401
    from . import _frangia
except ImportError as _error:
    from ._interpreter import explained as _explained

    raise _explained(_error) from None
from ._frangia import *  # noqa: F401,F403
from ._frangia import __version__  # noqa: F401
from ._arguments import ArgumentError, checked_members as _checked_members  # noqa: F401
from ._convert import from_meshio, from_open3d, from_trimesh, to_meshio, to_open3d, to_trimesh  # noqa: F401
from ._progress import progress_bar  # noqa: F401
from . import _notebook  # noqa: F401  adds Mesh.show

if _TYPE_CHECKING:
    from ._acquisition import (  # noqa: F401
        Calibration,
        CalibrationView,
        CaptureReport,
        TargetSighting,
        calibrate,
        capture,
        find_targets,
    )

globals().update(_checked_members(_frangia))

_LATER = (
    "Calibration",
    "CalibrationView",
    "CaptureReport",
    "TargetSighting",
    "calibrate",
    "capture",
    "find_targets",
)


def __getattr__(name: str) -> object:
    """Loads calibration and capture, with OpenCV and Ceres, when they are used."""
    if name not in _LATER:
        raise AttributeError(f"module 'frangia' has no attribute '{name}'")
    try:
        from . import _acquisition
    except ImportError as error:
        raise ImportError(f"frangia.{name} is not available: {error}") from error
    members = {**vars(_acquisition), **_checked_members(_acquisition)}
    globals().update({later: members[later] for later in _LATER})
    return globals()[name]


def __dir__() -> list[str]:
    return sorted([*globals(), *_LATER])
