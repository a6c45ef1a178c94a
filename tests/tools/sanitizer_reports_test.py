#!/usr/bin/env python3
"""A report of a sanitizer is a fault of a mutated input, also where the program ends as it does after a refusal, and where a
process that it started made the report."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

os.environ["FRANGIA_SLOWDOWN"] = "4"  # as with sanitizers: no limit of memory
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
import mutate_inputs  # noqa: E402

OVERRUN = """
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
static int frangia_overrun(int n) { char *p = malloc(3); p[n + 3] = 1; int found = p[n]; free(p); return found; }
static int of_others(int n) { char *p = malloc(3); p[n + 3] = 1; int found = p[n]; free(p); return found; }
int main(int n, char **words) {
  int status = 0;
  if (n == 1) return frangia_overrun(n) & 0;
  if (words[1][0] == 'r') return 1;
  if (fork() == 0) {
    close(1);
    close(2);
    _exit(words[1][0] == 'c' ? frangia_overrun(n) & 0 : of_others(n) & 0);
  }
  wait(&status);
  return 1;
}
"""


class SanitizerReports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        compiler = shutil.which("gcc") or shutil.which("clang")
        if not compiler:
            raise unittest.SkipTest("needs gcc or clang")
        cls.folder = tempfile.TemporaryDirectory(prefix="frangia-reports-test-")
        cls.program = pathlib.Path(cls.folder.name) / "overrun"
        source = cls.program.with_suffix(".c")
        source.write_text(OVERRUN)
        built = subprocess.run(
            [compiler, "-g", "-w", "-fsanitize=address", source, "-o", cls.program], capture_output=True
        )
        if built.returncode:
            raise unittest.SkipTest("needs the address sanitizer")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def fault(self, *words):
        return mutate_inputs.fault_of(self.program, words, self.folder.name)

    def test_of_the_program_is_a_crash_and_not_a_refusal(self):
        what, output = self.fault()
        self.assertEqual(what, "ended by SIGABRT")
        self.assertIn(b"heap-buffer-overflow", output)

    def test_of_a_process_that_it_started_is_a_fault_where_the_code_is_ours(self):
        what, output = self.fault("child")
        self.assertEqual(what, "a sanitizer reports a process that it started")
        self.assertIn(b"frangia_overrun", output)

    def test_of_a_library_in_a_process_of_its_own_is_none(self):
        self.assertIsNone(self.fault("library")[0])

    def test_is_none_for_a_refusal(self):
        self.assertIsNone(self.fault("refused")[0])


if __name__ == "__main__":
    unittest.main()
