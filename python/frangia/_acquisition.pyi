"""Types of the extension module; python/make_stubs.py writes this file."""

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, ClassVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._frangia import Rig, Scan

class Calibration:
    """A calibrated rig and how it was found."""
    @property
    def camera_rms_px(self) -> float:
        """Reprojection error of the camera, px."""
        ...
    @property
    def covariance(self) -> NDArray[np.float64]:
        """Of the parameters, P x P, in the squares of their units."""
        ...
    @property
    def distance_mm(self) -> float:
        """Mean distance of the board, mm."""
        ...
    @property
    def estimated(self) -> list[str]:
        """Terms of the model that the data supports."""
        ...
    @property
    def grade(self) -> str:
        """excellent, good, usable or poor."""
        ...
    @property
    def held(self) -> list[str]:
        """Terms that it does not support."""
        ...
    @property
    def left_out(self) -> list[str]:
        """Folders of views with a fault."""
        ...
    @property
    def parameters(self) -> list[str]:
        """Names of the rows of `covariance`, such as "camera.focal_px"."""
        ...
    @property
    def point_sigma_mm(self) -> float:
        """Standard uncertainty of a point by the calibration, mm."""
        ...
    @property
    def projector_rms_px(self) -> float:
        """That of the projector, projector px."""
        ...
    @property
    def rig(self) -> Rig:
        """Calibrated rig; `write_rig` writes it."""
        ...
    @property
    def spread_mm(self) -> float:
        """The same from the differences between the poses, mm."""
        ...
    @property
    def views(self) -> list[CalibrationView]:
        """The poses that were used."""
        ...
    @property
    def without_board(self) -> list[str]:
        """Folders of views without the board."""
        ...

class CalibrationView:
    """One pose of the board."""
    @property
    def camera_px(self) -> NDArray[np.float64]:
        """Points in the image, N x 2, px."""
        ...
    @property
    def camera_residuals_px(self) -> NDArray[np.float64]:
        """Observed minus predicted, N x 2, px."""
        ...
    @property
    def camera_rms_px(self) -> float:
        """Of the distances, px."""
        ...
    @property
    def indices(self) -> NDArray[np.int32]:
        """Number of each point on the board, row by row."""
        ...
    @property
    def leave_one_out_mm(self) -> float:
        """How far points move without this pose, root mean square, mm."""
        ...
    @property
    def name(self) -> str:
        """Folder of the view."""
        ...
    @property
    def projector_px(self) -> NDArray[np.float64]:
        """Projector pixels that light them, N x 2; NaN: a phase is missing."""
        ...
    @property
    def projector_residuals_px(self) -> NDArray[np.float64]:
        """Observed minus predicted, N x 2, projector px; NaN: a phase is missing."""
        ...
    @property
    def projector_rms_px(self) -> float:
        """Projector px."""
        ...

class CaptureReport:
    """Frames, retries and times of a capture."""
    @property
    def captured(self) -> int:
        """Frames stored in this session."""
        ...
    @property
    def device_s(self) -> float:
        """Time in calls to devices, s."""
        ...
    @property
    def disk_s(self) -> float:
        """Time waiting for the disk, s."""
        ...
    @property
    def exposures_ms(self) -> list[float]:
        """Of the fringes."""
        ...
    @property
    def frame_retries(self) -> int:
        """Repeated exposures."""
        ...
    @property
    def resumed(self) -> int:
        """Frames stored by earlier sessions."""
        ...
    @property
    def set_retakes(self) -> int:
        """Sets repeated because of motion."""
        ...
    @property
    def skipped(self) -> list[str]:
        """Views that could not be captured, and why."""
        ...

class TargetSighting:
    """A target as one view measured it."""
    @property
    def blur_px(self) -> float:
        """Blur of its edge, sigma, px."""
        ...
    @property
    def center_mm(self) -> NDArray[np.float64]:
        """Its centre, rig frame, mm."""
        ...
    @property
    def center_px(self) -> NDArray[np.float64]:
        """Image of its centre (x, y), px."""
        ...
    @property
    def code(self) -> int:
        """Of a coded target; -1: it has none."""
        ...
    @property
    def covariance_mm2(self) -> NDArray[np.float64]:
        """Of `center_mm`, 3 x 3, mm^2."""
        ...
    @property
    def normal(self) -> NDArray[np.float64]:
        """Of its plane, unit, towards the camera."""
        ...
    @property
    def size_ratio(self) -> float:
        """Measured over stated diameter or side."""
        ...

def calibrate(scan: Scan, *, flat_board: bool = False, progress: Callable[[float, str], object] | None = None) -> Calibration:
    """Calibrates camera and projector from a scan whose views are poses of a board, as `frangia calibrate rig`. Read it with read_scan(folder, rig="start-values"). flat_board: the board is exactly flat and square."""
    ...

def capture(rig_file: str | os.PathLike[str], folder: str | os.PathLike[str], *, views: int = 8, shifts: int = 4, periods_px: Iterable[float] = [], fringes_per_degree: float = 1.0, exposure_ms: float | str = 10.0, table_at_deg: float | None = None, progress: Callable[[float, str], object] | None = None) -> CaptureReport:
    """Captures a scan with the devices that rig.toml names, simulated ones too, as `frangia scan`; read_scan(folder) reads it. An interrupted capture is continued by the same call. exposure_ms: milliseconds, "auto" or "bracket"."""
    ...

def find_targets(image: Any, depth_mm: Any, sigma_mm: Any, rig: Rig, *, diameter_mm: float = 0.0, tone: str = 'dark', dictionary: str = '', marker_mm: float = 0.0) -> list[TargetSighting]:
    """Finds round stickers in an image without fringes, and measures their centres by the points around them: discs of `diameter_mm` and `tone`, or markers of an ArUco dictionary. `depth_mm` and `sigma_mm` are those of `triangulate`."""
    ...
