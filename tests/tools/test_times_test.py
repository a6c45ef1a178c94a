"""The times that `./run test` prints: test_times_test.py SOURCE_DIR BUILD_DIR"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "tools"))
import test_times  # noqa: E402

RESULTS = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="x" tests="4" failures="1" disabled="0" skipped="1">
  <testcase name="phase.A.B" classname="phase.A.B" time="1.5" status="run"><system-out>[NON-XML-CHAR-0x1B]</system-out></testcase>
  <testcase name="phase.A.C" classname="phase.A.C" time="0.25" status="fail"><failure message=""/></testcase>
  <testcase name="rig.D.E" classname="rig.D.E" time="4" status="run"/>
  <testcase name="app.story" classname="app.story" time="0.125" status="notrun"><skipped message=""/></testcase>
</testsuite>
"""


class Times(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.results = self.folder / "tests.xml"
        self.results.write_text(RESULTS)

    def run_tool(self, *arguments):
        return subprocess.run(
            [sys.executable, SOURCE / "tools/test_times.py", *arguments], capture_output=True, text=True, check=True
        ).stdout

    def test_the_slowest_the_modules_and_the_count_are_printed(self):
        lines = self.run_tool(self.results).splitlines()
        self.assertEqual([line.split()[-1] for line in lines[1:5]], ["rig.D.E", "phase.A.B", "phase.A.C", "app.story"])
        self.assertIn("     1.8 s  phase (2 tests)", lines)
        self.assertIn("     5.9 s  in all", lines)
        self.assertIn("  phase.A.C", lines[lines.index("failed:") :])
        self.assertEqual(lines[-1], "2 passed, 1 failed, 1 skipped")

    def test_ten_tests_are_printed_and_several_files_are_added(self):
        cases = "".join(f'<testcase name="rig.D.T{i}" time="{i}" status="run"/>' for i in range(12))
        (self.folder / "more.xml").write_text(f"<testsuite>{cases}</testsuite>")
        lines = self.run_tool(self.results, self.folder / "more.xml").splitlines()
        self.assertEqual(lines.index("") - 1, 10)
        self.assertEqual(lines[-1], "14 passed, 1 failed, 1 skipped")

    def test_the_table_is_written_between_its_markers_and_the_rest_stays(self):
        page = self.folder / "coverage.md"
        page.write_text("# Coverage\n\n| a | b |\n")
        for _ in range(2):  # the second time it is replaced
            self.run_tool(self.results, "--page", page)
            text = page.read_text()
            self.assertTrue(text.startswith("# Coverage\n\n| a | b |\n"))
            self.assertEqual(text.count("| phase | 2 | 1.8 |"), 1)
            self.assertEqual(text.count(test_times.BEGIN), 1)
            self.assertIn("| all | 4 | 6 |", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
