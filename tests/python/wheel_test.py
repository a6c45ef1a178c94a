"""Builds wheel and source distribution from a build tree, installs the wheel in a new venv without network, and uses it:
wheel_test.py SOURCE_DIR BUILD_DIR"""
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest
import venv

SOURCE, TREE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "tools" / "package"))
os.environ["FRANGIA_BUILD_DIR"] = str(TREE)
import pip_backend  # noqa: E402


class Pip(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def test_the_wheel_installs_and_works_in_a_new_venv(self):
        name = pip_backend.build_wheel(self.folder)
        self.assertRegex(name, r"^frangia-[\d.]+-cp3\d+-cp3\d+-linux_\w+\.whl$")
        home = self.folder / "venv"
        venv.create(home, system_site_packages=True)
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        environment["PATH"] = f"{home / 'bin'}:{os.environ['PATH']}"

        def run(*command):
            return subprocess.run(
                command, env=environment, cwd=self.folder, capture_output=True, text=True, check=True
            ).stdout

        run(
            home / "bin" / "python3",
            "-m",
            "pip",
            "install",
            "--no-index",
            "--no-deps",
            "--ignore-installed",
            self.folder / name,
        )
        program = home / "bin" / "frangia"
        self.assertEqual(run(program, "--version").strip(), pip_backend.version())
        self.assertIn("serve", run(program, "--help"))
        run(
            program,
            "--quiet",
            "simulate",
            "plate",
            "--views",
            "1",
            "--rig",
            SOURCE / "tests/data/small-interferometer.toml",
            "-o",
            "scan",
        )
        shown = run(
            home / "bin" / "python3",
            "-c",
            "import frangia; print(frangia.__file__); "
            "print(frangia.decode(frangia.read_scan('scan'), 0).phase.phase.shape)",
        )
        self.assertTrue(shown.startswith(str(home)), shown)
        about = run(home / "bin" / "python3", "-m", "pip", "show", "--files", "frangia")
        self.assertRegex(about, r"bin/frangia")
        if (TREE / "lib" / "frangia").is_dir():  # what reads CAD files
            self.assertTrue((home / "lib" / "frangia" / "frangia_cad.so").exists(), about)
        self.assertNotEqual(
            re.findall(
                r"Requires-External: libembree",
                pip_backend.metadata(pip_backend.libraries_of([TREE / "bin" / "frangia"])).decode(),
            ),
            [],
        )

    def test_the_source_distribution_holds_the_sources_and_the_front_end(self):
        name = pip_backend.build_sdist(self.folder)
        with tarfile.open(self.folder / name) as archive:
            files = set(archive.getnames())
        top = f"frangia-{pip_backend.version()}"
        wanted = ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "web-dist/index.html", "python/bindings/module.cpp")
        self.assertEqual([name for name in wanted if f"{top}/{name}" not in files], [])
        self.assertFalse(any("/build/" in file or "/.git/" in file for file in files))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
