"""A server that hostile clients attack, with files around its projects that no request may reach."""
import pathlib
import random
import tempfile
import unittest

from serve_client import Server


def below(folder):
    """All files and folders below a folder, with the size of the files."""
    return {
        path.relative_to(folder): path.stat().st_size if path.is_file() else -1
        for path in pathlib.Path(folder).rglob("*")
    }


class HostileServer(unittest.TestCase):
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
