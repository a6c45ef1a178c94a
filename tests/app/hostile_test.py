"""Hostile values in every field that names something, and malformed bodies and frames, against `frangia serve`.

    hostile_test.py PROGRAM SCHEMA.json
"""
import contextlib
import json
import os
import pathlib
import random
import re
import socket
import struct
import sys
import tempfile
import unittest
import urllib.parse

from serve_client import PATIENCE, Server, frame, read_frame

SCHEMA = json.loads(pathlib.Path(sys.argv[2]).read_text())
CONNECTIONS = 256  # HttpLimits::connections
SESSION_BYTES = 4096  # of a body without a key

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


def below(folder):
    """All files and folders below a folder, with the size of the files."""
    return {
        path.relative_to(folder): path.stat().st_size if path.is_file() else -1
        for path in pathlib.Path(folder).rglob("*")
    }


# Names of something new, which one function checks and create-project is tried with; and what nobody takes for a name.
FREE = {
    ("create-project", "name"),
    ("rename-project", "to"),
    ("duplicate-project", "copy"),
    ("keep-rig", "name"),
    ("set-notes", "text"),
}


class Hostile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = Server(cls.folder.name)
        cls.server.login()
        cls.secret = pathlib.Path(cls.folder.name) / "secret.txt"
        cls.secret.write_text("a secret")
        (pathlib.Path(cls.folder.name) / "evil").write_text("a secret")

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.folder.cleanup()
        if code != 0:
            raise AssertionError(f"the server ended with {code}")

    def setUp(self):
        self.server.wait()
        name = f"p{random.randrange(10**9)}"
        self.server.command("create-project", name=name, part="plate", stations=3)
        self.server.wait()
        self.project = self.server.projects / name

    def assert_serves(self):
        self.assertEqual(self.server.ask("GET", "/api/state")[0], 200)

    def around(self):
        """Everything around the projects."""
        return {path: size for path, size in below(self.folder.name).items() if path.parts[0] != "projects"}

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
                    if (field, number) in (("exposures_ms", "[]"), ("devices", "{}")):
                        continue  # no merging of exposures, no devices
                    body = '{"%s": %s}' % (field, number)
                    status = self.server.ask("POST", f"/api/commands/{command}", body.encode())[0]
                    self.assertEqual(status, 400, (command, body))
        self.assert_serves()

    def test_bodies_that_are_truncated_or_no_json_are_refused(self):
        good = json.dumps({"operation": "fill-holes", "value": "10mm"})
        bodies = [good[:end] for end in range(1, len(good))]
        bodies += [
            good + "x",
            good + good,
            "\ufeff" + good + "{",
            "[" + good + "]",
            '"a text"',
            "0",
            "true",
            "null",
            '{"a": }',
            "{'a': 1}",
            '{"operation": "undo", "operation": 1}',
            "[" * 900_000,
            '{"a":' * 150_000,
            "{" + '"a": 1, ' * 100_000 + '"b": 1}',
        ]
        for body in bodies:
            for path in ("/api/commands/edit", "/api/session", "/api/operator"):
                if path == "/api/operator" and len(body) < 1000:
                    continue  # its body has no meaning
                status = self.server.ask("POST", path, body.encode("utf-8", "surrogatepass"))[0]
                known = {"/api/operator": (200,), "/api/session": (413,) if len(body) > SESSION_BYTES else (403,)}
                self.assertIn(status, known.get(path, (400,)), body[:40])
        for body in (
            b"\xff\xfe{\x00}\x00",
            b"\xc3\x28",
            b'{"operation": "\xff"}',
            b'{"operation": "a\x00"}',
            b"\x00" * 1000,
        ):
            self.assertEqual(self.server.ask("POST", "/api/commands/edit", body)[0], 400, body[:20])
        self.assert_serves()

    def test_requests_that_end_early_change_nothing(self):
        body = json.dumps({"name": "half"}).encode()
        head = (
            f"POST /api/commands/create-project HTTP/1.1\r\nHost: {self.server.host}\r\nAuthorization: Bearer {self.server.key}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
        ).encode()
        whole = head + body
        for end in list(range(1, len(whole), 7)) + [len(whole) - 1]:
            with self.server.connect() as line:
                line.sendall(whole[:end])
        self.assertFalse((self.server.projects / "half").exists())
        self.assert_serves()

    def test_a_header_that_decides_who_asks_stands_once(self):
        good = {
            "Host": self.server.host,
            "Authorization": f"Bearer {self.server.key}",
            "Origin": f"http://{self.server.host}",
            "Sec-Fetch-Site": "same-origin",
            "Content-Type": "application/json",
            "X-Forwarded-For": "10.0.0.1",
        }
        for field, value in good.items():
            for other in (value, "evil.example"):
                lines = [f"{name}: {text}" for name, text in good.items()] + [
                    f"{field}: {other}",
                    "Content-Length: 2",
                    "Connection: close",
                ]
                for method in ("GET", "POST"):
                    answer = self.server.raw(
                        (f"{method} /api/state HTTP/1.1\r\n" + "\r\n".join(lines) + "\r\n\r\n{}").encode()
                    )
                    self.assertIn(b" 400 ", answer[:20], (field, other))
        lines = "".join(f"{name}: {text}\r\n" for name, text in good.items())
        for smuggled in (
            "Content-Length: 2\r\nContent-Length: 3\r\n",
            "Content-Length: 2\r\nTransfer-Encoding: chunked\r\n",
            "Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n",
            "Transfer-Encoding: xchunked\r\n",
            "Content-Length: +2\r\n",
            "Content-Length: 0x2\r\n",
            "Content-Length : 2\r\n",
        ):
            answer = self.server.raw(
                (
                    f"POST /api/operator HTTP/1.1\r\n{lines}{smuggled}\r\n{{}}GET /api/state HTTP/1.1\r\n{lines}\r\n"
                ).encode(),
                3,
            )
            self.assertLessEqual(answer.count(b"HTTP/1.1 200"), 1, smuggled)
            self.assertNotIn(b'"projects"', answer, smuggled)
        self.assert_serves()

    def test_keys_are_accepted_in_one_place_only(self):
        for authorization in (
            self.server.key,
            f"bearer {self.server.key}",
            f"Basic {self.server.key}",
            f"Bearer  {self.server.key}",
            f"Bearer {self.server.key}\u0000",
            f"Bearer {self.server.key},Bearer x",
            "Bearer " + "x" * 10_000,
            "Bearer",
        ):
            status = self.server.ask(
                "GET", "/api/state", key=None, Authorization=authorization.encode().decode("latin-1")
            )[0]
            self.assertIn(status, (400, 401), authorization[:30])

    def test_malformed_frames_end_their_connection_only(self):
        key = self.server.key
        hello = json.dumps({"type": "hello", "key": key}).encode()
        watcher = self.server.live()
        attacks = {
            "reserved bits": b"\xf1" + frame(hello)[1:],
            "an unknown opcode": frame(hello, opcode=3),
            "a fragmented control frame": b"\x09" + frame(b"x", opcode=9)[1:],
            "a long control frame": frame(b"x" * 126, opcode=9),
            "a continuation of nothing": frame(hello, opcode=0),
            "a length of 2^62": b"\x81\xff" + struct.pack(">Q", 1 << 62) + b"\0\0\0\0",
            "a length of 2^64 - 1": b"\x81\xff" + b"\xff" * 8 + b"\0\0\0\0",
            "no UTF-8": frame(b'{"type": "\xff"}'),
            "a close frame of one byte": frame(b"\x03", opcode=8),
            "a close code that is reserved": frame(struct.pack(">H", 1005), opcode=8),
            "many pings": frame(b"x" * 125, opcode=9) * 200,
            "an empty text": frame(b""),
            "HTTP": b"GET / HTTP/1.1\r\n\r\n",
            "parts without an end": b"\x01" + frame(b"x" * 50)[1:] + (b"\x00" + frame(b"x" * 50)[1:]) * 200,
        }
        for begin in (b"", frame(hello)):
            for what, attack in attacks.items():
                line = self.server.upgrade()
                with contextlib.suppress(OSError):
                    line.sendall(begin + attack)
                    line.shutdown(socket.SHUT_WR)
                    with contextlib.suppress(EOFError):
                        while True:
                            opcode, body = read_frame(line)
                            if not begin:
                                self.assertNotIn(b'"state"', body, what)
                            if opcode == 8:
                                break
                line.close()
        # Another client is served all the time and receives changes.
        self.server.command("set-capture", exposure_ms=33.0)
        watcher.settimeout(PATIENCE)
        while b"33.0" not in (message := read_frame(watcher)[1]):
            self.assertTrue(message)
        watcher.close()

    def test_random_bytes_end_nothing_but_their_connection(self):
        generator = random.Random(1)
        requests = [
            b"GET / HTTP/1.1\r\nHost: %b\r\n\r\n",
            b"GET /api/state HTTP/1.1\r\nHost: %b\r\nAuthorization: Bearer " + self.server.key.encode() + b"\r\n\r\n",
            b"POST /api/commands/edit HTTP/1.1\r\nHost: %b\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}",
        ]
        for number in range(300):
            data = bytearray(generator.choice(requests) % self.server.host.encode())
            for _ in range(generator.randrange(1, 8)):
                at = generator.randrange(len(data))
                data[at : at + generator.randrange(3)] = generator.randbytes(generator.randrange(4))
            with self.server.connect() as line, contextlib.suppress(OSError):
                line.sendall(data)
                line.shutdown(socket.SHUT_WR)
                while line.recv(65536):
                    pass
            if number % 100 == 0:
                self.assert_serves()
        self.assert_serves()

    def test_websockets_without_a_key_keep_nobody_out(self):
        lines = []
        try:
            for _ in range(CONNECTIONS + 100):
                line = self.server.upgrade()
                self.assertIsInstance(line, socket.socket)
                lines.append(line)
            self.assert_serves()
            self.server.live().close()
        finally:
            for line in lines:
                line.close()

    def test_clients_that_do_not_read_keep_nobody_out(self):
        page = self.server.ask("GET", "/", key=None)[2]
        self.assertGreater(len(page), 100)
        lines = []
        request = f"GET / HTTP/1.1\r\nHost: {self.server.host}\r\n\r\n".encode() * 4000
        try:
            for _ in range(CONNECTIONS + 100):
                line = socket.socket()
                line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                line.connect(("127.0.0.1", self.server.port))
                line.setblocking(False)
                with contextlib.suppress(OSError):
                    line.send(request)  # more answers than the buffers of the system hold
                lines.append(line)
            self.assert_serves()
            self.server.live().close()
        finally:
            for line in lines:
                line.close()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
