"""Tests tools/figures on a small tree with sections of its own: figures_test.py PROGRAM SOURCE_DIR.

The tree holds copies of the tool, sources that stand for those of the program, and a repository of git; the program is the
real one, and the tool runs as `./run figures` runs it.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(sys.argv[2]).resolve()
sys.path.append(str(SOURCE / "tools"))

from half_rig import halved  # noqa: E402

TABLE = """
from inputs import Inputs

SECTIONS = {
    "toy": Inputs("simulate", case_s=3),
    "other": Inputs("simulate", modules="core", files="notes.txt", case_s=3),
    "broken": Inputs("simulate"),
}
"""

TOY = '''"""A toy.

It measures the views of scans.
"""
import os
import signal

from study import ROOT

TITLE = "Views"
PAGE = "page.md"
CASES = {"plate": 3, "groove": 3}
PART = 2


def measure(study, case, seed):
    if os.environ.get("TOY_STOPS_AT") == f"{case} {seed}":
        os.kill(os.getpid(), signal.SIGKILL)
    scan = study.simulated(case, "--rig", ROOT / "rig.toml", "--views", 2, "--seed", seed)
    return {"views": len(list((scan / "views").iterdir()))}


def report(text, results):
    text.table("part", "seeds", "views")
    for part, found in results.items():
        text.row(part, len(found), sum(one["views"] for one in found))
'''

OTHER = '''"""Shares a scan with the toy: the same options in another order."""
from study import ROOT

TITLE = "Shared"
PAGE = "page.md"


def measure(study, case, seed):
    return study.simulated("plate", "--seed", 1, "--views", "2", "--rig", ROOT / "rig.toml").name


def report(text, results):
    text.add(results["other"][0])
'''

BROKEN = '''"""Runs a verb that the table does not state."""
TITLE = "Broken"
PAGE = "page.md"


def measure(study, case, seed):
    return study.run("algorithms")
'''

CMAKE = """frangia_module(core)
frangia_module(rig USES core)
frangia_module(mesh USES core)
frangia_module(simulate USES core rig)
"""


class Tree(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="frangia-figures-"))
        self.addCleanup(shutil.rmtree, self.root)
        shutil.copytree(
            SOURCE / "tools" / "figures",
            self.root / "tools" / "figures",
            ignore=shutil.ignore_patterns("sections", "table.py", "record.json", "__pycache__"),
        )
        for script in ("module_statement.py", "half_rig.py"):
            shutil.copy(SOURCE / "tools" / script, self.root / "tools")
        self.write("tools/figures/table.py", TABLE)
        self.write("tools/figures/sections/toy.py", TOY)
        self.write("tools/figures/sections/other.py", OTHER)
        self.write("tools/figures/sections/broken.py", BROKEN)
        self.write("CMakeLists.txt", CMAKE)
        for module in ("core", "rig", "mesh", "simulate"):
            self.write(f"src/frangia/{module}/internal/{module}.cpp", module)
        self.write(
            "apps/frangia/simulate_verb.cpp", '#include "simulate_options.h"\n#include "frangia/simulate/simulate.h"\n'
        )
        self.write("apps/frangia/simulate_options.h", "")
        self.write("apps/frangia/simulate_options.cpp", "")
        self.write("apps/frangia/edit_verb.cpp", "")
        self.write("notes.txt", "")
        self.write("docs/page.md", "# Page\n")
        rig = (SOURCE / "examples" / "python" / "small-rig.toml").read_text()
        self.write("rig.toml", halved(halved(rig)))
        self.write(".gitignore", "/out/\n__pycache__\n")
        self.git("init", "-q")
        self.commit("Begin")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def append(self, name, text):
        self.write(name, (self.root / name).read_text() + text)

    def git(self, *arguments):
        return subprocess.run(
            ["git", "-c", "user.name=t", "-c", "user.email=t@t", *arguments],
            cwd=self.root,
            check=True,
            capture_output=True,
            text=True,
        ).stdout.strip()

    def commit(self, message):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", message)
        return self.git("rev-parse", "--short=8", "HEAD")

    def figures(self, *words, code=0, **environment):
        done = subprocess.run(
            [sys.executable, self.root / "tools" / "figures", PROGRAM, *words],
            capture_output=True,
            text=True,
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment},
        )
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def cards(self):
        return {card.stem: json.loads(card.read_text()) for card in (self.root / "out/figures/scans").glob("*.json")}

    def page(self):
        return (self.root / "docs/page.md").read_text()

    def changed(self, *options):
        return self.figures("changed", "--names", *options).split()


class Scans(Tree):
    def test_sections_share_a_scan_of_the_same_arguments_in_any_order(self):
        self.figures("toy")
        cards = self.cards()
        self.assertEqual(len(cards), 4)
        self.figures("other")
        self.assertEqual(self.cards().keys(), cards.keys())
        self.assertEqual(sum(name in self.page() for name in cards), 1)  # `other` states the name of its scan

    def test_another_rig_or_source_of_the_renderer_is_another_scan(self):
        self.figures("other")
        first = set(self.cards())
        self.append("rig.toml", "# other bytes at the same path\n")
        self.figures("other", "--again")
        second = set(self.cards())
        self.assertEqual(len(second), 2)
        self.assertLess(first, second)
        self.append("src/frangia/mesh/internal/mesh.cpp", "// the renderer does not use it\n")
        self.figures("other", "--again")
        self.assertEqual(set(self.cards()), second)

    def test_scans_by_other_sources_are_removed(self):
        self.figures("other")
        old = set(self.cards())
        self.append("src/frangia/rig/internal/rig.cpp", "// the renderer uses it\n")
        self.figures("other")
        self.assertEqual(len(self.cards()), 1)
        self.assertTrue(old.isdisjoint(self.cards()))
        self.assertEqual({path.stem for path in (self.root / "out/figures/scans").iterdir()}, set(self.cards()))

    def test_the_scans_used_longest_ago_make_room_but_none_that_is_in_use(self):
        self.figures("toy")
        oldest, *others = sorted(
            self.cards(), key=lambda key: (self.root / f"out/figures/scans/{key}.json").stat().st_mtime
        )
        self.assertEqual(len(others), 3)
        lines = f"""
import sys
sys.path[:0] = [{str(self.root / 'tools/figures')!r}]
from scans import Scans
scans = Scans({str(PROGRAM)!r})
scans.in_use.add({others[0]!r})
scans.make_room({sum(card['bytes'] for card in self.cards().values()) - 1})
print(sorted(card.stem for card in __import__('scans').KEPT.glob('*.json')))
scans.make_room(0)
"""
        done = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), str(sorted(others)))
        self.assertEqual(list(self.cards()), [others[0]])


class Measurements(Tree):
    def test_an_interrupted_measurement_goes_on_where_it_was(self):
        self.assertIn("4 of 4 cases are to be measured", self.figures("toy", code=-9, TOY_STOPS_AT="groove 1"))
        self.assertNotIn("Views", self.page())
        (results,) = (self.root / "out/figures/cases/toy").iterdir()
        with results.open("a") as file:
            file.write('["groove", 1, 0.5, {"vi')  # as a power cut leaves a line
        said = self.figures("toy")
        self.assertIn("2 of 4 cases are to be measured", said)
        self.assertEqual(re.findall(r"of 2: (\w+), seed (\d)", said), [("groove", "1"), ("groove", "2")])
        self.assertIn("| plate | 2 | 4 |\n| groove | 2 | 4 |", self.page())
        self.assertIn("0 of 4 cases are to be measured", self.figures("toy"))
        self.assertIn("4 of 4 cases are to be measured", self.figures("toy", "--again"))

    def test_the_page_states_command_and_revision_and_keeps_the_last_full_measurement(self):
        first = self.git("rev-parse", "--short=8", "HEAD")
        self.assertIn("6 of 6 cases are to be measured, about 18 s", self.figures("toy", "--full"))
        self.assertIn(
            f"| plate | 3 | 6 |\n| groove | 3 | 6 |\n\nMeasured by `./run figures toy --full`, 6 of 6 cases, at revision {first}.\n",
            self.page(),
        )
        self.append("src/frangia/core/internal/core.cpp", "// new\n")
        self.assertEqual(self.changed(), ["toy", "other", "broken"])
        second = self.commit("Change the core")
        self.figures("toy")
        part, full = self.page().split("### Views: the last full measurement\n")
        self.assertIn(
            f"| plate | 2 | 4 |\n| groove | 2 | 4 |\n\nMeasured by `./run figures toy`, 4 of 6 cases, at revision {second}.",
            part,
        )
        self.assertIn(
            f"| plate | 3 | 6 |\n| groove | 3 | 6 |\n\nMeasured by `./run figures toy --full`, 6 of 6 cases, at revision {first}.",
            full,
        )
        self.figures("toy")  # once more: it stays
        self.assertEqual(self.page().count(f"at revision {first}"), 1)
        self.assertIn("2 of 6 cases are to be measured", self.figures("toy", "--full"))  # it takes the part's results
        self.assertEqual(self.page().count("Measured by"), 1)
        self.assertIn(f"`./run figures toy --full`, 6 of 6 cases, at revision {second}.", self.page())
        page = self.page()
        self.figures("toy")  # all cases are known, so the page stays that of the full measurement
        self.assertEqual(self.page(), page)
        self.append("notes.txt", "not committed")
        self.figures("toy", "--full")
        self.assertIn(f"at revision {second} with changes.", self.page())

    def test_changed_is_what_depends_on_a_change(self):
        self.figures("toy", "--full")
        self.figures("other")
        self.assertEqual(self.changed(), ["broken"])  # never measured
        for name, expected in (
            ("src/frangia/mesh/internal/mesh.cpp", []),
            ("apps/frangia/edit_verb.cpp", []),
            ("docs/page.md", []),
            ("notes.txt", ["other"]),
            ("tools/figures/sections/toy.py", ["toy"]),
            ("tools/half_rig.py", ["toy", "other"]),
            ("src/frangia/rig/internal/rig.cpp", ["toy", "other"]),
            ("apps/frangia/simulate_options.cpp", ["toy", "other"]),
        ):
            before = (self.root / name).read_text()
            self.append(name, "\n")
            self.assertEqual(self.changed(), expected + ["broken"], name)
            self.write(name, before)
        self.append("tools/figures/sections/toy.py", "\n")
        self.figures("toy")  # its part
        self.assertEqual(self.changed(), ["broken"])
        self.assertEqual(self.changed("--full"), ["toy", "broken"])

    def test_list_states_times_and_revisions(self):
        self.assertRegex(self.figures("list"), r"(?m)^toy +12 s +18 s +never +never +changed$")
        record = self.root / "tools/figures/record.json"
        self.figures("toy")
        at = self.git("rev-parse", "--short=8", "HEAD")
        entry = json.loads(record.read_text())
        self.assertEqual((entry["toy"]["part"]["cases"], list(entry["toy"])), (4, ["part"]))
        entry["toy"]["part"]["seconds"] = 4000
        record.write_text(json.dumps(entry))
        listed = self.figures("list")
        self.assertRegex(listed, rf"(?m)^toy +67 min +1\.7 h +{at} +never$")
        self.assertRegex(listed, r"(?m)^other +3 s +never +never +changed$")
        self.assertIn("about 67 min", self.figures("toy", "--again"))

    def test_bad_input_is_answered_in_a_sentence(self):
        for words, answer in (
            (["nosuch"], "there is no section 'nosuch'; the sections are toy, other, broken"),
            (["--ful"], "there is no option '--ful'"),
            (["broken"], "section broken runs `frangia algorithms`: state it in tools/figures/table.py"),
        ):
            said = self.figures(*words, code=1)
            self.assertIn(answer, said)
            self.assertNotIn("Traceback", said)


class Sections(unittest.TestCase):
    """The sections of this repository."""

    @classmethod
    def setUpClass(cls):
        sys.path[:0] = [str(SOURCE / "tools" / "figures"), str(SOURCE / "tools")]

    def test_the_table_names_every_section_and_what_exists(self):
        import inputs
        import table

        self.assertEqual(set(table.SECTIONS), {path.stem for path in (SOURCE / "tools/figures/sections").glob("*.py")})
        for name, section in table.SECTIONS.items():
            self.assertRegex(inputs.inputs_checksum(name, section), "^[0-9a-f]{16}$")

    def test_sections_run_the_verbs_that_the_table_states(self):
        import inputs
        import table

        for name, section in table.SECTIONS.items():
            own = [
                path
                for path in inputs.scripts_of(name)
                if path.name != "study.py" and (path.parent.name != "sections" or path.stem == name)
            ]
            text = "".join(path.read_text() for path in own)
            run = set(re.findall(r'\b(?:run|process)\((?:"--\w+", )*"(\w+)"', text))
            run |= {
                verb
                for call, verb in (
                    ("simulated(", "simulate"),
                    ("digital(", "simulate"),
                    ("half_rig", "simulate"),
                    ("captured(", "scan"),
                    ("reconstructed(", "reconstruct"),
                    ("inspected(", "inspect"),
                )
                if f"study.{call}" in text
            }
            self.assertEqual(run - set(section.verbs.split()), set(), name)

    def test_scans_are_made_by_one_function(self):
        for path in [*(SOURCE / "tools/figures/sections").glob("*.py"), *(SOURCE / "tools/figures").glob("*.py")]:
            if path.name not in ("study.py", "table.py"):
                self.assertNotIn('"simulate"', path.read_text(), path.name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
