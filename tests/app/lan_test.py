"""Tablets in the network of `frangia serve`: plain or encrypted with a certificate that the machine made itself.

    lan_test.py PROGRAM
"""
import hashlib
import json
import os
import pathlib
import socket
import ssl
import subprocess
import sys
import tempfile
import unittest

from serve_client import PATIENCE, PROGRAM, Server


class Lan(unittest.TestCase):
    def test_lets_tablets_in_with_a_certificate_whose_fingerprint_is_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            server = Server(folder, XDG_CONFIG_HOME=folder)
            try:
                server.login()
                addresses = json.loads(server.ask("GET", "/api/lan")[2])["addresses"]
                if not addresses:
                    self.skipTest("this machine is in no network")

                def opened(**wanted):
                    status, _, body = server.ask("POST", "/api/lan", {"address": addresses[0], **wanted})
                    self.assertEqual(status, 200, body)
                    return json.loads(body)["open"]

                self.assertEqual(server.ask("POST", "/api/lan", {"address": addresses[0], "encrypted": 1})[0], 400)
                plain = opened()
                self.assertTrue(plain["url"].startswith("http://"))
                self.assertEqual(plain["fingerprint"], "")
                encrypted = opened(encrypted=True)
                url = encrypted["url"]
                self.assertTrue(url.startswith(f"https://{addresses[0]}:"), url)
                self.assertTrue(encrypted["link"].startswith(f"{url}/#token="))
                port = int(url.rsplit(":", 1)[1])

                # A stranger sees the fingerprint that stands on the page, and the page's own requests are served.
                context = ssl.create_default_context()
                context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
                certificate = ssl.get_server_certificate((addresses[0], port))
                seen = hashlib.sha256(ssl.PEM_cert_to_DER_cert(certificate)).hexdigest().upper()
                self.assertEqual(":".join(seen[i : i + 2] for i in range(0, 64, 2)), encrypted["fingerprint"])
                stored = pathlib.Path(folder) / "frangia" / "serve-certificate.pem"
                self.assertEqual(stored.stat().st_mode & 0o777, 0o600)

                tablet = Tablet(server, addresses[0], port, ssl.create_default_context(cadata=certificate))
                self.assertIn(f"wss://{tablet.host}", tablet.ask("GET", "/", key=None)[1])
                token = {"token": encrypted["link"].split("#token=")[1]}
                for origin, status in ((f"http://{tablet.host}", 403), (url, 200)):
                    answer = tablet.ask("POST", "/api/session", token, key=None, Origin=origin)
                    self.assertEqual(answer[0], status, answer)
                tablet.key = json.loads(answer[2])["key"]
                self.assertEqual(tablet.ask("GET", "/api/state")[0], 200)
                tablet.live().close()
                self.assertEqual(tablet.ask("GET", "/api/lan")[0], 403)  # nobody lets others in from there

                # The certificate stays the same.
                self.assertEqual(opened()["fingerprint"], "")
                self.assertEqual(opened(encrypted=True)["fingerprint"], encrypted["fingerprint"])
            finally:
                self.assertEqual(server.stop(), 0)

    def test_listens_beyond_this_machine_with_the_same_certificate(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [PROGRAM, "serve", "--set-password"],
                env={**os.environ, "XDG_CONFIG_HOME": folder},
                input="a long password\n",
                text=True,
                timeout=PATIENCE,
            )
            self.assertEqual(done.returncode, 0)
            fingerprints = []
            for _ in range(2):
                server = Server(folder, "--listen", "0.0.0.0", "--allowed-host", "scanner.test", XDG_CONFIG_HOME=folder)
                try:
                    self.assertTrue(server.url.startswith("https://scanner.test/#token="), server.url)
                    certificate = ssl.get_server_certificate(("127.0.0.1", server.port))
                    fingerprints.append(hashlib.sha256(ssl.PEM_cert_to_DER_cert(certificate)).hexdigest().upper())
                    context = ssl.create_default_context()
                    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
                    tablet = Tablet(server, "127.0.0.1", server.port, context)
                    tablet.host = "scanner.test"
                    wanted = {"password": "a long password"}
                    for origin, status in (("http://scanner.test", 403), ("https://scanner.test", 200)):
                        answer = tablet.ask("POST", "/api/session", wanted, key=None, Origin=origin)
                        self.assertEqual(answer[0], status, answer)
                    # Nothing is answered without encryption.
                    self.assertNotIn(b"200 OK", server.raw(b"GET / HTTP/1.1\r\nHost: scanner.test\r\n\r\n", 2))
                    self.assertEqual(":".join(fingerprints[-1][i : i + 2] for i in range(0, 64, 2)), server.fingerprint)
                finally:
                    self.assertEqual(server.stop(), 0)
            self.assertEqual(*fingerprints)


class Tablet(Server):
    """A client of the second address of a server, which verifies its certificate."""

    def __init__(self, server, address, port, context):
        self.address, self.port, self.context = address, port, context
        self.host, self.key = f"{address}:{port}", None

    def connect(self, timeout=PATIENCE):
        line = socket.create_connection((self.address, self.port), timeout)
        return self.context.wrap_socket(line, server_hostname=self.address)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
