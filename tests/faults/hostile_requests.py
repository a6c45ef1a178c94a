"""Random hostile requests and WebSocket messages against `serve`, while an honest client asks for the state."""
import collections
import contextlib
import json
import pathlib
import random
import signal
import socket
import struct
import sys
import threading
import time

from campaign import ROOT, Answer

sys.path.append(str(ROOT / "tests" / "app"))

import serve_client  # noqa: E402

MOST_MB = 256  # above the server at rest
LATENCY_S = 1.0
HELD = 150  # connections that stay open
PIECE = b"a" * 1_000_000
JSON_TYPE = "Content-Type: application/json\r\n"


class Attacker:
    """One hostile request after another; each kind is a method."""

    def __init__(self, server, key, seed):
        self.server, self.key = server, key
        self.random = random.Random(seed)
        self.held = collections.deque()
        self.kinds = []

    def attack(self):
        if not self.kinds:  # each as often as the others
            self.kinds = sorted(name for name in dir(self) if name.startswith("try_"))
            self.random.shuffle(self.kinds)
        kind = self.kinds.pop()
        buffer = self.random.choice([0, 4096])
        line = socket.socket()
        if buffer:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        line.settimeout(5)
        with contextlib.suppress(OSError, EOFError):
            line.connect(("127.0.0.1", self.server.port))
            getattr(self, kind)(line)
        self.leave(line)
        return kind

    def leave(self, line):
        """Reads, holds, closes or resets the line."""
        way = self.random.choice(["read", "hold", "hold", "close", "reset"])
        with contextlib.suppress(OSError):
            if way == "read":
                line.settimeout(0.2)
                for _ in range(20):
                    if not line.recv(65536):
                        break
            elif way == "hold":
                self.held.append(line)
                if len(self.held) > HELD:
                    self.held.popleft().close()
                return
            elif way == "reset":
                line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        line.close()

    def end(self):
        while self.held:
            self.held.popleft().close()

    def head(self, method, path, *more, key=None, host=None):
        known = self.random.random() < 0.5 if key is None else key
        lines = [f"{method} {path} HTTP/1.1", f"Host: {host or self.server.host}", *more]
        if known:
            lines.append(f"Authorization: Bearer {self.key}")
        return ("\r\n".join(lines) + "\r\n").encode()

    def target(self):
        return self.random.choice(["/", "/api/session", "/api/state", "/api/commands/edit", "/api/live", "/api/mesh"])

    def pour(self, line, most=20):
        for _ in range(self.random.randrange(1, most)):
            line.sendall(PIECE)

    def try_chunks(self, line):
        line.sendall(self.head("POST", self.target(), JSON_TYPE + "Transfer-Encoding: chunked") + b"\r\n")
        line.sendall(self.random.choice([b"2;", b"0\r\nX: ", b"0\r\n" + b"a: b\r\n" * 5000, b"fffffffffffffffff\r\n"]))
        self.pour(line)
        line.sendall(b"\r\n\r\n0\r\n\r\n")

    def try_two_lengths(self, line):
        fields = self.random.sample(
            ["Content-Length: 2", "Content-Length: 3", "Transfer-Encoding: chunked", "Transfer-Encoding: identity"], 2
        )
        line.sendall(self.head("POST", self.target(), *fields) + b"\r\n{}" + self.head("GET", "/api/state") + b"\r\n")

    def try_endless_header(self, line):
        line.sendall(self.head("GET", self.target()) + self.random.choice([b"X: ", b"", b"X"]))
        self.pour(line)

    def try_many_fields(self, line):
        line.sendall(self.head("GET", self.target()) + b"a: b\r\n" * self.random.randrange(100, 100_000) + b"\r\n")

    def try_long_target(self, line):
        line.sendall(self.head("GET", "/" + "a" * self.random.randrange(1, 200_000)) + b"\r\n")

    def try_body_that_does_not_come(self, line):
        length = self.random.choice([1, 4096, 999_999, 1 << 20, (1 << 20) + 1, 1 << 40, (1 << 64) - 1])
        line.sendall(self.head("POST", self.target(), JSON_TYPE + f"Content-Length: {length}") + b"\r\n")
        line.sendall(PIECE[: self.random.randrange(max(1, min(length, len(PIECE))))])

    def try_body_of_another_size(self, line):
        line.sendall(self.head("POST", self.target(), JSON_TYPE + f"Content-Length: {self.random.randrange(100)}"))
        line.sendall(b"\r\n")
        self.pour(line, 4)

    def try_nested(self, line):
        count = self.random.randrange(1, 450_000)
        body = self.random.choice([b"[", b'{"a":', b'{"operation":['])[:40] * min(count, 120_000)
        line.sendall(
            self.head(
                "POST",
                self.random.choice(["/api/session", "/api/commands/edit", "/api/pick"]),
                JSON_TYPE + f"Content-Length: {len(body)}",
                key=True,
            )
            + b"\r\n"
            + body
        )

    def try_random_bytes(self, line):
        data = bytearray(self.head("POST", self.target(), JSON_TYPE + "Content-Length: 2") + b"\r\n{}")
        for _ in range(self.random.randrange(1, 12)):
            at = self.random.randrange(len(data))
            data[at : at + self.random.randrange(3)] = self.random.randbytes(self.random.randrange(4))
        line.sendall(data)

    def try_foreign_host(self, line):
        line.sendall(self.head("POST", "/", "Content-Length: 1000000", host="evil.example") + b"\r\n")
        self.pour(line, 3)

    def try_reference_pieces(self, line):
        offset = self.random.choice(["0", "1", "18446744073709551615", "-1", "1e9", ""])
        line.sendall(
            self.head(
                "POST",
                f"/api/reference/{offset}",
                "Content-Type: application/octet-stream",
                f"Content-Length: {len(PIECE)}",
                key=True,
            )
            + b"\r\n"
            + PIECE
        )

    def try_unread_answers(self, line):
        request = self.head("GET", self.random.choice(["/", "/api/state", "/api/exports/large.bin"]), key=True)
        line.settimeout(0.5)
        line.sendall((request + b"\r\n") * self.random.randrange(1, 500))

    def try_socket(self, line):
        line.sendall(
            self.head(
                "GET",
                "/api/live",
                "Connection: Upgrade",
                "Upgrade: websocket",
                "Sec-WebSocket-Version: 13",
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
            )
            + b"\r\n"
        )
        line.recv(4096)
        if self.random.random() < 0.5:
            line.sendall(serve_client.frame(json.dumps({"type": "hello", "key": self.key}).encode()))
        line.sendall(
            self.random.choice(
                [
                    serve_client.frame(PIECE),
                    serve_client.frame(b"x" * 125, opcode=9) * 5000,
                    b"\x81\xff" + struct.pack(">Q", 1 << 62) + b"\0\0\0\0" + PIECE,
                    b"\x01" + serve_client.frame(b"x" * 50)[1:] + (b"\x00" + serve_client.frame(b"x" * 50)[1:]) * 5000,
                    serve_client.frame(b'{"type": "show", "layer": "phase"}') * 2000,
                    serve_client.frame(b"[" * 4000),
                    self.random.randbytes(300),
                ]
            )
        )


def peak_mb(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1024
    return 0.0


def run(campaign):
    answer = Answer(
        "hostile_requests",
        "hostile requests and WebSocket messages to `serve`, many at once, beside an honest client",
        campaign.count(80, 1000),
    )
    serve_client.PROGRAM = str(campaign.program)
    folder = campaign.fresh("serve").parent
    server = serve_client.Server(folder)
    key = server.login()
    server.command("create-project", name="part", part="plate", stations=3)
    server.wait()
    exports = server.projects / "part" / "exports"
    exports.mkdir()
    (exports / "large.bin").write_bytes(PIECE * 64)
    rest = peak_mb(server.process)
    slowest, over, failures = [0.0], threading.Event(), []

    def ask():
        while not over.is_set():
            begin = time.monotonic()
            try:
                status = server.ask("GET", "/api/state")[0]
            except OSError as error:
                status = error
            slowest[0] = max(slowest[0], time.monotonic() - begin)
            if status != 200:
                failures.append(f"an honest client got {status}")
                return
            time.sleep(0.01)

    attackers = [Attacker(server, key, f"{campaign.seed} {number}") for number in range(4)]
    kinds = collections.Counter()

    def attack(attacker):
        for _ in range(answer.tried // len(attackers)):
            if server.process.poll() is not None:
                return
            kinds[attacker.attack()] += 1

    threads = [threading.Thread(target=attack, args=(attacker,)) for attacker in attackers]
    honest = threading.Thread(target=ask)
    for thread in [honest, *threads]:
        thread.start()
    for thread in threads:
        thread.join()
    over.set()
    honest.join()
    answer.failures += failures[:1]
    if server.process.poll() is not None:
        answer.failures.append(f"the server ended with {server.process.returncode}; seed {campaign.seed}")
    else:
        grown = peak_mb(server.process) - rest
        answer.measured = f"at most {grown:.0f} MB above the server at rest; others served within {slowest[0]:.2f} s"
        if grown > MOST_MB:
            answer.failures.append(f"the server took {grown:.0f} MB more than at rest")
        if slowest[0] > campaign.latency(LATENCY_S):
            answer.failures.append(f"an honest client waited {slowest[0]:.2f} s")
        for attacker in attackers:
            attacker.end()
        server.process.send_signal(signal.SIGTERM)
        if (code := server.process.wait(60)) != 0:
            answer.failures.append(f"the server ended with {code}")
    server.process.stdout.close()
    return answer
