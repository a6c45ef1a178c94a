"""The example script scans, reconstructs, edits and exports through a running server.

    script_test.py PROGRAM examples/serve.py
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

from serve_client import PATIENCE, Server

EXAMPLE = pathlib.Path(sys.argv[2]).resolve()


class Script(unittest.TestCase):
    def test_the_example_exports_what_another_program_reads(self):
        with tempfile.TemporaryDirectory() as folder:
            server = Server(folder)
            try:
                text = EXAMPLE.read_text()
                self.assertIn("stations=6", text)
                example = pathlib.Path(folder) / "serve.py"
                example.write_text(text.replace("stations=6", "stations=3"))
                done = subprocess.run(
                    [sys.executable, example],
                    cwd=folder,
                    env=server.environment,
                    capture_output=True,
                    text=True,
                    timeout=4 * PATIENCE,
                )
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn("wrote part.dxf", done.stdout)
            finally:
                self.assertEqual(server.stop(), 0)
            text = (pathlib.Path(folder) / "part.dxf").read_text()
            faces = text.count("\n3DFACE\n")
            self.assertGreater(faces, 10_000)
            try:
                import ezdxf
            except ImportError:
                self.skipTest("ezdxf is not installed, so that only the faces of the DXF were counted")
            document = ezdxf.readfile(pathlib.Path(folder) / "part.dxf")
            self.assertEqual(document.audit().errors, [])
            self.assertEqual(len(document.modelspace().query("3DFACE")), faces)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
