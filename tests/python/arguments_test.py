"""Every function of the Python package answers wrong arguments in one sentence.

Run as a script; the build's python folder must be on PYTHONPATH.
"""
import contextlib
import inspect
import math
import pathlib
import re
import tempfile
import unittest

import numpy as np

import frangia
from frangia._arguments import signatures_of

SHIFTS = [0.0, math.pi / 2, math.pi, 3 * math.pi / 2]
TRUTH = 0.21 * np.arange(80)[None, :] + 0.03 * np.arange(60)[:, None]
CUBE = np.stack([np.round(110 + 90 * np.cos(TRUTH + shift)) for shift in SHIFTS]).astype(np.uint8)


class PlainArrays(unittest.TestCase):
    def setUp(self):
        pattern = frangia.Pattern.fringes(SHIFTS, period_px=20)
        self.expected = frangia.wrap_phase(frangia.FrameStack(list(CUBE), pattern))

    def test_frames_and_shifts_are_enough_to_wrap(self):
        found = frangia.wrap_phase(CUBE, SHIFTS)
        np.testing.assert_array_equal(found.phase, self.expected.phase)
        np.testing.assert_array_equal(found.sigma, self.expected.sigma)
        wide = frangia.wrap_phase([frame.astype(np.uint16) * 256 for frame in CUBE], np.array(SHIFTS))
        np.testing.assert_allclose(wide.phase, found.phase, atol=1e-5)

    def test_a_map_without_a_period_is_unwrapped_spatially_alone(self):
        found = frangia.wrap_phase(CUBE, SHIFTS)
        self.assertTrue(np.isfinite(frangia.unwrap_spatial(found).phase).all())
        with self.assertRaisesRegex(frangia.InputError, "a map has no period; .*period_px=20"):
            frangia.unwrap_temporal([found], (1280, 800))
        with self.assertRaisesRegex(frangia.InputError, "the phase has no period"):
            frangia.triangulate(frangia.AbsolutePhase(found.phase), frangia.rig_preset("digital"))

    def test_the_period_makes_it_absolute(self):
        column = np.linspace(10, 789, 80)[None, :] + np.zeros((40, 1))
        maps = []
        for period in (800.0, 100.0, 12.5):
            phase = 2 * math.pi * (column + 0.5) / period
            cube = np.stack([np.round(110 + 90 * np.cos(phase + shift)) for shift in SHIFTS]).astype(np.uint8)
            maps.append(frangia.wrap_phase(cube, SHIFTS, period_px=period))
        found = frangia.unwrap_temporal(maps, (800, 600))
        np.testing.assert_allclose(found.phase, 2 * math.pi * (column + 0.5) / 12.5, atol=0.05)

    def test_the_white_level_marks_saturated_pixels(self):
        found = frangia.wrap_phase(CUBE, SHIFTS, white_level=195)
        self.assertIn(int(frangia.PixelStatus.SATURATED), np.unique(found.status))

    def test_shifts_that_determine_no_phase_are_refused(self):
        for shifts in ([0.0, 0.0, 1.0, 1.0], [0.0, 2 * math.pi, math.pi, 3 * math.pi]):
            with self.assertRaisesRegex(frangia.InputError, "4 shifts, of which 2 differ, do not determine a phase"):
                frangia.wrap_phase(CUBE, shifts)
            with self.assertRaisesRegex(frangia.InputError, "do not determine a phase"):
                frangia.least_squares(shifts)
        with self.assertRaisesRegex(frangia.InputError, "4 frames and 3 shifts"):
            frangia.wrap_phase(CUBE, SHIFTS[:3])
        with self.assertRaisesRegex(frangia.InputError, r"float64; .*astype\(numpy\.uint16\)"):
            frangia.wrap_phase(CUBE.astype(float), SHIFTS)
        with self.assertRaisesRegex(frangia.InputError, "frames is no list of arrays"):
            frangia.wrap_phase(3, SHIFTS)


class Sentences(unittest.TestCase):
    def refused(self, sentence, function, *given, **named):
        with self.assertRaises(frangia.ArgumentError) as raised:
            function(*given, **named)
        self.assertEqual(str(raised.exception), sentence)
        self.assertIsInstance(raised.exception, TypeError)
        self.assertIsInstance(raised.exception, frangia.InputError)
        self.assertIsNone(raised.exception.__context__)  # no dump of pybind11 above it

    def test_an_array_where_an_object_is_wanted(self):
        self.refused(
            "frangia.wrap_phase: shifts_rad is missing; call frangia.wrap_phase(frames, shifts_rad)",
            frangia.wrap_phase,
            CUBE,
        )
        self.refused(
            "frangia.unwrap_spatial: map is an array of float64, 60 x 80; give a WrappedPhase, such as "
            "frangia.wrap_phase(frames, shifts_rad) or frangia.WrappedPhase(phase)",
            frangia.unwrap_spatial,
            TRUTH,
        )
        self.refused(
            "frangia.FrameStack: pattern is a list of 4 numbers; give a Pattern, such as "
            "frangia.Pattern.fringes(shifts_rad, period_px=20)",
            frangia.FrameStack,
            CUBE,
            SHIFTS,
        )
        self.refused(
            "frangia.unwrap_temporal: maps is a list of 2 arrays of float64; give a list of WrappedPhase objects, such "
            "as frangia.wrap_phase(frames, shifts_rad) or frangia.WrappedPhase(phase)",
            frangia.unwrap_temporal,
            [TRUTH, TRUTH],
            (1280, 800),
        )

    def test_names_of_arguments(self):
        self.refused(
            "frangia.wrap_phase: there is no argument white; did you mean white_level?",
            frangia.wrap_phase,
            CUBE,
            SHIFTS,
            white=3,
        )
        self.refused(
            "frangia.unwrap_spatial: method is given twice, by its place and by its name; give it once",
            frangia.unwrap_spatial,
            frangia.WrappedPhase(TRUTH),
            "run-merging",
            method="run-merging",
        )
        self.refused(
            "frangia.decode: 3 arguments without a name are given; it takes scan, view; name the others, NAME=VALUE",
            frangia.decode,
            1,
            2,
            3,
        )
        self.refused("frangia.read_mesh: path is missing; call frangia.read_mesh(path)", frangia.read_mesh)

    def test_values_that_the_signature_leaves_open(self):
        self.refused(
            'frangia.simulate: part is the number 3; give a text or a Mesh, such as frangia.read_mesh("part.ply") or '
            "frangia.Mesh(vertices, triangles)",
            frangia.simulate,
            "nowhere/scan",
            3,
        )
        self.refused("frangia.simulate: gloss is None; give a number", frangia.simulate, "nowhere/scan", gloss=None)
        self.refused(
            "frangia.edit: steps is a list of 1 numbers; give a list of names and of pairs of a name and a value",
            frangia.edit,
            frangia.make_part("plate"),
            [3],
        )

    def test_methods_and_functions_in_python(self):
        mesh = frangia.make_part("plate")
        self.refused("frangia.Mesh.render: there is no argument wide_px; did you mean width_px?", mesh.show, wide_px=3)
        self.refused(
            'frangia.Mesh.show: the mesh has no values "gloss"; give sigma_mm, or one per vertex',
            mesh.show,
            values="gloss",
        )
        for function in (frangia.to_trimesh, frangia.to_open3d, frangia.to_meshio):
            with self.assertRaisesRegex(frangia.ArgumentError, "mesh is an array of float64, 60 x 80; give a Mesh"):
                function(TRUTH)
        for function in (frangia.from_trimesh, frangia.from_open3d, frangia.from_meshio):
            with self.assertRaisesRegex(frangia.ArgumentError, "mesh is an array of float64, 60 x 80; give a"):
                function(TRUTH)

    def test_errors_of_the_callers_code_stay_as_they_are(self):
        def wrap(stack, algorithm, noise):
            raise TypeError("decode(): mine")

        with tempfile.TemporaryDirectory() as folder:
            rig = frangia.read_rig(pathlib.Path(__file__).parents[1] / "data" / "small-interferometer.toml")
            scan = frangia.simulate(pathlib.Path(folder) / "scan", "plate", rig, views=1, samples_per_px=1)
            with self.assertRaisesRegex(TypeError, r"^decode\(\): mine$"):
                frangia.decode(scan, 0, wrap=wrap)


class Strange:
    pass


# Values that hardly any argument takes. None of them lets a function begin long work.
WRONG = [
    None,
    -1,
    10**30,
    0.5,
    "",
    "nowhere",
    b"x",
    Strange(),
    Strange,
    [],
    [Strange()],
    {},
    [[1], [1, 2]],
    (1,),
    TRUTH,
    np.zeros(0),
    np.array(["a"]),
    np.zeros((2, 2, 2)),
    lambda: None,
]


def callables():
    """Functions, constructors and methods of the package with their names and the signatures to try."""
    for name in dir(frangia):
        try:
            member = getattr(frangia, name)
        except ImportError:  # built without calibration
            continue
        if name.startswith("_") or not callable(member) or inspect.isclass(member) and issubclass(member, Exception):
            continue
        yield name, member
        if inspect.isclass(member):
            for method, function in vars(member).items():
                if not method.startswith("_") and inspect.isroutine(function):
                    yield f"{name}.{method}", getattr(member, method)


class EveryFunction(unittest.TestCase):
    def test_answers_in_one_sentence(self):
        tried, signatures = 0, 0
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            for name, function in callables():
                documented = inspect.unwrap(function.__init__ if inspect.isclass(function) else function)
                found = signatures_of(documented)
                signatures += len(found)
                for parameters in found or [[]]:
                    named = [p.name for p in parameters if not p.name.startswith("*") and p.name != "progress"]
                    calls = [((wrong,), {}) for wrong in WRONG] + [((), {"nonsense": 3}), ((), {}), ((3,) * 12, {})]
                    calls += [((), {key: wrong}) for key in named for wrong in WRONG]
                    calls += [((), {key: wrong for key in named}) for wrong in WRONG]
                    for given, keywords in calls:
                        if name.startswith("simulate") and any(
                            isinstance(v, (str, bytes)) for v in [*given, *keywords.values()]
                        ):
                            continue  # a folder is enough to begin
                        tried += 1
                        with self.subTest(function=name, given=given, keywords=keywords):
                            self.check(function, given, keywords)
        self.assertGreater(signatures, 35)
        self.assertGreater(tried, 2000)

    def check(self, function, given, keywords):
        try:
            function(*given, **keywords)
        except (frangia.Error, TypeError, AttributeError, ModuleNotFoundError) as error:
            text = str(error)
        else:
            return  # taken: a default or a conversion of Python
        self.assertNotRegex(text, "incompatible|Invoked with|Unable to cast|numpy\\.ndarray\\[|_frangia")
        self.assertNotIn("\n", text)
        self.assertLess(len(text), 400)
        self.assertTrue(re.search(r"\w", text))


if __name__ == "__main__":
    unittest.main()
