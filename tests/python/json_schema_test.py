"""The answers of every verb with --json follow docs/json: json_schema_test.py PROGRAM SOURCE_DIR [--demo]."""
import functools
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ModuleNotFoundError:
    print("python3-jsonschema is missing")
    sys.exit(77)

PROGRAM, SOURCE = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
SCHEMAS = SOURCE / "docs" / "json"
SMALL = SOURCE / "tests" / "data" / "small-interferometer.toml"
CAPTURE = """
[camera]
{camera}
[projector]
model = "pinhole"
position_mm = [-180.0, -20.0, 30.0]
rotation = [[0.931242779706, 0.0, -0.364399348581], [-0.0147420196862, 0.999181334288, -0.0376740503092],
            [0.364101027328, 0.0404556697031, 0.930480403172]]
size_px = [1280, 800]
focal_px = [1900.0, 1900.0]
principal_point_px = [639.5, 399.5]

[turntable]
point_mm = [3.5, 50.0, 516.0]
axis = [-0.009387553932644826, -0.882947592858927, -0.46937769663224127]
{devices}"""
DEVICES = """
[devices.camera]
driver = "simulated"
part = "{part}"

[devices.fringes]
driver = "simulated-display"

[devices.turntable]
driver = "simulated"
"""

MAKER = """format = "frangia-rig"
version = 1
[camera]
size_px = [240, 192]
[projector]
model = "pinhole"
size_px = [1280, 800]
[devices.camera]
driver = "simulated"
true_rig = "truth.toml"
[devices.fringes]
driver = "simulated-display"
[devices.turntable]
driver = "simulated"
"""


def rig_text(part=None, width_px=160):
    """A part needs few pixels; a board needs more."""
    share = width_px / 240
    camera = (
        f"size_px = [{width_px}, {width_px * 4 // 5}]\nfocal_px = [{450 * share}, {450 * share}]\n"
        f"principal_point_px = [{122.74 * share - 0.5}, {94.46 * share - 0.5}]\nwhite_level = 255"
    )
    devices = DEVICES.format(part=part) if part else ""
    return 'format = "frangia-rig"\nversion = 1\n' + CAPTURE.format(camera=camera, devices=devices)


def schema(name):
    return json.loads((SCHEMAS / f"{name}.schema.json").read_text())


@functools.cache
def verbs():
    """The names of all verbs, of those with verbs of their own the latter: `calibrate-rig`."""

    def below(words):
        text = subprocess.run([PROGRAM, *words, "--help"], capture_output=True, text=True, check=True).stdout
        if "Subcommands:" not in text:
            return ["-".join(words)]
        names = re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1].split("\n\n")[0], re.MULTILINE)
        return [leaf for name in names for leaf in below([*words, name])]

    return below([])


class Answers(unittest.TestCase):
    answered = set()

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "rig.toml").write_text(rig_text())
        cls.run_quietly("simulate", "bracket", "--rig", "rig.toml", "--views", "4", "-o", "scan")
        cls.run_quietly("reconstruct", "scan", "-o", "mesh.ply")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def run_quietly(cls, *arguments):
        subprocess.run(
            [PROGRAM, "--quiet", *map(str, arguments)], cwd=cls.folder, check=True, stderr=subprocess.DEVNULL
        )

    def answer(self, *arguments, code=0, verb=None, **keywords):
        """The answer, which is one JSON document that follows the schema of the verb."""
        verb = verb or arguments[0]
        done = subprocess.run(
            [PROGRAM, "--json", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, **keywords
        )
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr}")
        parsed = json.loads(done.stdout)
        jsonschema.Draft202012Validator(schema(verb)).validate(parsed)
        self.answered.add(verb)
        return parsed

    def test_scans(self):
        self.answer("simulate", "plate", "--rig", "rig.toml", "--views", "1", "-o", "other")
        self.answer("decode", "scan", "-o", "maps")
        self.answer("decode", "scan", "--show-plan")
        self.answer("decode", "--show-hypotheses")
        self.answer("decode", "scan", "--view", "1", "-o", "stages")
        result = self.answer("reconstruct", "scan", "-o", "again.ply", "--keep-raw", "raw.ply")
        for view in result["per_view"]:  # what the issue of a program needs at each view
            self.assertGreater(view["contrast"], 0.5)
            self.assertEqual(view["quality"], "good")
        (self.folder / "scans").mkdir()
        (self.folder / "scans" / "one").symlink_to("../scan")
        self.answer("batch", "scans", "-o", "batch", "--task", "0")
        self.answer("batch", "scans", "-o", "batch")
        self.answer("reconstruct", "other", "-o", "other.ply")
        self.answer(
            "import", "scan/views/000", "-o", "imported", "--patterns", "scan/scan.toml", "--rig", "rig.toml", "--yes"
        )

    def test_acceptance(self):
        (self.folder / "ball-rig.toml").write_text(rig_text("ball-bar"))
        (self.folder / "acceptance.toml").write_text(
            'format = "frangia-acceptance"\nversion = 1\nsource = "devices"\nrig = "ball-rig.toml"\nviews = 3\n'
            "[artifact]\ndiameters_mm = [40.0]\nu95_mm = 0.001\n[limits]\nprobing_size_mm = 0.0001\n"
        )
        test = ("accept", "acceptance.toml", "-o", "acceptance", "--fail-out-of-tolerance")
        self.answer(*test, code=1, input="\n\n\n")  # a limit that this rig does not keep
        self.assertTrue((self.folder / "acceptance" / "certificate.html").exists())
        subprocess.run(["sha256sum", "--quiet", "-c", "acceptance/frames.sha256"], cwd=self.folder, check=True)

    def test_scans_with_directions_and_without_geometry(self):
        self.run_quietly("simulate", "bust", "--rig", SMALL, "--views", "4", "--samples", "4", "-o", "laser")
        self.answer("reconstruct", "laser", "-o", "laser.ply")
        self.answer("decode", "laser", "-o", "laser-maps")
        (self.folder / "laser" / "rig.toml").unlink()
        phases = self.answer("decode", "laser", "-o", "laser-phases")
        self.assertIsNone(phases["views"][0]["points"])

    def test_meshes(self):
        self.answer("edit", "mesh.ply", "--remove-islands", "2mm", "-o", "edited.stl")
        self.answer("edit", "mesh.ply", "--select-plane", "0,0,1,20mm", "--delete", "--preview", "look.png")
        self.answer("picture", "mesh.ply", "--width", "200", "--height", "150", "-o", "picture.png")
        self.answer("merge", "mesh.ply", "mesh.ply", "-o", "merged.ply", "--voxel", "2mm")
        self.answer(
            "inspect", "mesh.ply", "--reference", "scan/truth.ply", "--features", "--section", "z=20", "--thickness"
        )
        self.answer(
            "inspect",
            "mesh.ply",
            "--reference",
            "scan/truth.ply",
            "--align",
            "best-fit",
            "--tolerance",
            "0.5,0.6",
            "--fail-out-of-tolerance",
            code=1,
        )

    def test_devices(self):
        (self.folder / "devices.toml").write_text(rig_text("plate"))
        self.answer("devices", "devices.toml", "--no-search")
        (self.folder / "broken.toml").write_text(rig_text("plate").replace('"simulated-display"', '"absent"'))
        faults = self.answer("devices", "broken.toml", "--no-search", code=4)
        self.assertIn("absent", faults["rig"][1]["fault"])
        self.answer("scan", "devices.toml", "-o", "captured", "--views", "1", "--periods", "1280,160")
        self.answer(
            "calibrate",
            "piezo",
            SMALL,
            "--steps",
            "9",
            verb="calibrate-piezo",
        )
        (self.folder / "truth.toml").write_text(rig_text(width_px=240))
        (self.folder / "maker.toml").write_text(MAKER)
        self.answer("calibrate", "display", "maker.toml", "-o", "display.toml", verb="calibrate-display")
        self.answer(
            "calibrate",
            "capture",
            "maker.toml",
            "-o",
            "poses",
            "--square",
            "14mm",
            "--poses",
            "3",
            verb="calibrate-capture",
            input="\n\n\n\n",
        )
        self.answer("calibrate", "rig", "poses", "-o", "calibrated.toml", verb="calibrate-rig")

    def test_rigs(self):
        self.answer("calibrate", "board", "-o", "board.pdf", verb="calibrate-board")
        self.answer("calibrate", "targets", "-o", "targets.pdf", verb="calibrate-targets")
        self.answer("calibrate", "export", "rig.toml", "-o", "rig.yml", verb="calibrate-export")
        self.answer("calibrate", "import", "rig.yml", "-o", "imported.toml", verb="calibrate-import")
        self.answer("calibrate", "refine", "scan", "-o", "refined.toml", verb="calibrate-refine")
        self.answer("calibrate", "check", "rig.toml", "scan", verb="calibrate-check")
        (self.folder / "fine.toml").write_text(rig_text(width_px=240))
        self.run_quietly("simulate", "plate", "--rig", "rig.toml", "--views", "1", "--ramp", "16", "-o", "ramp")
        self.answer("response", "ramp", "-o", "response.toml")
        self.run_quietly(
            "simulate",
            "--calibration",
            "checkerboard",
            "--on-turntable",
            "--rig",
            "fine.toml",
            "--views",
            "3",
            "-o",
            "turning",
        )
        self.answer(
            "calibrate", "turntable", "turning", "--rig", "fine.toml", "-o", "turned.toml", verb="calibrate-turntable"
        )

    @unittest.skipUnless("--demo" in sys.argv, "a demo takes a minute")
    def test_demo(self):
        self.answer("demo", "-o", "demo")

    def test_tables(self):
        self.answer("algorithms")
        self.answer("algorithms", SOURCE / "examples/algorithms/my-algorithm.toml")
        self.answer("plan", "--rig", "digital", "--fringes", "64", verb="plan-patterns")
        self.answer("plan", "patterns", "--rig", "angular", verb="plan-patterns")
        self.run_quietly("simulate", "shaft", "--rig", SMALL, "--views", "1", "-o", "small")
        part = ("small/truth.ply", "--rig", SMALL, "--views", "1", "--tolerance", "1mm")  # few scans are tried
        planned = self.answer("plan", "scan", *part, "--quick", verb="plan-scan")
        self.assertGreater(len(planned["tried"]), 1)

    def test_serve(self):
        server = subprocess.Popen(
            [PROGRAM, "--json", "serve", "--port", "0", "--projects", "projects"],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        text = ""
        for line in server.stdout:
            text += line
            if line.startswith("}"):
                break
        server.send_signal(signal.SIGINT)
        server.communicate(timeout=60)
        jsonschema.Draft202012Validator(schema("serve")).validate(json.loads(text))
        self.answered.add("serve")

    def test_errors(self):
        (self.folder / "unplugged.toml").write_text(
            rig_text("plate").replace(
                '[devices.turntable]\ndriver = "simulated"',
                '[devices.turntable]\ndriver = "grbl"\nport = "/dev/nothing-there"',
            )
        )
        for code, kind, arguments in [
            (2, "usage", ["fly"]),
            (2, "usage", ["reconstruct", "--no-such"]),
            (3, "input", ["reconstruct", "nowhere", "-o", "a.ply"]),
            (3, "file", ["reconstruct", "scan", "-o", "nowhere/a.ply"]),
            (4, "device", ["scan", "unplugged.toml", "-o", "nothing"]),
        ]:
            done = subprocess.run(
                [PROGRAM, "--json", *arguments],
                cwd=self.folder,
                capture_output=True,
                text=True,
                env={"PATH": "/nonexistent"},
            )
            self.assertEqual(done.returncode, code, done.stderr)
            error = json.loads(done.stdout)
            jsonschema.Draft202012Validator(schema("error")).validate(error)
            self.assertEqual((error["error"]["kind"], error["error"]["exit_code"]), (kind, code))


class Schemas(unittest.TestCase):
    def test_are_those_of_the_verbs(self):
        names = sorted(path.name.removesuffix(".schema.json") for path in SCHEMAS.glob("*.schema.json"))
        self.assertEqual(names, sorted(verbs() + ["error"]))

    def test_are_schemas_that_describe_every_property(self):
        def visit(node, where):
            if isinstance(node, list):
                for item in node:
                    visit(item, where)
            if not isinstance(node, dict):
                return
            for name, property in node.get("properties", {}).items():
                self.assertTrue(
                    property is False or "description" in property or "$ref" in property, f"{where}: {name}"
                )
            if "properties" in node:
                self.assertIn("additionalProperties", node, where)
            for value in node.values():
                visit(value, where)

        for path in SCHEMAS.glob("*.schema.json"):
            parsed = json.loads(path.read_text())
            jsonschema.Draft202012Validator.check_schema(parsed)
            visit(parsed, path.name)

    def test_refuse_an_answer_with_another_key(self):
        validator = jsonschema.Draft202012Validator(schema("error"))
        good = {"error": {"message": "a", "exit_code": 3, "kind": "input"}}
        self.assertTrue(validator.is_valid(good))
        good["error"]["more"] = 1
        self.assertFalse(validator.is_valid(good))


class Coverage(unittest.TestCase):
    def test_every_verb_was_asked(self):  # runs last
        self.assertEqual(Answers.answered | {"demo"}, set(verbs()))


if __name__ == "__main__":
    suite = unittest.TestSuite(
        unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in (Answers, Schemas, Coverage)
    )
    sys.exit(not unittest.TextTestRunner().run(suite).wasSuccessful())
