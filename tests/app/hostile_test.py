"""Hostile values in every field that names something or holds a number, against `frangia serve`.

    hostile_test.py PROGRAM SCHEMA.json
"""
import contextlib
import json
import os
import pathlib
import re
import sys
import unittest
import urllib.parse

from hostile_server import HostileServer

SCHEMA = json.loads(pathlib.Path(sys.argv[2]).read_text())

# What a field that names something may receive. None of them may reach another file.
NAMES = [
    "",
    ".",
    "..",
    "../evil",
    "../../evil",
    "a/../../evil",
    "/tmp/evil",
    "//evil",
    "..\\evil",
    "C:\\evil",
    "\\\\host\\evil",
    "%2e%2e",
    "%2e%2e%2fevil",
    "..%2fevil",
    "%252e%252e%252fevil",
    "%c0%ae%c0%ae%c0%afevil",
    "a\u0000b",
    "../evil\u0000.dxf",
    "x" * 61,
    "x" * 5000,
    "\u00fc" * 100,
    "\uff0e\uff0e\uff0fevil",
    "\u2025/evil",
    "\u202efxd.live",
    "\U0001f5ff",
    "\ud800",
    "e\u0301vil",
    "-rf",
    "--help",
    " evil",
    "evil ",
    "\tevil",
    "a\nb",
    "\r\nSet-Cookie: evil=1",
    "\x7f",
    "~",
    "~root",
    "$HOME",
    "$(id)",
    "`id`",
    "; id",
    "a|id",
    "file:///etc/passwd",
    ".frangia-lock",
    ".git",
    "CON",
    "secret.txt",
    "<b>evil</b>",
    "{}",
    "null",
]
REFUSED = (400, 404)


def percent_forms(name):
    """A name as it may stand in a path: encoded as a whole, and as it is where HTTP admits that."""
    with contextlib.suppress(UnicodeEncodeError):
        yield urllib.parse.quote(name, safe="")
        yield urllib.parse.quote(name, safe="/\\.%~$")
        yield urllib.parse.quote(urllib.parse.quote(name, safe=""), safe="")


# Names of something new, which one function checks and create-project is tried with; and what nobody takes for a name.
FREE = {
    ("create-project", "name"),
    ("rename-project", "to"),
    ("duplicate-project", "copy"),
    ("keep-rig", "name"),
    ("set-notes", "text"),
    ("next-part", "name"),
}


class Hostile(HostileServer):
    def test_names_of_projects_stay_in_their_folder(self):
        outside = self.around()
        made = 0
        for name in NAMES:
            before = set(self.server.projects.iterdir())
            status, _, body = self.server.ask("POST", "/api/commands/create-project", {"name": name, "part": "plate"})
            self.assertIn(status, (200, 400), name)
            added = set(self.server.projects.iterdir()) - before
            if status == 200:
                # A name may look odd; it is the name of one folder in the folder of the projects, letter by letter.
                self.assertEqual([path.name for path in added], [name])
                made += 1
            else:
                self.assertEqual(added, set(), name)
                self.assertTrue(json.loads(body)["error"])
            self.server.wait()
        self.assertTrue(3 < made < len(NAMES) - 20, made)
        self.assertEqual(self.around(), outside)
        listed = {project["name"] for project in self.server.state()["projects"]}
        for name in NAMES:
            status, _, body = self.server.ask("POST", "/api/commands/open-project", {"name": name})
            self.assertEqual(status == 200, name in listed, name)
            self.assertNotIn(b"secret", body)
            self.server.wait()

    def test_a_project_is_no_link_to_another_folder(self):
        elsewhere = pathlib.Path(self.folder.name) / "elsewhere"
        elsewhere.mkdir()
        (elsewhere / "project.json").write_text("{}")
        (self.server.projects / "linked").symlink_to(elsewhere)
        self.assertEqual(self.server.ask("POST", "/api/commands/open-project", {"name": "linked"})[0], 400)
        exports = self.project / "exports"
        exports.mkdir()
        (exports / "linked.dxf").symlink_to(self.secret)
        os.mkfifo(exports / "pipe.dxf")
        (exports / "plain.dxf").write_text("plain")
        for name in ("linked.dxf", "pipe.dxf"):
            status, _, body = self.server.ask("GET", f"/api/exports/{name}")
            self.assertEqual(status, 400, name)
            self.assertNotIn(b"secret", body)
        self.assertEqual(self.server.ask("GET", "/api/exports/plain.dxf")[2], b"plain")
        self.assertEqual(self.server.ask("GET", "/api/exports/pl%61in.dxf")[2], b"plain")

    def test_names_in_paths_reach_no_file(self):
        exports = self.project / "exports"
        exports.mkdir()
        (exports / "part.dxf").write_text("an export")
        asked = 0
        for name in NAMES + [
            "../project.json",
            "../rig.toml",
            "part.dxf/../../rig.toml",
            "./part.dxf",
            "part.dxf/",
            "part.dxf\u0000",
        ]:
            for form in percent_forms(name):
                for path in (
                    f"/api/exports/{form}",
                    f"/api/clouds/{form}",
                    f"/api/commands/{form}",
                    f"/api/{form}",
                    f"/assets/{form}",
                ):
                    status, head, body = self.server.ask("GET", path)
                    self.assertIn(status, REFUSED, path)
                    for text in (b"secret", b"an export", b"frangia-project", b"root:"):
                        self.assertNotIn(text, body, path)
                    self.assertNotIn("Set-Cookie", head)
                    asked += 1
                self.assertIn(self.server.ask("POST", f"/api/commands/{form}", {})[0], REFUSED, form)
        self.assertGreater(asked, 400)
        for path in (
            "/api/clouds/0",
            "/api/clouds/-1",
            "/api/clouds/99999999999999999999",
            "/api/clouds/0x0",
            "/api/clouds/",
            "/api/clouds/1 ",
        ):
            self.assertNotEqual(self.server.ask("GET", path)[0], 200, path)
        for target in (
            f"http://{self.server.host}/api/state",
            "*",
            "//api/state",
            "/api/../api/state",
            "/API/STATE",
            "/api/state/",
            "/api/state%00",
        ):
            self.assertIn(self.server.ask("GET", target)[0], REFUSED, target)

    def test_every_text_of_every_command_refuses_what_it_does_not_know(self):
        outside = self.around()
        tried = 0
        for command, arguments in SCHEMA["definitions"]["commands"].items():
            fields = arguments.get("properties", {})
            fit = {
                "name": self.project.name,
                "operation": "smooth",
                "value": "1",
                "format": "stl",
                "kind": "plane",
                "station": 0,
                "triangle": 0,
                "job": 1,
            }
            for field in fields:
                if (command, field) in FREE:
                    continue
                for value in NAMES:
                    if field == "id" and re.fullmatch("[0-9A-Za-z_-]{8,64}", value):
                        continue  # it names the command, and nothing else
                    given = {key: fit[key] for key in arguments.get("required", []) if key in fit}
                    status, _, body = self.server.ask("POST", f"/api/commands/{command}", {**given, field: value})
                    self.assertEqual(status, 400, (command, field, value))
                    self.assertTrue(json.loads(body)["error"])
                    tried += 1
        self.assertGreater(tried, 500)
        self.assertEqual(self.around(), outside)
        self.assert_serves()

    def test_numbers_outside_of_their_range_are_refused(self):
        for command, arguments in SCHEMA["definitions"]["commands"].items():
            for field in arguments.get("properties", {}):
                for number in (
                    "1e999",
                    "-1e999",
                    "-1e308",
                    "1e300",
                    "18446744073709551616",
                    "-9223372036854775809",
                    "[]",
                    "{}",
                    "[1e999]",
                    "NaN",
                    "Infinity",
                ):
                    if (field, number) in (
                        ("exposures_ms", "[]"),
                        ("devices", "{}"),
                        ("plan", "{}"),
                        ("labels", "[]"),
                    ):
                        continue  # no merging of exposures, no devices, a plan of defaults, no measurements
                    body = '{"%s": %s}' % (field, number)
                    status = self.server.ask("POST", f"/api/commands/{command}", body.encode())[0]
                    self.assertEqual(status, 400, (command, body))
        self.assert_serves()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
