"""What befalls `frangia serve` beside clients: killed servers, full disks, folders that others use, signals.

    robust_test.py PROGRAM
"""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from serve_client import PATIENCE, PROGRAM, SLOWDOWN, Server, frame, read_frame


def frames_of(folder):
    return {path.relative_to(folder): path.read_bytes() for path in (pathlib.Path(folder) / "views").rglob("*.png")}


def processor_seconds_of(pid):
    """Processor time of a process that runs."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def processor_seconds_of_children():
    """Processor time of the processes that this one has waited for."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Robust(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.servers = []

    def tearDown(self):
        for server in self.servers:
            if server.process.poll() is None:
                server.stop()

    def serve(self, *arguments, **options):
        runtime = self.folder / f"server-{len(self.servers)}"
        runtime.mkdir()
        server = Server(runtime, *arguments, projects=self.folder / "projects", **options)
        self.servers.append(server)
        server.login()
        return server

    def wait_until(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.05)

    def slow_project(self, server, table="", exposure_ms=1000, stations=3):
        """A project whose exposures take a second, so that a scan can be interrupted long before its end."""
        server.command("create-project", name="part", part="plate", stations=stations)
        server.wait()
        server.coarsen_camera("part")
        rig = server.projects / "part" / "rig.toml"
        text = rig.read_text().replace(
            "[devices.camera]\n", f"[devices.camera]\nreal_time = true\nreference_exposure_ms = {exposure_ms}\n"
        )
        if table:
            self.assertIn('home = "switch"', text)
            text = text.replace('home = "switch"', table)
        rig.write_text(text)
        server.command("set-capture", exposure_ms=exposure_ms)
        return server.projects / "part"

    def scan_share(self, server):
        return next(
            (job["progress"] for job in server.state()["jobs"] if job["kind"] == "scan" and job["state"] == "running"),
            0,
        )

    def test_a_killed_scan_asks_for_the_angle_of_a_table_without_a_home_switch(self):
        server = self.serve()
        project = self.slow_project(server, table='home = "here"')
        server.command("start-scan")
        self.wait_until(lambda: self.scan_share(server) > 0.05, "the scan does not begin")
        server.process.kill()
        server.process.wait(PATIENCE)
        server.process.stdout.close()

        rig = project / "rig.toml"
        rig.write_text(rig.read_text().replace("real_time = true\n", ""))  # from here on, exposures take no time
        server = self.serve()
        server.command("open-project", name="part")
        self.assertIsNone(server.wait()["project"]["table_angle"])
        server.command("start-scan")
        state = server.wait()
        self.assertFalse(state["project"]["scan_complete"])
        self.assertIn("home switch", state["jobs"][-1]["error"])
        self.assertIn("state its present angle", state["jobs"][-1]["error"])
        self.assertIsNotNone(state["project"]["table_angle"])
        # The simulated table stands at 0 when it is opened: as if somebody had turned it there.
        server.command("start-scan", table_deg=0)
        state = server.wait()
        self.assertTrue(state["project"]["scan_complete"], state["jobs"][-1])
        self.assertIsNone(state["project"]["table_angle"])
        self.assertEqual(server.stop(), 0)
        done = subprocess.run(
            [PROGRAM, "scan", project / "rig.toml", "-o", self.folder / "whole", "--views", "3", "--exposure", "1000"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        whole, resumed = frames_of(self.folder / "whole"), frames_of(project / "scan")
        self.assertEqual(set(resumed), set(whole))
        self.assertGreater(len(whole), 30)
        for name, data in whole.items():
            self.assertEqual(resumed[name], data, name)

    def test_one_server_at_a_time_has_a_project_open(self):
        first, second = self.serve(), self.serve()
        first.command("create-project", name="part", part="plate")
        first.wait()
        status, _, body = second.ask("POST", "/api/commands/open-project", {"name": "part"})
        self.assertEqual(status, 400)
        self.assertIn(f"process {first.process.pid}", json.loads(body)["error"])
        self.assertIsNone(second.state()["project"])
        done = subprocess.run(
            [PROGRAM, "serve", "--port", "0", self.folder / "projects" / "part"],
            capture_output=True,
            text=True,
            env=second.environment,
            timeout=PATIENCE,
        )
        self.assertEqual(done.returncode, 3)
        self.assertIn(f"process {first.process.pid}", done.stderr)
        # It opens again where it is open already, and elsewhere once it was closed.
        first.command("open-project", name="part")
        first.wait()
        first.command("close-project")
        second.command("open-project", name="part")
        self.assertEqual(second.wait()["project"]["name"], "part")
        # Nor does a project stay locked by a server that was killed.
        second.process.kill()
        second.process.wait(PATIENCE)
        second.process.stdout.close()
        first.command("open-project", name="part")
        self.assertEqual(first.wait()["project"]["name"], "part")

    def test_a_port_in_use_is_named_and_the_usual_one_gives_way(self):
        server = self.serve()
        done = subprocess.run(
            [PROGRAM, "serve", "--port", str(server.port), "--projects", self.folder / "other"],
            capture_output=True,
            text=True,
            env=server.environment,
            timeout=PATIENCE,
        )
        self.assertEqual(done.returncode, 4)
        self.assertIn(str(server.port), done.stderr)
        self.assertIn("in use", done.stderr)
        self.assertFalse((self.folder / "other").exists())
        self.assertEqual(server.ask("GET", "/api/state")[0], 200)
        with contextlib.suppress(OSError), socket.create_server(("127.0.0.1", 6328)):
            process = subprocess.Popen(
                [PROGRAM, "--json", "serve", "--projects", self.folder / "other"],
                stdout=subprocess.PIPE,
                env={**os.environ, "XDG_RUNTIME_DIR": str(self.folder)},
                text=True,
            )
            try:
                text = ""
                while "}" not in text:
                    text += process.stdout.readline()
                self.assertNotIn(":6328/", json.loads(text)["url"])
            finally:
                process.terminate()
                process.wait(PATIENCE)
                process.stdout.close()

    def test_a_folder_that_nobody_may_write_to_is_looked_at(self):
        server = self.serve()
        server.command("create-project", name="part", part="plate", stations=4)
        server.wait()
        server.coarsen_camera("part")
        server.command("start-scan")
        self.assertTrue(server.wait()["project"]["scan_complete"])
        server.command("reconstruct")
        triangles = server.wait()["project"]["surface"]["triangles"]
        self.assertEqual(server.stop(), 0)
        project = self.folder / "projects" / "part"
        paths = [project, *project.rglob("*")]
        user = {}
        if os.getuid() == 0:  # to whom permissions mean nothing
            user = {"wrapper": ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")}
            for path in (self.folder, self.folder / "projects"):
                path.chmod(0o755)
        for path in paths:
            path.chmod(0o555 if path.is_dir() else 0o444)
        try:
            runtime = self.folder / "reader"
            runtime.mkdir()
            (runtime / "run").mkdir()
            for path in (runtime, runtime / "run"):
                path.chmod(0o777)
            server = Server(runtime, projects=self.folder / "projects", **user)
            self.servers.append(server)
            server.login()
            server.command("open-project", name="part")
            state = server.wait()
            self.assertEqual(state["project"]["surface"]["triangles"], triangles)
            self.assertEqual(server.ask("GET", "/api/mesh")[0], 200)
            # What writes fails in words, and leaves what is there.
            for command, arguments in (
                ("export", {"format": "stl"}),
                ("edit", {"operation": "fill-holes", "value": "5mm"}),
                ("reconstruct", {}),
            ):
                server.command(command, **arguments)
                job = server.wait()["jobs"][-1]
                self.assertEqual(job["state"], "failed", command)
                self.assertRegex(job["error"], "part.*(denied|cannot|permission)", command)
            status, _, body = server.ask("POST", "/api/commands/create-project", {"name": "new"})
            self.assertEqual(status, 400)
            self.assertIn("new", json.loads(body)["error"])
            state = server.wait()
            self.assertEqual(state["project"]["surface"]["triangles"], triangles)
            self.assertEqual(server.ask("GET", "/api/mesh")[0], 200)
            self.assertEqual(server.stop(), 0)
        finally:
            for path in paths:
                path.chmod(0o755 if path.is_dir() else 0o644)
        self.assertEqual(
            sorted(path.relative_to(project) for path in paths[1:]),
            sorted(path.relative_to(project) for path in project.rglob("*")),
        )

    def test_a_full_disk_is_said_in_words_and_loses_nothing(self):
        disk = self.folder / "projects"
        disk.mkdir()
        # A disk of 20 MB that the server alone sees; this test reaches it through /proc.
        unshare = [
            "unshare",
            "-m",
            *([] if os.getuid() == 0 else ["-r"]),
            "sh",
            "-c",
            f'mount -t tmpfs -o size=20m none "{disk}" && exec "$@"',
            "sh",
        ]
        if not shutil.which("unshare") or subprocess.run([*unshare, "true"], capture_output=True).returncode != 0:
            self.skipTest("this user may not mount a small disk (unshare -m)")
        server = self.serve(wrapper=unshare)
        seen = pathlib.Path(f"/proc/{server.process.pid}/root{disk}")
        server.command("create-project", name="part", part="plate", stations=4)
        server.wait()
        server.coarsen_camera("part", projects=seen)
        server.command("start-scan")
        server.wait()
        server.command("reconstruct")
        server.wait()
        server.command("export", format="stl")
        before = server.wait()["project"]
        files = {path: path.read_bytes() for path in (seen / "part").rglob("*") if path.is_file()}
        filler = seen / "filler"
        with open(filler, "wb", buffering=0) as file, contextlib.suppress(OSError):
            while True:
                file.write(b"x" * 4096)
        for command, arguments in (
            ("export", {"format": "obj"}),
            ("export", {"format": "stl"}),
            ("export", {"format": "zip"}),
            ("edit", {"operation": "fill-holes", "value": "5mm"}),
            ("reconstruct", {}),
        ):
            server.command(command, **arguments)
            job = server.wait()["jobs"][-1]
            self.assertEqual(job["state"], "failed", (command, arguments))
            self.assertRegex(job["error"], "No space left|disk (is|may be) full", command)
        for command, arguments in (("create-project", {"name": "other", "part": "plate"}),):
            status, _, body = server.ask("POST", f"/api/commands/{command}", arguments)
            self.assertEqual(status, 400)
            self.assertRegex(json.loads(body)["error"], "No space left|disk (is|may be) full")
        after = server.wait()["project"]
        self.assertEqual(after["exports"], before["exports"])
        self.assertEqual(after["surface"]["triangles"], before["surface"]["triangles"])
        for path, data in files.items():
            self.assertEqual(path.read_bytes(), data, path)
        # With room again, it goes on.
        filler.unlink()
        for command, arguments in (
            ("edit", {"operation": "fill-holes", "value": "5mm"}),
            ("export", {"format": "obj"}),
        ):
            server.command(command, **arguments)
            self.assertEqual(server.wait()["jobs"][-1]["state"], "done", command)

    def test_ctrl_c_ends_with_less_than_a_second_of_work_with_clients_connected(self):
        for sign in (signal.SIGINT, signal.SIGTERM):
            for work in ("nothing", "live", "scan", "reconstruct"):
                with self.subTest(sign=sign.name, work=work):
                    self.assertLess(self.processor_seconds_to_end(sign, work, f"{work} {sign.name}"), 1 * SLOWDOWN)

    def processor_seconds_to_end(self, sign, work, name):
        server = self.serve()
        server.command("create-project", name=name, part="plate", stations=4)
        server.wait()
        server.coarsen_camera(name)
        if work == "reconstruct":
            server.command("start-scan")
            server.wait()
        lines = [server.connect() for _ in range(20)]
        for line in lines[:10]:
            line.sendall(b"GET /api/st")
        lines += [server.upgrade(), server.live()]
        lines[-1].sendall(frame(b'{"type": "show", "layer": "points"}'))
        if work == "live":
            server.command("start-live")
            opcode = 1
            while opcode != 2:
                opcode, _ = read_frame(lines[-1])
        elif work != "nothing":
            server.command("start-scan" if work == "scan" else "reconstruct")
            self.wait_until(lambda: any(job["state"] == "running" for job in server.state()["jobs"]), "no job runs")
            time.sleep(0.5)
        others = processor_seconds_of_children()
        before = processor_seconds_of(server.process.pid)
        server.process.send_signal(sign)
        code = server.process.wait(PATIENCE)
        spent = processor_seconds_of_children() - others - before
        server.process.stdout.close()
        for line in lines:
            line.close()
        self.assertEqual(code, 0)
        self.assertFalse((server.runtime / "frangia-serve.json").exists())
        return spent

    def test_open_serves_with_any_browser_and_without_one(self):
        tools = self.folder / "tools"
        tools.mkdir()
        stays = f'echo $$ >"{self.folder}/pid"; cp -p "$1" "{self.folder}/page"; echo "$@" >"{self.folder}/shown"; exec sleep 1000'
        for name, text in (("ends", "exit 0"), ("fails", "exit 3"), ("stays", stays), ("missing", None)):
            with self.subTest(browser=name):
                opener = tools / "xdg-open"
                opener.unlink(missing_ok=True)
                if text:
                    opener.write_text(f"#!/bin/sh\n{text}\n")
                    opener.chmod(0o755)
                log = self.folder / f"{name}.log"
                with open(log, "w") as stderr:
                    server = self.serve("--open", stderr=stderr, PATH=f"{tools}:/bin:/usr/bin" if text else str(tools))
                self.assertEqual(server.ask("GET", "/api/state")[0], 200)
                if name == "stays":  # as a browser does without a desktop
                    shown = self.folder / "shown"
                    self.wait_until(lambda: shown.exists() and shown.read_text().endswith("\n"), "nothing is shown")
                    # Other users read the command line, but not the page that it names.
                    self.assertNotIn(server.token, shown.read_text())
                    page = self.folder / "page"
                    self.assertIn(f'url={server.url}"', page.read_text())
                    self.assertEqual(page.stat().st_mode & 0o777, 0o600)
                if name in ("fails", "missing"):
                    self.wait_until(lambda: "open it yourself" in log.read_text(), "no word")
                self.assertEqual(server.stop(), 0)  # it does not wait for the browser
                self.assertEqual(list(server.runtime.iterdir()), [])
                self.assertEqual("open it yourself" in log.read_text(), name in ("fails", "missing"))
        os.kill(int((self.folder / "pid").read_text()), signal.SIGTERM)

    def test_a_project_whose_folder_is_deleted_is_said_in_words(self):
        server = self.serve()
        server.command("create-project", name="part", part="plate", stations=2)
        server.wait()
        shutil.rmtree(self.folder / "projects" / "part")
        for command in ("start-scan", "test-devices", "start-live"):
            status, _, body = server.ask("POST", f"/api/commands/{command}", {})
            if status == 200:
                job = server.wait()["jobs"][-1]
                self.assertEqual(job["state"], "failed", command)
                self.assertTrue(job["error"], command)
            else:
                self.assertTrue(json.loads(body)["error"])
        self.assertEqual(server.ask("GET", "/api/state")[0], 200)
        server.command("close-project")
        server.command("create-project", name="part", part="plate", stations=2)
        self.assertEqual(server.wait()["project"]["name"], "part")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
