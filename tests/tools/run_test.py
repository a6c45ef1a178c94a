"""What `./run build` answers where it cannot build: run_test.py SOURCE_DIR"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

RUN = pathlib.Path(sys.argv.pop()) / "run"
TOOLS = "cat dirname env grep realpath sed sh tr true".split()


class Build(unittest.TestCase):
    """In a folder that holds `run` alone, with stand-ins for the programs that install and build."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        self.bin = self.root / "bin"
        self.bin.mkdir()
        for name in TOOLS:
            (self.bin / name).symlink_to(shutil.which(name))
        self.program("id", "echo 0")
        self.program("dpkg-query", "echo installed")
        for name in ("node", "npm", "apt-cache", "apt-get", "cmake"):
            self.program(name, "true")
        self.clone = self.folder("clone")

    def program(self, name, script):
        (self.bin / name).write_text(f"#!/bin/sh\n{script}\n")
        (self.bin / name).chmod(0o755)

    def folder(self, name):
        clone = self.root / name
        clone.mkdir()
        shutil.copy(RUN, clone)
        return clone

    def cache(self, source, generator="Ninja"):
        tree = self.clone / "build" / "release"
        tree.mkdir(parents=True)
        lines = f"CMAKE_HOME_DIRECTORY:INTERNAL={source}\nCMAKE_GENERATOR:INTERNAL={generator}\n"
        (tree / "CMakeCache.txt").write_text(lines)

    def answer(self, clone=None):
        done = subprocess.run(
            ["sh", "./run", "build"],
            cwd=clone or self.clone,
            env={"PATH": str(self.bin)},
            capture_output=True,
            text=True,
        )
        return done.returncode, [line for line in done.stderr.splitlines() if not line.startswith("==> ") and line]

    def test_goes_through_where_nothing_is_wrong(self):
        self.cache(self.clone)
        self.assertEqual(self.answer(), (0, []))

    def test_refuses_a_path_with_blanks(self):
        code, lines = self.answer(self.folder("my clone"))
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertRegex(lines[0], r"^run: the path '.*/my clone' has blanks, .*; move or clone the repository")

    def test_refuses_the_build_folder_of_another_clone(self):
        self.cache("/somewhere/else")
        code, lines = self.answer()
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertRegex(
            lines[0], r"^run: build/release was made for /somewhere/else, not for .*: rm -r build/release$"
        )

    def test_refuses_the_build_folder_of_another_generator(self):
        self.cache(self.clone, "Unix Makefiles")
        code, lines = self.answer()
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertIn("build/release was made for Unix Makefiles, not for Ninja; delete it", lines[0])

    def test_says_which_packages_root_must_install(self):
        self.program("id", "echo 1000")
        self.program("dpkg-query", "exit 1")
        code, lines = self.answer()
        self.assertEqual(code, 1)
        self.assertRegex(lines[0], "^run: this needs packages that only root can install; become root, or install sudo")
        self.assertIn("apt-get install -y --no-install-recommends g++", lines[-1])

    def test_says_that_apt_get_needs_the_network(self):
        self.program("dpkg-query", "exit 1")
        self.program("apt-get", "exit 100")
        code, lines = self.answer()
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertRegex(
            lines[0], "^run: apt-get cannot fetch its lists, .*; this needs the network, or these packages: g"
        )

    def test_says_that_npm_needs_the_network(self):
        self.cache(self.clone)
        self.program("cmake", 'case "$*" in *web/installed*) exit 1 ;; esac')
        code, lines = self.answer()
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertRegex(lines[0], r"^run: npm cannot install the packages of the app, see build/release/npm\.log")
        self.assertIn("cmake --preset release -DFRANGIA_APP=OFF", lines[0])


if __name__ == "__main__":
    unittest.main()
