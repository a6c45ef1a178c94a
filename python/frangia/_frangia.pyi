"""Types of the extension module; python/make_stubs.py writes this file."""

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, ClassVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._notebook import Picture

__version__: str

class Error(Exception):
    """Base of the errors of this package. The text names the file, key or value and what to do."""

class DeviceError(Error, RuntimeError):
    """A device fails or does not answer."""

class FileError(Error, OSError):
    """A file cannot be read or written."""

class InputError(Error, ValueError):
    """A file, value or option is wrong."""

class NumericError(Error, ArithmeticError):
    """A computation has no trustworthy result."""

class AbsolutePhase:
    """Relative to the projector."""
    def __init__(self, phase: ArrayLike, sigma: ArrayLike | None = None, pattern: Pattern = ...) -> None:
        """A phase made elsewhere; NaN where nothing was measured."""
        ...
    @property
    def pattern(self) -> Pattern:
        """Pattern that was decoded."""
        ...
    @property
    def phase(self) -> NDArray[np.float32]:
        """Radians, height x width; NaN: not measured."""
        ...
    @property
    def sigma(self) -> NDArray[np.float32]:
        """Standard deviation of the phase, radians."""
        ...
    @property
    def status(self) -> NDArray[np.uint8]:
        """Number of a PixelStatus for each pixel."""
        ...
    @property
    def systematic(self) -> NDArray[np.float32]:
        """Systematic standard uncertainty, radians; 0 x 0: none is known."""
        ...

class CameraModel:
    """A pinhole camera with lens distortion."""
    @property
    def focal_px(self) -> NDArray[np.float64]:
        """Focal lengths in x and y, px."""
        ...
    @property
    def height_px(self) -> int:
        """Rows."""
        ...
    @property
    def principal_point_px(self) -> NDArray[np.float64]:
        """Principal point; the centre of the first pixel is (0, 0)."""
        ...
    @property
    def width_px(self) -> int:
        """Columns."""
        ...

class DecodePlan:
    """Where the fringe orders of a scan come from."""
    @property
    def absolute(self) -> bool:
        """False: phases are relative, or regions have offsets of their own."""
        ...

class DecodedDirection:
    """One direction of fringes of a view and intermediate results."""
    @property
    def noise(self) -> NoiseModel:
        """Noise of the camera."""
        ...
    @property
    def order(self) -> NDArray[np.int32]:
        """Fringe order; -1: not measured."""
        ...
    @property
    def phase(self) -> AbsolutePhase:
        """Absolute phase of the finest fringes."""
        ...
    @property
    def relative(self) -> RelativePhase | None:
        """Spatially unwrapped phase, or None."""
        ...
    @property
    def wrapped(self) -> list[WrappedPhase]:
        """Wrapped maps, coarse to fine."""
        ...

class DecodedView:
    """The phase of one view; its parts are those of the first direction."""
    @property
    def directions(self) -> list[DecodedDirection]:
        """The decoded directions of fringes: two only if both have an absolute phase."""
        ...
    @property
    def findings(self) -> list[str]:
        """What the frames show, in sentences."""
        ...
    @property
    def noise(self) -> NoiseModel:
        """Noise of the camera."""
        ...
    @property
    def order(self) -> NDArray[np.int32]:
        """Fringe order; -1: not measured."""
        ...
    @property
    def phase(self) -> AbsolutePhase:
        """Absolute phase of the finest fringes."""
        ...
    @property
    def relative(self) -> RelativePhase | None:
        """Spatially unwrapped phase, or None."""
        ...
    @property
    def wrapped(self) -> list[WrappedPhase]:
        """Wrapped maps, coarse to fine."""
        ...

class FrameStack:
    """The frames of one pattern, in the order of shifts."""
    def __init__(self, frames: Iterable[ArrayLike], pattern: Pattern, white_level: int = 0) -> None:
        """Arrays of uint8 or uint16, height x width, one for each shift; contiguous ones are not copied. A white level of 0 is the largest value of their type."""
        ...
    @property
    def frames(self) -> list[Any]:
        """The frames as arrays, without a copy."""
        ...
    @property
    def pattern(self) -> Pattern:
        """Pattern that the frames show."""
        ...
    @property
    def white_level(self) -> int:
        """Counts from which it is saturated."""
        ...

class FringeDirection:
    """Orientation of the fringes."""
    VERTICAL: ClassVar[FringeDirection]
    HORIZONTAL: ClassVar[FringeDirection]
    __members__: ClassVar[dict[str, FringeDirection]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Inspection:
    """What an inspection found. Missing values are NaN, empty or None."""
    def _repr_html_(self: Inspection) -> str:
        """The verdict and the characteristics as a table of HTML."""
        ...
    @property
    def characteristics(self) -> list[MeasuredCharacteristic]:
        """Rows of the table of results, in the order of the plan."""
        ...
    @property
    def deviation_mm(self) -> NDArray[np.float32]:
        """Of each vertex, positive outside; NaN: not compared; empty without a reference."""
        ...
    @property
    def mesh(self) -> Mesh:
        """As it lies on the reference."""
        ...
    @property
    def places(self) -> list[SurfacePlace]:
        """Of the surface that are out or undecided, the worst first."""
        ...
    @property
    def reasons(self) -> list[VerdictReason]:
        """Why the verdict is what it is, what decided first."""
        ...
    @property
    def reference_from_mesh(self) -> NDArray[np.float64] | None:
        """4 x 4; None: the plan says nothing about an alignment."""
        ...
    @property
    def sentence(self) -> str:
        """The verdict about the surface in words; empty without a reference."""
        ...
    @property
    def thickness_mm(self) -> NDArray[np.float32]:
        """Of the wall at each vertex; empty: not asked for."""
        ...
    def to_dict(self) -> dict[Any, Any]:
        """Everything, as `frangia inspect --json` prints it; missing values are None."""
        ...
    @property
    def u_mm(self) -> NDArray[np.float32]:
        """Standard uncertainty of each deviation; empty: not known."""
        ...
    @property
    def verdict(self) -> str:
        """in, out or undecided: the surface and the characteristics together."""
        ...
    def write_report(self, path: str | os.PathLike[str], *, progress: Callable[[float, str], object] | None = None) -> list[str]:
        """Writes the report as HTML, and its JSON, CSV and sections next to it. Returns the paths."""
        ...

class InspectionPlan:
    """How the parts of one kind are inspected."""
    def __init__(self, *, align: str = '', tolerance_mm: tuple[float, float] | None = None, points: Iterable[tuple[ArrayLike, ArrayLike]] = [], start: int = 0, min_feature_mm: float = 0.0, edge_mm: float | None = None, min_coverage: float = 0.9, max_gap_mm: float = 0.0, thickness: bool = False) -> None:
        """As the keys of inspection.toml. align: best-fit, datum, points, none, or empty; tolerance_mm: lower and upper; points: pairs of the same place on mesh and reference; 0: the default. Features and characteristics are read from a file by read_inspection_plan."""
        ...
    @property
    def align(self) -> str:
        """best-fit, datum, points, none, or empty."""
        ...
    @property
    def features(self) -> list[str]:
        """Names of the features."""
        ...
    @property
    def part(self) -> str:
        """Name of the part; may be empty."""
        ...
    @property
    def points(self) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """Pairs of the same place on mesh and reference, mm."""
        ...
    @property
    def reference(self) -> Path:
        """Path; empty: none is stated."""
        ...
    @property
    def start(self) -> int:
        """Of poses that fit alike, from 1; 0: none."""
        ...
    @property
    def thickness(self) -> bool:
        """Measure the walls."""
        ...
    @property
    def tolerance_mm(self) -> tuple[float, float] | None:
        """Lower and upper limit of the deviations; None: plus and minus 0.1."""
        ...

class LinearAlgorithm:
    """An algorithm of yours and its frames."""
    def __init__(self, name: str, shifts_rad: Iterable[float], numerator: Iterable[float], denominator: Iterable[float]) -> None:
        """phase = atan2(numerator . frames, denominator . frames)."""
        ...
    @property
    def algorithm(self) -> PhaseAlgorithm:
        """As the other algorithms."""
        ...
    @property
    def shifts_rad(self) -> list[float]:
        """Shifts of its frames, radians."""
        ...

class MeasuredCharacteristic:
    """A row of the table of results."""
    @property
    def feature(self) -> str:
        """Name of the feature."""
        ...
    @property
    def limits(self) -> tuple[float, float] | None:
        """Lower and upper limit of the value; an absent one is infinite. None: no limits."""
        ...
    @property
    def name(self) -> str:
        """Of the plan, with the quantity."""
        ...
    @property
    def nominal(self) -> float | None:
        """None: not stated."""
        ...
    @property
    def u95(self) -> float:
        """Half the width of the 95 % interval."""
        ...
    @property
    def unit(self) -> str:
        """mm or degrees."""
        ...
    @property
    def value(self) -> float:
        """NaN: the feature was not found."""
        ...
    @property
    def verdict(self) -> str | None:
        """in, out or undecided by ISO 14253-1; None without limits."""
        ...

class MeasuredTarget:
    """A target after all views were registered."""
    @property
    def center_mm(self) -> NDArray[np.float64]:
        """Object frame, mm."""
        ...
    @property
    def code(self) -> int:
        """-1: it has none."""
        ...
    @property
    def setups(self) -> list[int]:
        """That saw it, as scan.toml numbers them."""
        ...
    @property
    def sigma_mm(self) -> float:
        """Of its coordinates, mm."""
        ...
    @property
    def views(self) -> int:
        """That saw it."""
        ...

class Mesh:
    """A triangle mesh, object frame, mm."""
    def __init__(self, vertices: ArrayLike, triangles: ArrayLike) -> None:
        """Vertices N x 3 in mm; triangles M x 3, counter-clockwise seen from outside."""
        ...
    @property
    def colors(self) -> NDArray[np.uint8]:
        """Red, green, blue, N x 3; or empty."""
        ...
    @property
    def normals(self) -> NDArray[np.float32]:
        """Unit vectors, N x 3; empty: none."""
        ...
    def render(self, *, width_px: int = 800, height_px: int = 600, azimuth_deg: float = 35.0, elevation_deg: float = 20.0, values: ArrayLike | None = None, label: str = '') -> NDArray[np.uint8]:
        """A picture, height x width x 3 of uint8; with values, one per vertex, as colours with a scale."""
        ...
    def show(self: Mesh, **options: Any) -> Picture:
        """A picture of the mesh for a notebook; options as `render`. values="sigma_mm" colours by it."""
        ...
    @property
    def sigma_mm(self) -> NDArray[np.float32]:
        """Combined standard uncertainty; or empty."""
        ...
    @property
    def sigma_noise_mm(self) -> NDArray[np.float32]:
        """Its noise; empty: all of it."""
        ...
    @property
    def sigma_systematic_mm(self) -> NDArray[np.float32]:
        """Or empty."""
        ...
    @property
    def triangle_marks(self) -> NDArray[np.uint8]:
        """0 measured, 1 displaced, 2 made; or empty."""
        ...
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Indices of vertices, M x 3."""
        ...
    @property
    def vertex_marks(self) -> NDArray[np.uint8]:
        """0 measured, 1 displaced, 2 made; empty: all 0."""
        ...
    @property
    def vertices(self) -> NDArray[np.float32]:
        """Positions, N x 3, mm."""
        ...
    @property
    def views(self) -> NDArray[np.uint16]:
        """Number of views of each vertex; or empty."""
        ...

class NoiseModel:
    """Variance of a pixel: floor + slope * counts + dark * (range / (counts + range))^2."""
    def __init__(self, floor_counts2: float, slope_counts: float) -> None:
        ...
    @property
    def dark_counts2(self) -> float:
        """What a dark pixel has beyond the floor, of a camera that encodes its light."""
        ...
    @property
    def dark_range_counts(self) -> float:
        """Brightness at which a quarter of that is left."""
        ...
    @property
    def floor_counts2(self) -> float:
        """Variance of a dark pixel."""
        ...
    @property
    def slope_counts(self) -> float:
        """Its increase per count."""
        ...
    def variance(self, counts: float) -> float:
        """Counts squared."""
        ...

class Pattern:
    """A pattern that the projector shows in several frames."""
    @property
    def bits(self) -> int:
        """Number of bits of a Gray code."""
        ...
    @property
    def direction(self) -> FringeDirection:
        """Orientation of fringes and stripes."""
        ...
    @property
    def frame_count(self) -> int:
        """Number of frames."""
        ...
    @staticmethod
    def fringes(shifts_rad: Iterable[float], *, period_px: float | None = None, fringes_per_degree: float | None = None, direction: FringeDirection = ..., name: str = 'fringes') -> Pattern:
        """Sinusoidal fringes: one frame for each of shifts_rad (radians), with a period in projector pixels or in fringes per degree."""
        ...
    @property
    def fringes_per_degree(self) -> float:
        """Pitch of an interferometer; 0: none."""
        ...
    @property
    def kind(self) -> PatternKind:
        """What the frames show."""
        ...
    @property
    def name(self) -> str:
        """Name, and prefix of the frames' file names."""
        ...
    @property
    def period_px(self) -> float:
        """Period in projector pixels; 0: angular."""
        ...
    @property
    def shifts_rad(self) -> list[float]:
        """Shift of each frame, radians."""
        ...

class PatternKind:
    """What the frames of a pattern show."""
    FRINGE: ClassVar[PatternKind]
    LINE: ClassVar[PatternKind]
    GRAY: ClassVar[PatternKind]
    RAMP: ClassVar[PatternKind]
    WHITE: ClassVar[PatternKind]
    AMBIENT: ClassVar[PatternKind]
    __members__: ClassVar[dict[str, PatternKind]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class PhaseAlgorithm:
    """B sin(phi) = sum sine[k] I[k], B cos(phi) = sum cosine[k] I[k]."""
    @property
    def cosine(self) -> list[float]:
        """Weights of the frames for B cos(phi)."""
        ...
    @property
    def name(self) -> str:
        """Name."""
        ...
    @property
    def noise_gain(self) -> float:
        """c in sigma_phi = c sigma_I / B."""
        ...
    @property
    def sine(self) -> list[float]:
        """Weights of the frames for B sin(phi)."""
        ...

class PixelStatus:
    """Why a pixel has no phase."""
    MEASURED: ClassVar[PixelStatus]
    FILLED: ClassVar[PixelStatus]
    UNMODULATED: ClassVar[PixelStatus]
    SATURATED: ClassVar[PixelStatus]
    RESIDUE: ClassVar[PixelStatus]
    UNCERTAIN_ORDER: ClassVar[PixelStatus]
    UNRESOLVED: ClassVar[PixelStatus]
    MIXED_PIXEL: ClassVar[PixelStatus]
    OUT_OF_FIELD: ClassVar[PixelStatus]
    CONTRADICTING: ClassVar[PixelStatus]
    __members__: ClassVar[dict[str, PixelStatus]]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class RangeGrid:
    """A point for each pixel, rig frame."""
    @property
    def depth_mm(self) -> NDArray[np.float32]:
        """z in mm; NaN: no point."""
        ...
    @property
    def sigma_mm(self) -> NDArray[np.float32]:
        """Noise along the viewing ray, mm."""
        ...
    @property
    def systematic_mm(self) -> NDArray[np.float32]:
        """0 x 0: none is known."""
        ...

class Reconstruction:
    """A surface and what the stages report."""
    @property
    def mesh(self) -> Mesh:
        """Fused surface, object frame."""
        ...
    @property
    def points(self) -> int:
        """Points of all views."""
        ...
    @property
    def reason(self) -> str:
        """Empty: it can be trusted."""
        ...
    @property
    def targets(self) -> list[MeasuredTarget]:
        """The stickers of a scan with [targets]; empty without."""
        ...
    @property
    def trustworthy(self) -> bool:
        """False: `reason` says why the mesh must not be trusted."""
        ...
    @property
    def views(self) -> int:
        """Views that hold points."""
        ...

class RelativePhase:
    """Continuous in each region, up to a whole number of fringes."""
    @property
    def pattern(self) -> Pattern:
        """Pattern that was decoded."""
        ...
    @property
    def phase(self) -> NDArray[np.float32]:
        """Radians, height x width; NaN: not measured."""
        ...
    @property
    def region(self) -> NDArray[np.int32]:
        """0, 1, ...; -1: not measured."""
        ...
    @property
    def region_count(self) -> int:
        """Number of regions."""
        ...
    @property
    def sigma(self) -> NDArray[np.float32]:
        """Standard deviation of the phase, radians."""
        ...
    @property
    def status(self) -> NDArray[np.uint8]:
        """Number of a PixelStatus for each pixel."""
        ...
    @property
    def systematic(self) -> NDArray[np.float32]:
        """Systematic standard uncertainty, radians; 0 x 0: none is known."""
        ...

class Rig:
    """A calibrated scanner; its frame is that of the camera, in mm."""
    @property
    def camera(self) -> CameraModel:
        """Model of the reference camera."""
        ...
    @property
    def is_angular(self) -> bool:
        """Whether the projector is an interferometer."""
        ...
    @property
    def projector_position_mm(self) -> NDArray[np.float64]:
        """mm."""
        ...
    @property
    def projector_rotation(self) -> NDArray[np.float64]:
        """projector_from_rig, 3 x 3."""
        ...
    def rays(self) -> NDArray[np.float32]:
        """Direction (x / z, y / z) of each pixel, height x width x 2."""
        ...
    def rig_from_object(self, angle_rad: float) -> NDArray[np.float64]:
        """Pose of the object at a table angle, 4 x 4, mm."""
        ...
    @property
    def white_level(self) -> int:
        """Counts."""
        ...

class Scan:
    """What scan.toml and rig.toml hold."""
    @property
    def folder(self) -> Path:
        """Folder of scan.toml."""
        ...
    def frames(self, view: int) -> list[FrameStack]:
        """The frames of a view: a FrameStack for each pattern and exposure."""
        ...
    @property
    def name(self) -> str:
        """Name of the scan."""
        ...
    @property
    def patterns(self) -> list[Pattern]:
        """In the order of capture."""
        ...
    @property
    def rig(self) -> Rig:
        """Calibrated rig."""
        ...
    @property
    def views(self) -> list[ScanView]:
        """In the order of capture."""
        ...

class ScanView:
    """One view of a scan."""
    @property
    def angle_deg(self) -> float:
        """Angle of the turntable."""
        ...
    @property
    def folder(self) -> Path:
        """Folder of its frames, in the scan's."""
        ...
    @property
    def setup(self) -> int:
        """Views of one setup share a pose of the part."""
        ...

class Section:
    """The curves in which a plane cuts a mesh, the longest first."""
    @property
    def area_mm2(self) -> float:
        """Of the material; NaN where a curve is open."""
        ...
    @property
    def closed(self) -> list[bool]:
        """Whether the last point of each curve is followed by the first."""
        ...
    @property
    def curves(self) -> list[NDArray[np.float64]]:
        """N x 2 for each curve: along u and v, with the material at the left."""
        ...
    @property
    def length_mm(self) -> float:
        """Of all curves."""
        ...
    @property
    def point_mm(self) -> NDArray[np.float64]:
        """Origin."""
        ...
    @property
    def u(self) -> NDArray[np.float64]:
        """Unit, in the plane."""
        ...
    @property
    def v(self) -> NDArray[np.float64]:
        """Unit, normal x u."""
        ...
    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes .dxf (release 12) or .svg, in mm."""
        ...

class SurfacePlace:
    """A place of the surface that is out or undecided."""
    @property
    def area_mm2(self) -> float:
        """Of the nominal surface."""
        ...
    @property
    def at_mm(self) -> NDArray[np.float64]:
        """Where, frame of the reference."""
        ...
    @property
    def decision(self) -> str:
        """out, near_limit, not_well_measured or not_measured."""
        ...
    @property
    def deviation_mm(self) -> float:
        """Mean over a patch; or NaN."""
        ...
    @property
    def u95_mm(self) -> float:
        """Of the deviation."""
        ...

class VerdictClause:
    """A part of the sentence about a verdict."""
    @property
    def id(self) -> str:
        """What it says, such as out_at."""
        ...
    @property
    def text(self) -> str:
        """In English."""
        ...
    @property
    def values(self) -> dict[str, float | NDArray[np.float64] | str]:
        """Its parameters by name; NaN where one is not known."""
        ...

class VerdictReason:
    """A reason of the verdict about a part."""
    @property
    def about(self) -> str:
        """surface or characteristics."""
        ...
    @property
    def clauses(self) -> list[VerdictClause]:
        """The parts of its sentence."""
        ...

class ViewSummary:
    """A view after reconstruction."""

class WrappedPhase:
    """A phase modulo 2 pi, in (-pi, pi]."""
    def __init__(self, phase: ArrayLike, sigma: ArrayLike | None = None, modulation: ArrayLike | None = None, mean: ArrayLike | None = None, pattern: Pattern = ...) -> None:
        """A map made elsewhere; NaN where nothing was measured."""
        ...
    @property
    def mean(self) -> NDArray[np.float32]:
        """Mean intensity, counts."""
        ...
    @property
    def modulation(self) -> NDArray[np.float32]:
        """Amplitude, counts."""
        ...
    @property
    def pattern(self) -> Pattern:
        """Pattern that was decoded."""
        ...
    @property
    def phase(self) -> NDArray[np.float32]:
        """Radians, height x width; NaN: not measured."""
        ...
    @property
    def sigma(self) -> NDArray[np.float32]:
        """Standard deviation of the phase, radians."""
        ...
    @property
    def status(self) -> NDArray[np.uint8]:
        """Number of a PixelStatus for each pixel."""
        ...
    @property
    def systematic(self) -> NDArray[np.float32]:
        """Systematic standard uncertainty, radians; 0 x 0: none is known."""
        ...

def algorithm_errors(algorithm: PhaseAlgorithm, shifts_rad: Iterable[float]) -> dict[Any, Any]:
    """Ripple at a step error of 5 %, noise gain and sensitivity to harmonics, as in the table of `frangia algorithms`."""
    ...

def algorithms() -> list[str]:
    """Names of the published phase-shift algorithms."""
    ...

def decode(scan: Scan, view: int = 0, *, algorithm: str | LinearAlgorithm = 'auto', directions: str = 'fused', max_sigma_rad: float = 0.10000000149011612, undo_response: bool = True, undo_blur: bool = True, accept_inconsistent: bool = False, wrap: Callable[[FrameStack, PhaseAlgorithm, NoiseModel], Any] | None = None, unwrap_spatially: Callable[[WrappedPhase], Any] | None = None, unwrap: Callable[[list[WrappedPhase]], Any] | None = None, progress: Callable[[float, str], object] | None = None) -> DecodedView:
    """Decodes a view of a scan. wrap, unwrap_spatially and unwrap are functions of yours in place of a stage, see the package's help."""
    ...

def decode_frames(stacks: Iterable[FrameStack], rig: Rig, *, algorithm: str = 'auto') -> DecodedView:
    """Decodes the frames of one view that are in memory."""
    ...

def decode_gray_code(gray: FrameStack, fringes: WrappedPhase, noise: NoiseModel | None = None) -> AbsolutePhase:
    """Absolute phase of fringes whose orders a Gray code gives."""
    ...

def deviations(mesh: Mesh, reference: Mesh, *, progress: Callable[[float, str], object] | None = None) -> NDArray[np.float32]:
    """Signed distance of each vertex from a reference, mm, positive outside."""
    ...

def edit(mesh: Mesh, steps: Iterable[Any], *, progress: Callable[[float, str], object] | None = None) -> Mesh:
    """Applies steps of `frangia edit`: names, or pairs of a name and a value, such as [('fill-holes', '10mm'), 'remove-spikes']."""
    ...

def inspect_part(mesh: Mesh, reference: Mesh | str | os.PathLike[str] | None = None, plan: InspectionPlan = ..., *, features: bool = False, scan: Scan | None = None, progress: Callable[[float, str], object] | None = None) -> Inspection:
    """Inspects a part as `frangia inspect` does. reference: a mesh, or the path of a mesh or a CAD file; None: that of the plan, if it states one. features: find all, not only those of the plan. scan: of the mesh, so that features hold the covariance of its rig."""
    ...

def least_squares(shifts_rad: Iterable[float]) -> PhaseAlgorithm:
    """The least-squares algorithm for arbitrary shifts, radians (Greivenkamp 1984)."""
    ...

def make_part(name: str) -> Mesh:
    """A built-in part of the simulator: shaft, blade, bust, ball-bar, plate, bracket, groove, gear."""
    ...

def merge(paths: Iterable[str | os.PathLike[str]], *, voxel_mm: float = 0.0, progress: Callable[[float, str], object] | None = None) -> tuple[Any, ...]:
    """Registers range scans of other scanners and fuses them: the mesh, the pose of each scan (4 x 4), and why the mesh must not be trusted (empty: it can be)."""
    ...

def phase_algorithm(name: str, shifts_rad: Iterable[float], gain_error: float = 0.0) -> PhaseAlgorithm:
    """A published algorithm for these nominal shifts, radians."""
    ...

def plan_decoding(scan: Scan, *, directions: str = 'fused', max_sigma_rad: float = 0.10000000149011612) -> DecodePlan:
    """How `decode` and `reconstruct` decode the views of a scan; str() of it is a line for each direction."""
    ...

def read_algorithm(path: str | os.PathLike[str]) -> LinearAlgorithm:
    """Reads an algorithm of yours, as examples/algorithms/my-algorithm.toml."""
    ...

def read_inspection_plan(path: str | os.PathLike[str]) -> InspectionPlan:
    """Reads inspection.toml; its reference is relative to it."""
    ...

def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Reads DXF, STL, PLY, OBJ, glTF, 3MF, OFF, XYZ or PCD by the file's extension; mm."""
    ...

def read_rig(path: str | os.PathLike[str]) -> Rig:
    """Reads a rig.toml."""
    ...

def read_scan(folder: str | os.PathLike[str], *, rig: str = 'complete') -> Scan:
    """Reads scan.toml and rig.toml of a folder. rig: complete; start-values, before a calibration; phase-only, to decode without geometry."""
    ...

def reconstruct(scan: Scan, *, algorithm: str | LinearAlgorithm = 'auto', directions: str = 'fused', max_sigma_rad: float = 0.10000000149011612, undo_response: bool = True, undo_blur: bool = True, accept_inconsistent: bool = False, wrap: Callable[[FrameStack, PhaseAlgorithm, NoiseModel], Any] | None = None, unwrap_spatially: Callable[[WrappedPhase], Any] | None = None, unwrap: Callable[[list[WrappedPhase]], Any] | None = None, voxel_mm: float = 0.0, register_views: bool = True, indirect_light: bool = True, keep_islands: bool = False, watertight: bool = False, clip_below_mm: float = ..., progress: Callable[[float, str], object] | None = None) -> Reconstruction:
    """Frames to one surface, as `frangia reconstruct`. A voxel of 0 mm is derived from the scan."""
    ...

def rig_preset(name: str) -> Rig:
    """A built-in rig: digital, binocular, angular or carducci."""
    ...

def section(mesh: Mesh, point_mm: ArrayLike, normal: ArrayLike) -> Section:
    """Cuts a mesh by the plane through a point. Synthesized triangles are left out, so that curves are open at filled holes."""
    ...

def simulate(folder: str | os.PathLike[str], part: str | Mesh = 'bust', rig: str | Rig = 'digital', *, views: int = 8, seed: int = 1, samples_per_px: int = 4, shifts: int = 4, periods_px: Iterable[float] = [], progress: Callable[[float, str], object] | None = None, **faults: float) -> Scan:
    """Renders a scan of a part (a name or a Mesh) with a rig (a preset or a Rig) into a new folder, with the true surface as truth.ply in the same folder. Without periods_px: the projector's width, an eighth and a 64th of it. Faults: exposure, ambient, contrast, step_error, step_jitter_deg, display_gamma, flicker, projector_blur_px, texture, gloss, bounces, subsurface_mm, speckle, angle_error_deg, axis_offset_mm, axis_tilt_deg."""
    ...

def simulate_poses(folder: str | os.PathLike[str], rig: str | Rig = 'digital', *, poses: int = 12, seed: int = 1, samples_per_px: int = 4, periods_px: Iterable[float] = [], progress: Callable[[float, str], object] | None = None, **faults: float) -> Scan:
    """Renders poses of a checkerboard for `calibrate` into a new folder, whose rig.toml holds the sizes of camera and projector only; truth-rig.toml is the true rig. Faults as those of `simulate`."""
    ...

def surface_error(mesh: Mesh, reference: Mesh, *, progress: Callable[[float, str], object] | None = None) -> dict[Any, Any]:
    """Statistics of the distances of the vertices from a reference in the same frame, mm."""
    ...

def triangulate(phase: AbsolutePhase, rig: Rig) -> RangeGrid:
    """A point in mm, rig frame, for each pixel that has a phase."""
    ...

def unwrap_spatial(map: WrappedPhase, method: str = 'run-merging') -> RelativePhase:
    """A phase that is continuous in each region. Methods: run-merging, quality-guided (the 1997 paper's), reliability-sorted (Herraez 2002)."""
    ...

@overload
def unwrap_temporal(maps: Iterable[WrappedPhase], rig: Rig) -> AbsolutePhase:
    """Absolute phase of the finest fringes from maps, coarse to fine."""
    ...
@overload
def unwrap_temporal(maps: Iterable[WrappedPhase], projector_px: tuple[int, int]) -> AbsolutePhase:
    """The same for a projector of which only its width and height in pixels are known."""
    ...

@overload
def wrap_phase(stack: FrameStack, *, algorithm: PhaseAlgorithm | None = None, noise: NoiseModel | None = None, max_sigma_rad: float = 0.10000000149011612) -> WrappedPhase:
    """Phase, modulation, mean and noise of each pixel. Without an algorithm: least squares; without a noise model: estimated from the frames."""
    ...
@overload
def wrap_phase(frames: Iterable[ArrayLike], shifts_rad: Iterable[float], *, period_px: float = 0.0, white_level: int = 0, algorithm: PhaseAlgorithm | None = None, noise: NoiseModel | None = None, max_sigma_rad: float = 0.10000000149011612) -> WrappedPhase:
    """The same for an array of uint8 or uint16, frames x height x width, or a list of images, one for each shift in radians. unwrap_temporal needs the period, in projector pixels. A white level of 0 is the largest value of the type."""
    ...

def write_mesh(path: str | os.PathLike[str], mesh: Mesh) -> None:
    """Writes a mesh; the extension chooses the format."""
    ...

def write_rig(path: str | os.PathLike[str], rig: Rig) -> None:
    """Writes a rig.toml."""
    ...
