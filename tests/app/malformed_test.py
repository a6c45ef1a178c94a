"""Malformed requests, bodies and frames, and clients that do not read, against `frangia serve`.

    malformed_test.py PROGRAM
"""
import contextlib
import json
import random
import socket
import struct
import sys
import unittest

from hostile_server import HostileServer
from serve_client import PATIENCE, frame, read_frame

CONNECTIONS = 256  # HttpLimits::connections
SESSION_BYTES = 4096  # of a body without a key


class Malformed(HostileServer):
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
        with contextlib.ExitStack() as lines:
            for _ in range(CONNECTIONS + 100):
                line = self.server.upgrade()
                self.assertIsInstance(line, socket.socket)
                lines.enter_context(line)
            self.assert_serves()
            self.server.live().close()

    def test_clients_that_do_not_read_keep_nobody_out(self):
        page = self.server.ask("GET", "/", key=None)[2]
        self.assertGreater(len(page), 100)
        request = f"GET / HTTP/1.1\r\nHost: {self.server.host}\r\n\r\n".encode() * 4000
        with contextlib.ExitStack() as lines:
            for _ in range(CONNECTIONS + 100):
                line = lines.enter_context(socket.socket())
                line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                line.connect(("127.0.0.1", self.server.port))
                line.setblocking(False)
                with contextlib.suppress(OSError):
                    line.send(request)  # more answers than the buffers of the system hold
            self.assert_serves()
            self.server.live().close()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
