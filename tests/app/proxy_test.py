"""The reverse proxies of docs/service-api.md, each started with the configuration that stands there.

    proxy_test.py PROGRAM docs/service-api.md

Only what differs on a machine under test is replaced: the ports and the files of the certificate.
"""
import contextlib
import json
import os
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import sys
import tempfile
import time
import unittest

from serve_client import PATIENCE, PROGRAM, Server, frame, read_frame

PAGE = pathlib.Path(sys.argv[2]).read_text()
HERE = pathlib.Path(__file__).resolve().parent
PASSWORD = "a long password"
NAME = "scanner.example"


def block_with(word):
    """The block of the page that holds a word."""
    for block in re.findall(r"^```\w+\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL):
        if re.search(rf"\b{word}\b", block):
            return block
    raise AssertionError(f"the page shows no {word}")


def free_port():
    with socket.socket() as line:
        line.bind(("127.0.0.1", 0))
        return line.getsockname()[1]


def replaced(text, *pairs):
    for old, new in pairs:
        if old not in text:
            raise AssertionError(f"the configuration of the page lacks {old}")
        text = text.replace(old, new)
    return text


class Proxied(Server):
    """A server that is reached through TLS."""

    def reach(self, port):
        self.proxy = port
        self.host = f"{NAME}:{port}"
        self.origin = f"https://{self.host}"

    def connect(self, timeout=PATIENCE):
        context = ssl.create_default_context()
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        return context.wrap_socket(socket.create_connection(("127.0.0.1", self.proxy), timeout), server_hostname=NAME)


class Proxies(unittest.TestCase):
    def setUp(self):
        if not shutil.which("openssl"):
            self.skipTest("openssl is not installed")
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.certificate, self.key = self.folder / "scanner.pem", self.folder / "scanner.key"
        subprocess.run(
            [
                "openssl",
                "req",
                "-x509",
                "-newkey",
                "ec",
                "-pkeyopt",
                "ec_paramgen_curve:P-256",
                "-nodes",
                "-days",
                "2",
                "-keyout",
                self.key,
                "-out",
                self.certificate,
                "-subj",
                f"/CN={NAME}",
                "-addext",
                f"subjectAltName=DNS:{NAME}",
            ],
            check=True,
            capture_output=True,
        )
        subprocess.run(
            [PROGRAM, "serve", "--set-password"],
            input=PASSWORD + "\n",
            text=True,
            check=True,
            capture_output=True,
            env={**os.environ, "XDG_CONFIG_HOME": str(self.folder)},
        )

    def serve(self, start):
        """Checks a proxy. `start(port of the proxy, port of the server)` returns its command."""
        port = free_port()
        # The address that users write has no port: --allowed-host is the name, as the page says, with the port under test.
        server = Proxied(
            self.folder, "--behind-proxy", "--allowed-host", f"{NAME}:{port}", XDG_CONFIG_HOME=str(self.folder)
        )
        proxy = None
        try:
            with open(self.folder / "log", "wb") as log:
                proxy = subprocess.Popen(
                    start(port, server.port),
                    stdout=log,
                    stderr=log,
                    env={**os.environ, "HOME": str(self.folder), "XDG_DATA_HOME": str(self.folder)},
                )
            server.reach(port)
            self.wait_for(server, proxy)
            self.check(server)
            self.check_browser(server)
        except BaseException:
            print((self.folder / "log").read_text()[-3000:])
            raise
        finally:
            if proxy:
                proxy.terminate()
                proxy.wait(PATIENCE)
            self.assertEqual(server.stop(), 0)

    def wait_for(self, server, proxy):
        end = time.monotonic() + PATIENCE
        while True:
            with contextlib.suppress(OSError):
                server.connect(2).close()
                return
            self.assertIsNone(proxy.poll(), "the proxy ended")
            self.assertLess(time.monotonic(), end, "the proxy does not answer")
            time.sleep(0.1)

    def check(self, server):
        origin = {"Origin": server.origin}
        self.assertTrue(server.url.startswith(f"{server.origin}/#token="))
        status, head, page = server.ask("GET", "/", key=None)
        self.assertEqual(status, 200)
        self.assertGreater(len(page), 200)
        self.assertIn(f"wss://{server.host}", head)
        # Another name of the proxy receives no page, be it from the proxy or the server.
        for host in ("evil.example", f"evil.example:{server.proxy}", f"{NAME}.evil.example"):
            status, _, body = server.ask("GET", "/", key=None, Host=host)
            self.assertTrue(status in (400, 403, 404, 421) or body == b"", (host, status))
        for foreign in ("https://evil.example", f"http://{server.host}", "null"):
            self.assertEqual(
                server.ask("POST", "/api/session", {"password": PASSWORD}, key=None, Origin=foreign)[0], 403, foreign
            )
            self.assertEqual(server.upgrade(Origin=foreign), 403, foreign)
        self.assertEqual(server.ask("GET", "/api/state", Sec_Fetch_Site="cross-site")[0], 403)
        self.assertEqual(server.ask("GET", "/api/state")[0], 401)
        self.assertEqual(
            server.ask("POST", "/api/session", {"password": "a wrong password"}, key=None, **origin)[0], 403
        )
        status, _, body = server.ask("POST", "/api/session", {"password": PASSWORD}, key=None, **origin)
        self.assertEqual(status, 200)
        server.key = json.loads(body)["key"]
        self.assertEqual(server.ask("GET", "/api/state", **origin)[0], 200)
        # The server answers before the whole body has arrived; a proxy that still sends it may say that the line broke.
        self.assertIn(server.ask("POST", "/api/commands/edit", b" " * 2_000_000)[0], (413, 502))
        line = server.upgrade(**origin)
        self.assertIsInstance(line, socket.socket)
        line.sendall(frame(json.dumps({"type": "hello", "key": server.key}).encode()))
        self.assertEqual(json.loads(read_frame(line)[1])["type"], "state")
        server.command("create-project", name="proxied", part="plate", stations=2)
        while not (json.loads(read_frame(line)[1])["state"]["project"] or {}).get("name") == "proxied":
            pass
        line.close()
        server.wait()
        server.command("close-project")

    def check_browser(self, server):
        """A person at another machine: the page, the password, the projects."""
        if not (shutil.which("chromium") and shutil.which("node") and os.environ.get("FRANGIA_WEB")):
            print("not tried in a browser: chromium, node or FRANGIA_WEB is missing")
            return
        done = subprocess.run(
            ["node", HERE / "password.mjs", server.origin, PASSWORD],
            capture_output=True,
            text=True,
            timeout=3 * PATIENCE,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_caddy(self):
        if not shutil.which("caddy"):
            self.skipTest("caddy is not installed")

        def start(port, behind):
            # A test neither asks for certificates nor listens on port 80 or that of Caddy's administration.
            text = "{\n    admin off\n    auto_https disable_redirects\n}\n" + replaced(
                block_with("reverse_proxy"),
                (f"{NAME} {{", f"{NAME}:{port} {{"),
                ("127.0.0.1:6328", f"127.0.0.1:{behind}"),
                ("/etc/ssl/scanner.pem", str(self.certificate)),
                ("/etc/ssl/private/scanner.key", str(self.key)),
            )
            (self.folder / "Caddyfile").write_text(text)
            return ["caddy", "run", "--config", str(self.folder / "Caddyfile"), "--adapter", "caddyfile"]

        self.serve(start)

    def test_nginx(self):
        nginx = shutil.which("nginx", path=os.environ["PATH"] + ":/usr/sbin")
        if not nginx:
            self.skipTest("nginx is not installed")

        def start(port, behind):
            site = replaced(
                block_with("proxy_pass"),
                ("listen 443 ssl", f"listen 127.0.0.1:{port} ssl"),
                ("127.0.0.1:6328", f"127.0.0.1:{behind}"),
                ("/etc/ssl/scanner.pem", str(self.certificate)),
                ("/etc/ssl/private/scanner.key", str(self.key)),
            )
            own = "".join(
                f"{name}_temp_path {self.folder}/{name};\n"
                for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
            )
            user = "user root;\n" if os.getuid() == 0 else ""
            (self.folder / "nginx.conf").write_text(
                f"{user}daemon off;\npid {self.folder}/nginx.pid;\nerror_log stderr;\nevents {{}}\nhttp {{\naccess_log off;\n{own}{site}}}\n"
            )
            return [nginx, "-e", "stderr", "-p", str(self.folder), "-c", str(self.folder / "nginx.conf")]

        self.serve(start)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
