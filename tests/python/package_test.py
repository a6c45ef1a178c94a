"""The Python package against NumPy's own answers, and as its users call it.

Run as a script; the build's python folder must be on PYTHONPATH.
"""
import logging
import math
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import numpy as np

import frangia

SHIFTS = [0.0, math.pi / 2, math.pi, 3 * math.pi / 2]


def frames_of(phase, modulation=90.0, mean=110.0):
    return [np.round(mean + modulation * np.cos(phase + s)).astype(np.uint8) for s in SHIFTS]


def tilted(height=60, width=80):
    y, x = np.mgrid[0:height, 0:width]
    return 0.21 * x + 0.03 * y


class Stages(unittest.TestCase):
    def setUp(self):
        self.truth = tilted()
        self.pattern = frangia.Pattern.fringes(SHIFTS, period_px=20)
        self.stack = frangia.FrameStack(frames_of(self.truth), self.pattern)

    def test_frames_are_not_copied(self):
        frames = [np.ascontiguousarray(f) for f in frames_of(self.truth)]
        stack = frangia.FrameStack(frames, self.pattern)
        self.assertTrue(np.shares_memory(stack.frames[2], frames[2]))
        frames = None
        np.testing.assert_array_equal(stack.frames[1], frames_of(self.truth)[1])

    def test_frames_of_any_layout_are_taken(self):
        cube = np.stack(frames_of(self.truth), axis=-1)  # not contiguous in a frame
        frames = [cube[..., k] for k in range(4)]
        frames[0].setflags(write=False)
        map_ = frangia.wrap_phase(frangia.FrameStack(frames, self.pattern))
        np.testing.assert_array_equal(map_.phase, frangia.wrap_phase(self.stack).phase)

    def test_wrapped_phase_is_that_of_numpy(self):
        i = [f.astype(float) for f in self.stack.frames]
        expected = np.arctan2(i[3] - i[1], i[0] - i[2])
        map_ = frangia.wrap_phase(self.stack)
        difference = np.angle(np.exp(1j * (map_.phase - expected)))
        self.assertLess(np.abs(difference).max(), 1e-5)
        np.testing.assert_allclose(map_.modulation, np.hypot(i[3] - i[1], i[0] - i[2]) / 2, rtol=1e-4)

    def test_spatial_unwrapping_is_that_of_numpy(self):
        map_ = frangia.wrap_phase(self.stack)
        expected = np.unwrap(np.unwrap(map_.phase, axis=1), axis=0)
        for method in ("run-merging", "quality-guided", "reliability-sorted"):
            found = frangia.unwrap_spatial(map_, method)
            offset = np.round((found.phase - expected) / (2 * math.pi))
            self.assertEqual(np.unique(offset).size, 1, method)
            np.testing.assert_allclose(found.phase - 2 * math.pi * offset, expected, atol=1e-3)

    def test_temporal_unwrapping(self):
        width = 800
        column = np.linspace(10, width - 11, 80)[None, :] + np.zeros((40, 1))
        maps = []
        for period in (800.0, 100.0, 12.5):
            pattern = frangia.Pattern.fringes(SHIFTS, period_px=period)
            frames = frames_of(2 * math.pi * (column + 0.5) / period)
            maps.append(frangia.wrap_phase(frangia.FrameStack(frames, pattern)))
        phase = frangia.unwrap_temporal(maps, (width, 600))
        np.testing.assert_allclose(phase.phase, 2 * math.pi * (column + 0.5) / 12.5, atol=0.05)

    def test_temporal_unwrapping_uses_all_maps_where_decode_does(self):
        width = 800
        column = np.linspace(10, width - 11, 80)[None, :] + np.zeros((40, 1))
        maps = []
        for period in (800.0, 200.0):  # a ratio that is safe for every pixel
            pattern = frangia.Pattern.fringes(SHIFTS, period_px=period)
            frames = frames_of(2 * math.pi * (column + 0.5) / period)
            maps.append(frangia.wrap_phase(frangia.FrameStack(frames, pattern)))
        phase = frangia.unwrap_temporal(maps, (width, 600))
        ratio = np.nanmedian(phase.sigma / maps[1].sigma)
        self.assertAlmostEqual(ratio, 1 / math.hypot(1, 1 / 4), places=3)
        with self.assertRaisesRegex(frangia.InputError, "add a coarser map"):
            frangia.unwrap_temporal(maps[1:], (width, 600))

    def test_own_algorithm(self):
        algorithm = frangia.least_squares(SHIFTS)
        np.testing.assert_allclose(algorithm.sine, [0, -0.5, 0, 0.5], atol=1e-12)
        self.assertAlmostEqual(frangia.algorithm_errors(algorithm, SHIFTS)["noise_gain"], math.sqrt(0.5), places=3)

    def test_bad_arrays_are_refused_in_words(self):
        with self.assertRaisesRegex(frangia.InputError, "4 shifts"):
            frangia.FrameStack(frames_of(self.truth)[:3], self.pattern)
        with self.assertRaisesRegex(ValueError, "uint8 or uint16"):
            frangia.FrameStack([f.astype(float) for f in frames_of(self.truth)], self.pattern)
        with self.assertRaisesRegex(frangia.InputError, "size or type"):
            frangia.FrameStack(frames_of(self.truth)[:3] + [np.zeros((2, 2), np.uint8)], self.pattern)
        with self.assertRaisesRegex(frangia.InputError, "height x width"):
            frangia.WrappedPhase(np.zeros(3, np.float32))
        with self.assertRaisesRegex(frangia.InputError, "run-merging"):
            frangia.unwrap_spatial(frangia.wrap_phase(self.stack), "magic")


class Scans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        rig = pathlib.Path(__file__).parents[1] / "data" / "small-interferometer.toml"
        cls.path = pathlib.Path(cls.folder.name) / "scan"
        cls.scan = frangia.simulate(cls.path, "bust", frangia.read_rig(rig), views=4, samples_per_px=4)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_decodes_as_the_stages_do(self):
        view = frangia.decode(self.scan, 0, algorithm="4-step", undo_blur=False)
        fringes = [s for s in self.scan.frames(0) if s.pattern.kind == frangia.PatternKind.FRINGE]
        algorithm = frangia.phase_algorithm("4-step", fringes[-1].pattern.shifts_rad)
        map_ = frangia.wrap_phase(fringes[-1], algorithm=algorithm, noise=view.noise)
        both = ~np.isnan(map_.phase) & ~np.isnan(view.wrapped[-1].phase)
        self.assertGreater(both.sum(), 500)
        self.assertLess(np.abs(np.angle(np.exp(1j * (map_.phase - view.wrapped[-1].phase))))[both].max(), 0.05)
        whole = (view.phase.phase - view.wrapped[-1].phase) / (2 * math.pi)
        measured = view.order >= 0
        np.testing.assert_allclose(whole[measured], view.order[measured], atol=1e-3)

    def test_states_where_fringe_orders_come_from(self):
        plan = frangia.plan_decoding(self.scan)
        self.assertTrue(plan.absolute)
        self.assertEqual(
            str(plan), "vertical fringes of 1 per degree: unwrapped in space; the laser sheet gives the orders"
        )
        with self.assertRaisesRegex(frangia.InputError, "no horizontal fringes"):
            frangia.plan_decoding(self.scan, directions="horizontal")

    def test_own_stages_give_the_same_surface(self):
        calls = []

        def wrap(stack, algorithm, noise):
            calls.append(stack.pattern.name)
            return frangia.wrap_phase(stack, algorithm=algorithm, noise=noise)

        def unwrap(map_):
            return frangia.unwrap_spatial(map_)

        ours = frangia.reconstruct(self.scan, indirect_light=False, undo_blur=False)  # own stages correct none
        own = frangia.reconstruct(self.scan, indirect_light=False, wrap=wrap, unwrap_spatially=unwrap)
        self.assertGreaterEqual(len(calls), 4)
        np.testing.assert_array_equal(own.mesh.vertices, ours.mesh.vertices)

    def test_errors_of_own_stages_arrive_whole(self):
        def wrap(stack, algorithm, noise):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            frangia.decode(self.scan, 0, wrap=wrap)

        with self.assertRaisesRegex(frangia.InputError, "another size|pixels"):
            frangia.decode(self.scan, 0, wrap=lambda *_: np.zeros((2, 3), np.float32))

    def test_ctrl_c_stops_long_work(self):
        works, pressed = threading.Event(), []

        def press():
            works.wait()
            pressed.append(time.process_time())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=press, daemon=True).start()
        with self.assertRaises(KeyboardInterrupt):
            frangia.reconstruct(self.scan, progress=lambda share, stage: works.set())
        self.assertLess(time.process_time() - pressed[0], 1.0)  # processor time of all threads

    def test_progress_and_messages(self):
        stages = set()
        with self.assertLogs("frangia", logging.INFO):
            frangia.reconstruct(self.scan, progress=lambda share, stage: stages.add(stage))
        self.assertIn("surface", stages)

    def test_a_missing_folder_is_named(self):
        with self.assertRaisesRegex(frangia.InputError, "nowhere"):
            frangia.read_scan("nowhere")


class Capture(unittest.TestCase):
    def test_captures_on_simulated_devices_and_continues(self):
        rig = pathlib.Path(__file__).resolve().parents[2] / "examples" / "simulated-digital.toml"
        with tempfile.TemporaryDirectory() as folder:
            scan = pathlib.Path(folder) / "scan"
            first = frangia.capture(rig, scan, views=1, periods_px=[1280, 160], shifts=3)
            self.assertEqual((first.captured, first.resumed, first.skipped), (6, 0, []))
            again = frangia.capture(rig, scan, views=1, periods_px=[1280, 160], shifts=3)
            self.assertEqual((again.captured, again.resumed), (0, 6))
            phase = frangia.decode(frangia.read_scan(scan), 0).phase.phase
            self.assertGreater(np.isfinite(phase).sum(), 1000)
            with self.assertRaisesRegex(frangia.InputError, r"scan\.toml: \[board\] is missing"):
                frangia.calibrate(frangia.read_scan(scan))
        with self.assertRaisesRegex(frangia.InputError, "nowhere.toml"):
            frangia.capture("nowhere.toml", "scan")


class Targets(unittest.TestCase):
    def test_finds_a_disc_where_it_is(self):
        rig = frangia.rig_preset("digital")
        rays = np.asarray(rig.rays(), np.float64)
        middle_mm, distance_mm, radius_mm = np.array([12.0, -7.0]), 500.0, 5.0
        away = np.linalg.norm(rays * distance_mm - middle_mm, axis=2)
        edge = np.clip((radius_mm - away) * rig.camera.focal_px[0] / distance_mm + 0.5, 0, 1)  # of pixels
        image = 180.0 - 140.0 * edge
        depth = np.full(image.shape, distance_mm, np.float32)
        sigma = np.full(image.shape, 0.01, np.float32)
        (found,) = frangia.find_targets(image, depth, sigma, rig, diameter_mm=2 * radius_mm)
        self.assertEqual(found.code, -1)
        np.testing.assert_allclose(found.center_mm, [*middle_mm, distance_mm], atol=0.02)
        self.assertLess(found.covariance_mm2[0, 0], 0.02**2)
        self.assertEqual(frangia.find_targets(image, depth, sigma, rig, diameter_mm=3 * radius_mm), [])
        with self.assertRaises(frangia.InputError):
            frangia.find_targets(image, depth, sigma, rig)  # of which size?


class Meshes(unittest.TestCase):
    def test_arrays_in_and_out(self):
        vertices = np.array([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], np.float64)
        triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        mesh = frangia.Mesh(vertices, triangles)
        np.testing.assert_array_equal(mesh.vertices, vertices.astype(np.float32))
        np.testing.assert_array_equal(mesh.triangles, triangles)
        with self.assertRaisesRegex(frangia.InputError, "vertex 7 of 4"):
            frangia.Mesh(vertices, [[0, 1, 7]])

    def test_edits_compares_and_draws(self):
        part = frangia.make_part("plate")
        smaller = frangia.edit(part, [("offset", "-0.5mm")])
        self.assertAlmostEqual(frangia.deviations(smaller, part).mean(), -0.5, delta=0.1)
        self.assertGreater(frangia.surface_error(smaller, part)["rms_mm"], 0.3)
        picture = part.show(width_px=200, height_px=150)
        self.assertTrue(picture._repr_png_().startswith(b"\x89PNG"))
        with self.assertRaises(frangia.InputError):
            frangia.edit(part, ["no-such-step"])

    def test_a_view_keeps_its_mesh(self):
        vertices = frangia.make_part("plate").vertices
        self.assertTrue(np.isfinite(vertices).all())


class Inspections(unittest.TestCase):
    def test_by_a_plan_of_python(self):
        part = frangia.make_part("plate")
        plan = frangia.InspectionPlan(align="none", tolerance_mm=(-0.1, 0.1), min_feature_mm=2)
        itself = frangia.inspect_part(part, part, plan)
        self.assertEqual(itself.verdict, "in")
        self.assertRegex(itself.sentence, "^in, over .* of the nominal area")
        self.assertEqual(itself.reference_from_mesh.tolist(), np.eye(4).tolist())
        self.assertEqual(itself.to_dict()["deviation"]["verdict"], "in")
        smaller = frangia.edit(part, [("offset", "-0.5mm")])
        found = frangia.inspect_part(smaller, part, plan)
        self.assertEqual(found.verdict, "out")
        self.assertAlmostEqual(found.places[0].deviation_mm, -0.5, delta=0.1)
        (reason,) = found.reasons
        self.assertEqual(str(reason), "surface: " + found.sentence)
        self.assertEqual([clause.id for clause in reason.clauses][:2], ["out_at", "out_share"])
        self.assertEqual(reason.clauses[0].values["deviation_mm"], found.places[0].deviation_mm)
        self.assertEqual(reason.clauses[0].values["at_mm"].tolist(), found.places[0].at_mm.tolist())
        self.assertEqual(len(found.deviation_mm), len(smaller.vertices))
        self.assertAlmostEqual(float(np.nanmean(found.deviation_mm)), -0.5, delta=0.1)
        plan.tolerance_mm = (-1, 1)
        self.assertEqual(frangia.inspect_part(smaller, part, plan).verdict, "in")

    def test_by_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            part = frangia.make_part("ball-bar")
            frangia.write_mesh(folder / "nominal.ply", part)
            (folder / "inspection.toml").write_text(
                'format = "frangia-inspection"\nversion = 1\nreference = "nominal.ply"\n[[features]]\n'
                'name = "ball <A>"\nkind = "sphere"\nnear_mm = [0, 35, 60]\ndiameter_mm = 40\n'
                "tolerance_mm = [-0.02, 0.02]\n"
            )
            plan = frangia.read_inspection_plan(folder / "inspection.toml")
            self.assertEqual(plan.features, ["ball <A>"])
            found = frangia.inspect_part(part, plan=plan)
            (row,) = found.characteristics
            self.assertAlmostEqual(row.value, 40, delta=0.01)
            self.assertEqual((row.nominal, row.limits, row.verdict), (40, (39.98, 40.02), "in"))
            shown = found._repr_html_()
            self.assertIn("<td>ball &lt;A&gt; diameter</td>", shown)
            written = found.write_report(folder / "report.html")
            self.assertIn("ball &lt;A&gt;", (folder / "report.html").read_text())
            self.assertEqual(pathlib.Path(written[-1]).name, "report.html")
            self.assertIsNone(found.reference_from_mesh)

    def test_sections(self):
        ball = frangia.make_part("ball-bar")
        low = ball.vertices.min(axis=0)
        cut = frangia.section(ball, (0, 35, 60), (0, 0, 1))
        # Both balls of 40 mm, cut through their centers.
        self.assertEqual(cut.closed, [True, True])
        for curve in cut.curves:
            radius = np.linalg.norm(curve - (curve.min(axis=0) + curve.max(axis=0)) / 2, axis=1)
            self.assertAlmostEqual(float(abs(radius - 20).max()), 0, delta=0.01)
        self.assertAlmostEqual(cut.area_mm2, 2 * np.pi * 20**2, delta=1)
        self.assertAlmostEqual(cut.length_mm, 4 * np.pi * 20, delta=0.1)
        self.assertEqual(frangia.section(ball, low - 1, (0, 0, 1)).curves, [])
        with tempfile.TemporaryDirectory() as folder:
            for name in ("cut.dxf", "cut.svg"):
                cut.write(pathlib.Path(folder) / name)
            self.assertIn("POLYLINE", (pathlib.Path(folder) / "cut.dxf").read_text())
            with self.assertRaisesRegex(frangia.InputError, "dxf or .svg"):
                cut.write(pathlib.Path(folder) / "cut.png")
        with self.assertRaisesRegex(frangia.InputError, "normal of a section must not be zero"):
            frangia.section(ball, (0, 0, 0), (0, 0, 0))

    def test_refuses_in_one_sentence(self):
        part = frangia.make_part("plate")
        with self.assertRaisesRegex(frangia.InputError, "there is no reference to align"):
            frangia.inspect_part(part, plan=frangia.InspectionPlan(align="best-fit"))
        with self.assertRaisesRegex(frangia.InputError, 'align = "roughly" is not known'):
            frangia.InspectionPlan(align="roughly")
        with self.assertRaisesRegex(frangia.ArgumentError, "reference is the number 3; give a path"):
            frangia.inspect_part(part, 3)


if __name__ == "__main__":
    unittest.main()
