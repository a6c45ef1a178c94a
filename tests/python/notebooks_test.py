"""Executes notebooks of examples/python: each ends without an error and draws a picture.

    notebooks_test.py [--keep] [NAME.ipynb...]
"""
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
NAMES = [argument for argument in sys.argv[1:] if argument != "--keep"]
NOTEBOOKS = [FOLDER / name for name in NAMES] or sorted(FOLDER.glob("*.ipynb"))


class Notebooks(unittest.TestCase):
    def test_each_runs_and_draws(self):
        self.assertTrue(NOTEBOOKS)
        for path in NOTEBOOKS:
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
    unittest.main(argv=sys.argv[:1])
