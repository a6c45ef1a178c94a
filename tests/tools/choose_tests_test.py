"""Which tests `./run test` chooses: choose_tests_test.py SOURCE_DIR BUILD_DIR"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE, TREE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "tools"))
import choose_tests  # noqa: E402


def project(folder):
    """A repository with three modules, of which `c` uses `b` and `b` uses `a`, and tests that read what they share."""
    files = {
        "CMakeLists.txt": "frangia_module(a LIBS x)\nfrangia_module(b USES a PRIVATE_LIBS y)\nfrangia_module(c USES b)\nfrangia_module(d)\n",
        "tests/a/one_test.cpp": '#include "support/plain.h"\n',
        "tests/b/two_test.cpp": '#include "support/wraps.h"\n',
        "tests/c/three_test.cpp": 'read("data/rig.toml");\n',
        "tests/apps/four_test.cpp": "",
        "tests/app/five.mjs": "",
        "tests/support/plain.h": "",
        "tests/support/wraps.h": '#include "support/plain.h"\n',
        "tests/data/rig.toml": "",
        "tests/chain_tests.txt": "# chain\na.One\nc.Three.Holds\napps.Four\napp.five\n",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


class Choice(unittest.TestCase):
    def setUp(self):
        self.root = project(pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())))

    def changed(self, *paths):
        return choose_tests.choose_changed(self.root, paths)

    def test_a_module_runs_in_full_and_the_chain_of_what_depends_on_it(self):
        full, chain = self.changed("src/frangia/b/x.cpp")
        self.assertEqual(full, ["b"])
        self.assertEqual(chain, ["app", "apps", "c"])
        self.assertEqual(self.changed("src/frangia/a/internal/x.h"), (["a"], ["app", "apps", "c"]))
        self.assertEqual(self.changed("src/frangia/d/x.cpp"), ([], ["app", "apps"]))
        self.assertEqual(self.changed("apps/frangia/main.cpp"), (["apps"], ["app"]))

    def test_a_test_alone_runs_its_module_alone(self):
        self.assertEqual(self.changed("tests/b/two_test.cpp"), (["b"], []))
        self.assertEqual(self.changed("tests/app/five.mjs", "web/src/app.ts"), (["app"], []))
        self.assertEqual(self.changed("tests/install_test.sh", "run"), (["tools"], []))

    def test_what_tests_share_runs_those_that_read_it(self):
        self.assertEqual(self.changed("tests/support/plain.h"), (["a", "b"], []))
        self.assertEqual(self.changed("tests/support/wraps.h"), (["b"], []))
        self.assertEqual(self.changed("tests/data/rig.toml"), (["c"], []))

    def test_the_build_runs_every_chain(self):
        for path in ("CMakeLists.txt", "cmake/x.cmake", "tests/CMakeLists.txt", "examples/rig.toml"):
            full, chain = self.changed(path)
            self.assertEqual(full, [], path)
            self.assertEqual(chain, ["a", "app", "apps", "c"], path)

    def test_what_no_test_reads_runs_nothing(self):
        self.assertEqual(self.changed("CHANGELOG.md", "benchmarks/large_rig.toml"), ([], []))
        self.assertEqual(self.changed(), ([], []))

    def test_names_are_modules_scripts_and_programs(self):
        self.assertEqual(choose_tests.choose_named(self.root, ["test_b", "python", "b"]), ["b", "python"])
        with self.assertRaisesRegex(ValueError, "no test 'nosuch'; the tests are a, app, apps, b, c, docs"):
            choose_tests.choose_named(self.root, ["a", "nosuch"])


class Repository(unittest.TestCase):
    def test_an_unknown_name_is_one_sentence_with_the_known_ones(self):
        for words in (["nosuch"], ["--stress", "nosuch"]):
            done = subprocess.run([SOURCE / "run", "test", *words], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertRegex(done.stderr, r"^run: there is no test 'nosuch'; the tests are .*phase, .*\n$")

    def test_every_group_and_every_test_of_the_chain_exists(self):
        listed = json.loads(
            subprocess.run(
                ["ctest", "--show-only=json-v1"], cwd=TREE, capture_output=True, text=True, check=True
            ).stdout
        )
        labels = {
            test["name"]: next((one["value"] for one in test["properties"] if one["name"] == "LABELS"), [])
            for test in listed["tests"]
        }
        unbuilt = {name.removeprefix("test_").split("_NOT_BUILT")[0] for name in labels if "_NOT_BUILT" in name}
        groups = {name.split(".")[0] for name in labels if "_NOT_BUILT" not in name} | unbuilt
        self.assertEqual(groups - set(choose_tests.groups_of(SOURCE)), set())
        chain = [
            line for line in (SOURCE / "tests" / "chain_tests.txt").read_text().splitlines() if not line.startswith("#")
        ]
        self.assertGreater(len(chain), 3)
        for name in chain:
            if name.split(".")[0] not in unbuilt:
                self.assertIn("chain", labels.get(name, ["there is no such test"]), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
