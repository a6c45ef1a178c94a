"""A server of the operator's app under test, and an HTTP and WebSocket client that may misbehave."""
import base64
import contextlib
import json
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv[1]
SLOWDOWN = float(os.environ.get("FRANGIA_SLOWDOWN", "1"))  # above 1 with sanitizers
PATIENCE = 60 * SLOWDOWN  # by when an event has come, even on a busy machine


class Server:
    """A server with a folder of its own."""

    def __init__(self, folder, *arguments, wrapper=(), stderr=None, projects=None, **environment):
        """`wrapper`: words before the program, such as those of unshare; `projects`: a folder that servers share."""
        self.runtime = pathlib.Path(folder) / "run"
        self.runtime.mkdir(exist_ok=True)
        self.projects = pathlib.Path(projects or pathlib.Path(folder) / "projects")
        self.environment = {
            **os.environ,
            "XDG_RUNTIME_DIR": str(self.runtime),
            "XDG_STATE_HOME": str(folder),
            **environment,
        }
        self.process = subprocess.Popen(
            [*wrapper, PROGRAM, "--json", "serve", "--port", "0", "--projects", str(self.projects), *arguments],
            stdout=subprocess.PIPE,
            stderr=stderr,
            env=self.environment,
        )
        printed = b""
        while b"}" not in printed:
            line = self.process.stdout.readline()
            if not line:
                raise RuntimeError("the server did not start")
            printed += line
        self.url = json.loads(printed)["url"]
        self.fingerprint = json.loads(printed).get("fingerprint", "")
        self.port = json.loads((self.runtime / "frangia-serve.json").read_text())["port"]
        self.token = self.url.split("#token=")[1]
        self.host = f"127.0.0.1:{self.port}"
        self.key = None

    def login(self):
        answer = self.ask("POST", "/api/session", {"token": self.token}, key=None)
        self.key = json.loads(answer[2])["key"]
        return self.key

    def connect(self, timeout=PATIENCE):
        return socket.create_connection(("127.0.0.1", self.port), timeout)

    def raw(self, request, timeout=PATIENCE):
        """Sends bytes and returns everything until the server closes."""
        with self.connect(timeout) as line:
            with contextlib.suppress(OSError):
                line.sendall(request)
            answer = b""
            with contextlib.suppress(OSError):
                while block := line.recv(65536):
                    answer += block
        return answer

    def ask(self, method, path, body=None, key="mine", **headers):
        """Status, headers and body of an answer."""
        fields = {"Host": self.host, "Connection": "close"}
        if key == "mine":
            key = self.key
        if key is not None:
            fields["Authorization"] = f"Bearer {key}"
        data = b""
        if body is not None:
            data = body if isinstance(body, bytes) else json.dumps(body).encode()
            fields["Content-Type"] = "application/json"
            fields["Content-Length"] = str(len(data))
        fields.update({name.replace("_", "-"): value for name, value in headers.items()})
        head = "".join(f"{name}: {value}\r\n" for name, value in fields.items() if value is not None)
        answer = self.raw(f"{method} {path} HTTP/1.1\r\n{head}\r\n".encode() + data)
        head, _, content = answer.partition(b"\r\n\r\n")
        return int(head.split()[1]) if head else 0, head.decode("latin-1"), content

    def command(self, name, /, **arguments):
        """Runs a command that must be accepted."""
        status, _, body = self.ask("POST", f"/api/commands/{name}", arguments)
        if status != 200:
            raise RuntimeError(f"{name}: {body.decode()}")
        return json.loads(body)

    def state(self):
        return json.loads(self.ask("GET", "/api/state")[2])

    def wait(self):
        """Waits until no job runs, and returns the state."""
        end = time.monotonic() + 3 * PATIENCE
        while time.monotonic() < end:
            state = self.state()
            if all(job["state"] not in ("waiting", "running") for job in state["jobs"]):
                return state
            time.sleep(0.05)
        raise RuntimeError("the jobs do not end")

    def coarsen_camera(self, name, factor=2, projects=None):
        """Makes the camera of a project's simulated rig coarser, so that a test renders and decodes less, and opens it again."""

        def scaled(match):
            change = {
                "size_px": lambda x: int(x / factor),
                "focal_px": lambda x: x / factor,
                "principal_point_px": lambda x: (x + 0.5) / factor - 0.5,
            }[match[1]]
            return f"{match[1]} = [{', '.join(str(change(float(number))) for number in match[2].split(','))}]"

        for file in ("rig.toml", "true-rig.toml"):
            path = (projects or self.projects) / name / file
            if path.exists():  # the camera comes first, before the projector
                path.write_text(
                    re.sub(
                        r"^(size_px|focal_px|principal_point_px) = \[(.*)\]$",
                        scaled,
                        path.read_text(),
                        count=3,
                        flags=re.M,
                    )
                )
        self.command("open-project", name=name)
        self.wait()

    def upgrade(self, **headers):
        """Opens a WebSocket and returns its line, or the status of the refusal."""
        fields = {
            "Host": self.host,
            "Connection": "Upgrade",
            "Upgrade": "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(),
            **headers,
        }
        line = self.connect()
        line.sendall(
            b"GET /api/live HTTP/1.1\r\n" + "".join(f"{n}: {v}\r\n" for n, v in fields.items()).encode() + b"\r\n"
        )
        head = b""
        while b"\r\n\r\n" not in head and (block := line.recv(1)):
            head += block
        status = int(head.split()[1])
        if status == 101:
            return line
        line.close()
        return status

    def live(self):
        """A WebSocket that has shown its key and received the state."""
        line = self.upgrade()
        line.sendall(frame(json.dumps({"type": "hello", "key": self.key}).encode()))
        opcode, body = read_frame(line)
        if opcode != 1 or json.loads(body)["type"] != "state":
            raise RuntimeError("no state came")
        return line

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(PATIENCE)
        self.process.stdout.close()
        return code


def frame(payload, opcode=1, masked=True):
    length = len(payload)
    head = bytes([0x80 | opcode])
    bit = 0x80 if masked else 0
    if length < 126:
        head += bytes([bit | length])
    elif length < 65536:
        head += bytes([bit | 126]) + struct.pack(">H", length)
    else:
        head += bytes([bit | 127]) + struct.pack(">Q", length)
    if not masked:
        return head + payload
    mask = os.urandom(4)
    return head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload))


def exactly(line, count):
    data = b""
    while len(data) < count:
        block = line.recv(count - len(data))
        if not block:
            raise EOFError
        data += block
    return data


def read_frame(line):
    """Opcode and payload of a message, whose parts are joined."""
    opcode, whole = 0, b""
    while True:
        first, second = exactly(line, 2)
        length = second & 127
        if length == 126:
            length = struct.unpack(">H", exactly(line, 2))[0]
        elif length == 127:
            length = struct.unpack(">Q", exactly(line, 8))[0]
        opcode = opcode or first & 15
        whole += exactly(line, length)
        if first & 0x80:
            return opcode, whole


class ServerTest(unittest.TestCase):
    """Tests of one server, which ends without an error after them."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = Server(cls.folder.name)
        cls.server.login()

    @classmethod
    def tearDownClass(cls):
        code = cls.server.stop()
        cls.folder.cleanup()
        if code != 0:
            raise AssertionError(f"the server ended with {code}")

    def assert_serves(self):
        self.assertEqual(self.server.ask("GET", "/api/state")[0], 200)
