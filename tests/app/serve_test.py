"""Attacks and honest clients against `frangia serve` on the loopback.

    serve_test.py PROGRAM SCHEMA.json
"""
import contextlib
import json
import os
import pathlib
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

from serve_client import PROGRAM, SLOWDOWN, Server, ServerTest, frame, read_frame

SCHEMA = pathlib.Path(sys.argv[2])


class Serve(ServerTest):
    def test_page_carries_its_security_headers(self):
        status, head, _ = self.server.ask("GET", "/", key=None)
        self.assertEqual(status, 200)
        for field in (
            "default-src 'none'",
            "frame-ancestors 'none'",
            "X-Content-Type-Options: nosniff",
            "Referrer-Policy: no-referrer",
        ):
            self.assertIn(field, head)
        self.assertNotIn("unsafe", head)
        self.assertNotIn("Access-Control", head)
        self.assertNotIn("Set-Cookie", head)

    def test_foreign_host_is_refused(self):
        for host in (
            "evil.example",
            f"evil.example:{self.server.port}",
            "127.0.0.1",
            f"127.0.0.1:{self.server.port + 1}",
            "",
            f"127.0.0.1:{self.server.port}.evil.example",
        ):
            self.assertEqual(self.server.ask("GET", "/api/state", Host=host)[0], 403, host)
            self.assertEqual(self.server.ask("GET", "/", key=None, Host=host)[0], 403, host)
        self.assertEqual(self.server.ask("GET", "/api/state", Host=f"localhost:{self.server.port}")[0], 200)

    def test_foreign_origin_is_refused(self):
        for origin in (
            "http://evil.example",
            "null",
            f"https://127.0.0.1:{self.server.port}",
            f"http://127.0.0.1:{self.server.port + 1}",
            f"http://127.0.0.1:{self.server.port}.evil.example",
        ):
            self.assertEqual(self.server.ask("GET", "/api/state", Origin=origin)[0], 403, origin)
            self.assertEqual(self.server.ask("POST", "/api/session", {"token": "x"}, Origin=origin)[0], 403, origin)
            self.assertEqual(self.server.upgrade(Origin=origin), 403, origin)
        for site in ("cross-site", "same-site"):
            self.assertEqual(self.server.ask("GET", "/api/state", Sec_Fetch_Site=site)[0], 403, site)
        self.assertEqual(self.server.ask("GET", "/", key=None, Sec_Fetch_Site="cross-site")[0], 200)

    def test_no_key_and_wrong_keys_are_refused(self):
        for key in (None, "", "x", self.server.token, self.server.key[:-1], self.server.key + "x"):
            self.assertEqual(self.server.ask("GET", "/api/state", key=key)[0], 401, key)
            self.assertEqual(self.server.ask("POST", "/api/commands/undo", {}, key=key)[0], 401, key)
        self.assertEqual(self.server.ask("GET", "/api/state", key=None, Cookie=f"key={self.server.key}")[0], 401)
        self.assertEqual(self.server.ask("GET", f"/api/state?key={self.server.key}", key=None)[0], 401)

    def test_token_works_once(self):
        self.assertEqual(self.server.ask("POST", "/api/session", {"token": self.server.token}, key=None)[0], 403)
        link = json.loads(self.server.ask("POST", "/api/links", {})[2])["url"]
        token = link.split("#token=")[1]
        self.assertEqual(self.server.ask("POST", "/api/session", {"token": token}, key=None)[0], 200)
        self.assertEqual(self.server.ask("POST", "/api/session", {"token": token}, key=None)[0], 403)
        for body in (b"", b"{", b"[]", b'{"token": 3}', b'{"token": ""}', b'{"password": "x"}', b"\xff\xfe"):
            self.assertEqual(self.server.ask("POST", "/api/session", body, key=None)[0], 403, body)

    def test_key_of_another_server_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Server(folder)
            key = other.login()
            self.assertEqual(self.server.ask("GET", "/api/state", key=key)[0], 401)
            self.assertEqual(other.stop(), 0)

    def test_cross_site_form_posts_are_refused(self):
        for kind in ("application/x-www-form-urlencoded", "multipart/form-data; boundary=x", "text/plain"):
            self.assertEqual(self.server.ask("POST", "/api/commands/undo", b"{}", Content_Type=kind)[0], 415, kind)
        for kind, known in (
            ("application/json; charset=utf-8", True),
            ('Application/JSON;charset="UTF-8"', True),
            ("application/json; charset=latin-1", False),
            ("application/json; boundary=x", False),
            ("application/octet-stream", False),
        ):
            status = self.server.ask("POST", "/api/operator", b"{}", Content_Type=kind)[0]
            self.assertEqual(status, 200 if known else 415, kind)

    def test_names_reach_no_other_file(self):
        secret = pathlib.Path(self.folder.name) / "secret.txt"
        secret.write_text("secret")
        for name in (
            "../secret.txt",
            "..%2fsecret.txt",
            "%2e%2e/secret.txt",
            "..%5csecret.txt",
            "/etc/passwd",
            "%2fetc%2fpasswd",
            "%00",
            "%",
            "%4",
            "%zz",
            "....//secret.txt",
        ):
            for path in (f"/api/exports/{name}", f"/api/clouds/{name}", f"/{name}", f"/assets/{name}"):
                status, _, body = self.server.ask("GET", path)
                self.assertIn(status, (400, 404), path)
                self.assertNotIn(b"secret", body)
                self.assertNotIn(b"root:", body)
        for name in ("../evil", "/tmp/evil", "a/../../evil", "..", "", "a\u0000b", "x" * 5000):
            for command in ("create-project", "open-project"):
                self.assertEqual(self.server.ask("POST", f"/api/commands/{command}", {"name": name})[0], 400, name)
        self.assertEqual(self.server.ask("POST", "/api/commands/export", {"format": "../../x.dxf"})[0], 400)
        self.assertFalse((pathlib.Path(self.folder.name) / "evil").exists())

    def test_oversized_and_malformed_requests_are_refused(self):
        head = f"Host: {self.server.host}\r\nAuthorization: Bearer {self.server.key}\r\n".encode()
        self.assertIn(
            b" 413 ",
            self.server.raw(
                b"POST /api/commands/edit HTTP/1.1\r\n"
                + head
                + b"Content-Type: application/json\r\nContent-Length: 99999999\r\n\r\n"
            )[:40],
        )
        self.assertIn(
            b" 431 ", self.server.raw(b"GET /api/state HTTP/1.1\r\n" + head + b"X: " + b"x" * 40000 + b"\r\n\r\n")[:40]
        )
        # Without a key, the header decides: no answer waits for a body.
        begin = f"Host: {self.server.host}\r\nContent-Type: application/json\r\n".encode()
        for path, length, code in (("commands/edit", 900_000, 401), ("session", 5000, 413), ("reference/0", 9, 415)):
            request = f"POST /api/{path} HTTP/1.1\r\nContent-Length: {length}\r\n".encode() + begin + b"\r\n"
            with self.server.connect() as line:
                line.sendall(request)
                self.assertIn(f" {code} ".encode(), line.recv(40), path)
        for more in (b"0\r\nX: " + b"x" * 70_000 + b"\r\n\r\n", b"2;" + b"x" * 2_000_000, b"2\r\n{}\r\n0\r\n\r\n"):
            request = b"POST /api/operator HTTP/1.1\r\nTransfer-Encoding: chunked\r\n" + head + b"\r\n" + more
            self.assertIn(b" 411 ", self.server.raw(request)[:20], more[:10])
        for request in (
            b"\r\n\r\n",
            b"GET\r\n\r\n",
            b"\x16\x03\x01\x02\x00\x01\x00",
            b"GET / HTTP/9.9\r\n\r\n",
            b"A" * 20000,
            b"GET / HTTP/1.1\r\nHost\r\n\r\n",
            b"POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
            b"POST / HTTP/1.1\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n\r\n",
        ):
            answer = self.server.raw(request, 12)
            self.assertNotIn(b" 200 ", answer[:20], request[:40])
        for body in (b"{", b"[" * 100000, b"\xff", b"null", b'{"operation": "' + b"x" * 900000 + b'"}'):
            self.assertEqual(self.server.ask("POST", "/api/commands/edit", body)[0], 400, body[:20])
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertIn(self.server.ask(method, "/api/state")[0], (403, 405), method)
        self.assert_serves()

    def test_websocket_needs_a_key_and_bounds_its_messages(self):
        for message in (
            b"",
            b"{}",
            b"{",
            b'{"type": "hello"}',
            b'{"type": "hello", "key": "x"}',
            json.dumps({"type": "hello", "key": self.server.token}).encode(),
            json.dumps({"type": 7, "key": self.server.key}).encode(),
        ):
            line = self.server.upgrade()
            line.sendall(frame(message))
            opcode, body = read_frame(line)
            self.assertEqual((opcode, struct.unpack(">H", body[:2])[0]), (8, 1008), message)
            line.close()
        hello = json.dumps({"type": "hello", "key": self.server.key}).encode()
        for attack in (
            frame(hello, masked=False),
            frame(b"x" * 10000),
            b"\xff" * 40,
            frame(hello, opcode=2),
            frame(hello)[:9],
        ):
            line = self.server.upgrade()
            line.sendall(attack)
            with contextlib.suppress(OSError):
                line.shutdown(socket.SHUT_WR)
            with contextlib.suppress(OSError, EOFError):
                opcode, body = read_frame(line)
                self.assertNotIn(b"state", body)
            line.close()
        line = self.server.upgrade()
        line.sendall(frame(hello))
        opcode, body = read_frame(line)
        self.assertEqual(opcode, 1)
        self.assertEqual(json.loads(body)["type"], "state")
        line.close()
        self.assert_serves()

    def test_idle_and_slow_clients_hinder_nobody(self):
        idle = []
        try:
            for number in range(1000):
                idle.append(self.server.connect())
                if number % 3 == 0:
                    with contextlib.suppress(OSError):
                        idle[-1].sendall(b"GET /api/st")  # a slow sender
                if number % 250 == 249:
                    self.assert_serves()
        finally:
            for line in idle:
                line.close()
        self.assert_serves()

    def test_a_server_short_of_descriptors_serves_on(self):
        with tempfile.TemporaryDirectory() as folder:
            server = Server(folder, wrapper=("sh", "-c", 'ulimit -n 60; exec "$@"', "sh"))
            server.login()
            idle = [server.connect() for _ in range(200)]
            self.assertEqual(server.ask("GET", "/api/state")[0], 200)
            spent = pathlib.Path(f"/proc/{server.process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
            for line in idle:
                line.close()
            self.assertEqual(server.stop(), 0)
        # It does not try again and again while there is none: that took 13 s of processor time.
        self.assertLess(sum(map(int, spent)) / os.sysconf("SC_CLK_TCK"), 3 * SLOWDOWN)

    def test_runtime_file_is_private_and_new_link_works(self):
        path = self.server.runtime / "frangia-serve.json"
        self.assertEqual(path.stat().st_mode & 0o777, 0o600)
        key = json.loads(path.read_text())["key"]
        self.assertEqual(self.server.ask("GET", "/api/state", key=key)[0], 200)
        link = subprocess.run(
            [PROGRAM, "serve", "--new-link"], env=self.server.environment, capture_output=True, text=True, check=True
        ).stdout.strip()
        self.assertEqual(self.server.ask("POST", "/api/session", {"token": link.split("#token=")[1]}, key=None)[0], 200)

    def test_damaged_runtime_file_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            for text in (
                '{"port": "x", "key": "y"}',
                '{"port": 1, "key": 2}',
                '{"port": -1, "key": "y"}',
                "[" * 200000,
            ):
                (pathlib.Path(name) / "frangia-serve.json").write_text(text)
                found = subprocess.run(
                    [PROGRAM, "serve", "--new-link"],
                    env={**self.server.environment, "XDG_RUNTIME_DIR": name},
                    capture_output=True,
                    text=True,
                )
                self.assertEqual(found.returncode, 3, text[:40])
                self.assertTrue("is damaged" in found.stderr or "nested" in found.stderr, found.stderr)

    def test_one_browser_operates_and_others_take_over(self):
        link = json.loads(self.server.ask("POST", "/api/links", {})[2])["url"]
        session = json.loads(self.server.ask("POST", "/api/session", {"token": link.split("#token=")[1]}, key=None)[2])
        other = session["key"]
        self.assertEqual(self.server.ask("GET", "/api/state", key=other)[0], 200)
        for path in ("/api/commands/close-project", "/api/links"):
            self.assertEqual(self.server.ask("POST", path, {}, key=other)[0], 409, path)
        self.assertEqual(self.server.ask("POST", "/api/operator", {}, key="x")[0], 401)
        self.assertEqual(self.server.ask("POST", "/api/operator", {}, key=other)[0], 200)
        self.assertEqual(self.server.ask("POST", "/api/links", {}, key=other)[0], 200)
        self.assertEqual(self.server.ask("POST", "/api/links", {})[0], 409)
        self.assertEqual(self.server.ask("POST", "/api/operator", {})[0], 200)

    def test_live_layers_are_chosen_by_known_names_only(self):
        hello = json.dumps({"type": "hello", "key": self.server.key}).encode()
        for message in (
            b"{}",
            b"x",
            b'{"type": "show"}',
            b'{"type": "show", "layer": "../x"}',
            b'{"type": "show", "layer": 3}',
        ):
            line = self.server.upgrade()
            line.sendall(frame(hello))
            read_frame(line)
            line.sendall(frame(message))
            opcode = 1
            while opcode == 1:
                opcode, body = read_frame(line)
            self.assertEqual((opcode, struct.unpack(">H", body[:2])[0]), (8, 1008), message)
            line.close()
        self.assert_serves()

    def test_state_and_refusals_follow_the_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("python3-jsonschema is not installed")
        schema = json.loads(SCHEMA.read_text())

        def check(name, value):
            jsonschema.validate(value, {**schema, "$ref": f"#/definitions/{name}"})

        self.assertEqual(
            self.server.ask("POST", "/api/commands/create-project", {"name": "Schema", "stations": 3})[0], 200
        )
        check("state", self.server.wait())
        check("error", json.loads(self.server.ask("POST", "/api/commands/nothing", {})[2]))
        check("error", json.loads(self.server.ask("GET", "/api/state", key=None)[2]))
        check("error", json.loads(self.server.ask("GET", "/api/mesh")[2]))

        def example(rule):
            """A value that a rule of the schema allows."""
            if "$ref" in rule:
                return example(schema["definitions"][rule["$ref"].split("/")[-1]])
            if rule.get("type") == "array":
                return [example(rule["items"])] * rule.get("minItems", 0)
            return (
                rule["enum"][0]
                if "enum" in rule
                else {"string": "x", "integer": rule.get("minimum", 0)}.get(str(rule["type"]), 1.5)
            )

        # What the schema calls a command, the server knows; what it forbids, the server refuses.
        for name, arguments in schema["definitions"]["commands"].items():
            status, _, body = self.server.ask("POST", f"/api/commands/{name}", {"no such argument": 1})
            self.assertEqual(status, 400, name)
            self.assertNotIn("no such command", json.loads(body)["error"])
            given = {key: example(arguments["properties"][key]) for key in arguments.get("required", [])}
            for missing in given:
                others = {key: value for key, value in given.items() if key != missing}
                error = json.loads(self.server.ask("POST", f"/api/commands/{name}", others)[2])["error"]
                self.assertIn(missing, error, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
