"""Access to `frangia serve` from other machines: an explicit choice, a password, no guessing.

    access_test.py PROGRAM
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from serve_client import PATIENCE, PROGRAM, Server


class Access(unittest.TestCase):
    def test_needs_an_explicit_choice_and_a_password(self):
        with tempfile.TemporaryDirectory() as folder:
            config = {"XDG_CONFIG_HOME": folder, "XDG_RUNTIME_DIR": folder}

            def refusal(*arguments):
                done = subprocess.run(
                    [PROGRAM, "serve", "--port", "0", *arguments],
                    env={**os.environ, **config},
                    capture_output=True,
                    text=True,
                    timeout=PATIENCE,
                )
                self.assertNotEqual(done.returncode, 0, arguments)
                return done.stderr

            self.assertIn("--allowed-host", refusal("--listen", "0.0.0.0"))
            self.assertIn("--set-password", refusal("--listen", "0.0.0.0", "--allowed-host", "scanner.test:6328"))
            self.assertIn("--allowed-host", refusal("--behind-proxy"))
            self.assertIn("--allowed-host", refusal("--listen", "0.0.0.0", "--plain-lan"))
            self.assertIn("--set-password", refusal("--listen", "127.0.0.2", "--plain-lan"))
            self.assertIn(
                "exclude", refusal("--listen", "127.0.0.2", "--plain-lan", "--behind-proxy", "--allowed-host", "x")
            )
            for password, code in (("short\n", 3), ("a long password\n", 0)):
                done = subprocess.run(
                    [PROGRAM, "serve", "--set-password"],
                    env={**os.environ, **config},
                    input=password,
                    text=True,
                    capture_output=True,
                    timeout=PATIENCE,
                )
                self.assertEqual(done.returncode, code, done.stderr)
            stored = pathlib.Path(folder) / "frangia" / "serve-password"
            self.assertEqual(stored.stat().st_mode & 0o777, 0o600)
            self.assertTrue(stored.read_text().startswith("$argon2id$"))

            proxied = Server(folder, "--behind-proxy", "--allowed-host", "scanner.test", XDG_CONFIG_HOME=folder)
            try:
                self.assertTrue(proxied.url.startswith("https://scanner.test/#token="))
                proxied.host = "scanner.test"
                self.assertIn("wss://scanner.test", proxied.ask("GET", "/", key=None)[1])
                self.assertEqual(proxied.ask("GET", "/", key=None, Host="evil.example")[0], 403)
                origin = {"Origin": "https://scanner.test"}
                self.assertEqual(
                    proxied.ask("POST", "/api/session", {"password": "a wrong password"}, key=None, **origin)[0], 403
                )
                self.assertEqual(
                    proxied.ask(
                        "POST", "/api/session", {"password": "a long password"}, key=None, Origin="http://scanner.test"
                    )[0],
                    403,
                )
                answer = proxied.ask("POST", "/api/session", {"password": "a long password"}, key=None, **origin)
                self.assertEqual(answer[0], 200)
                proxied.key = json.loads(answer[2])["key"]
                self.assertEqual(proxied.ask("GET", "/api/state", **origin)[0], 200)
                # The proxy names the client last; what stands before it the client may have written.
                guesser, other = {"X-Forwarded-For": "10.0.0.9, 10.0.0.66"}, {"X-Forwarded-For": "10.0.0.9"}
                for _ in range(8):
                    guess = proxied.ask("POST", "/api/session", {"password": "a wrong guess"}, key=None, **guesser)
                self.assertEqual(guess[0], 429)
                self.assertIn("too many wrong passwords from 10.0.0.66", json.loads(guess[2])["error"])
                self.assertEqual(
                    proxied.ask("POST", "/api/session", {"password": "a long password"}, key=None, **other)[0], 200
                )
                link = json.loads(proxied.ask("POST", "/api/links", {}, **guesser)[2])["url"]
                token = {"token": link.split("#token=")[1]}
                self.assertEqual(proxied.ask("POST", "/api/session", token, key=None, **guesser)[0], 200)
                self.assertEqual(proxied.ask("GET", "/api/state", **guesser)[0], 200)
            finally:
                self.assertEqual(proxied.stop(), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
