"""What `import frangia` says where the wrong Python does it: interpreter_test.py SOURCE_DIR"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv.pop()) / "python" / "frangia"


class Import(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        shutil.copytree(SOURCES, self.path / "frangia", ignore=shutil.ignore_patterns("*.so", "__pycache__"))

    def last_line(self, *options):
        script = f"import sys; sys.path.insert(0, {str(self.path)!r}); import frangia"
        done = subprocess.run([sys.executable, *options, "-c", script], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("During handling", done.stderr)
        return done.stderr.splitlines()[-1]

    def compiled_for(self, minor):
        (self.path / "frangia" / f"_frangia.cpython-3{minor}-x86_64-linux-gnu.so").write_bytes(b"")

    def test_without_a_build(self):
        self.assertRegex(
            self.last_line(), r"^ImportError: .*/frangia holds no compiled module; build it: \./run build$"
        )

    def test_of_another_version(self):
        self.compiled_for(99)
        line = self.last_line()
        self.assertIn("frangia was compiled for Python 3.99, and this is", line)
        self.assertIn("use Debian's interpreter: /usr/bin/python3", line)

    def test_without_numpy(self):
        self.compiled_for(sys.version_info.minor)
        self.assertIn("frangia needs NumPy, which", self.last_line("-I", "-S"))

    def test_with_a_damaged_module(self):
        self.compiled_for(sys.version_info.minor)
        self.assertIn("frangia cannot be loaded by", self.last_line())


if __name__ == "__main__":
    unittest.main()
