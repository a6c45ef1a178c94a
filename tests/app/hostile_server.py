"""A server that hostile clients attack, with files around its projects that no request may reach."""
import pathlib
import random

from serve_client import ServerTest


def below(folder):
    """All files and folders below a folder, with the size of the files."""
    return {
        path.relative_to(folder): path.stat().st_size if path.is_file() else -1
        for path in pathlib.Path(folder).rglob("*")
    }


class HostileServer(ServerTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.secret = pathlib.Path(cls.folder.name) / "secret.txt"
        cls.secret.write_text("a secret")
        (pathlib.Path(cls.folder.name) / "evil").write_text("a secret")

    def setUp(self):
        self.server.wait()
        name = f"p{random.randrange(10**9)}"
        self.server.command("create-project", name=name, part="plate", stations=3)
        self.server.wait()
        self.project = self.server.projects / name

    def around(self):
        """Everything around the projects."""
        return {path: size for path, size in below(self.folder.name).items() if path.parts[0] != "projects"}
