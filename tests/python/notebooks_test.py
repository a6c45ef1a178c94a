"""Executes the notebooks of examples/python: each ends without an error and draws a picture."""
import pathlib
import sys
import unittest

try:
    import nbformat
    from nbclient import NotebookClient
except ImportError as error:
    print(f"{error}; install python3-nbconvert")
    sys.exit(77)

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "python"


class Notebooks(unittest.TestCase):
    def test_each_runs_and_draws(self):
        paths = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual(len(paths), 5)
        for path in paths:
            with self.subTest(path.name):
                notebook = nbformat.read(path, 4)
                NotebookClient(
                    notebook, timeout=120, record_timing=False, resources={"metadata": {"path": FOLDER}}
                ).execute()
                outputs = [o for cell in notebook.cells if cell.cell_type == "code" for o in cell.outputs]
                self.assertFalse([o for o in outputs if o.get("name") == "stderr" and "Warning" in o.text], path.name)
                self.assertTrue([o for o in outputs if "image/png" in o.get("data", {})], path.name)
                if "--keep" in sys.argv:
                    nbformat.write(notebook, path)


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--keep"])
