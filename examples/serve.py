#!/usr/bin/env python3
"""Scans the simulated rig through a running `frangia serve`, fills the holes and exports a DXF.

    frangia serve &
    python3 examples/serve.py
"""
import json
import os
import pathlib
import time
import urllib.request

server = json.loads((pathlib.Path(os.environ["XDG_RUNTIME_DIR"]) / "frangia-serve.json").read_text())
ADDRESS = f"http://127.0.0.1:{server['port']}"


def ask(path, arguments=None):
    """GET without arguments, POST with them."""
    request = urllib.request.Request(
        ADDRESS + path,
        headers={"Authorization": f"Bearer {server['key']}", "Content-Type": "application/json"},
        data=None if arguments is None else json.dumps(arguments).encode(),
    )
    with urllib.request.urlopen(request) as answer:
        return answer.read()


def command(which, /, **arguments):
    """Runs a command and waits for its job."""
    job = json.loads(ask(f"/api/commands/{which}", arguments)).get("job")
    while True:
        state = json.loads(ask("/api/state"))
        running = [one for one in state["jobs"] if one["state"] in ("waiting", "running")]
        if not running:
            break
        time.sleep(0.2)
    for one in state["jobs"]:
        if one["number"] == job and one["state"] != "done":
            raise SystemExit(f"{which}: {one['error'] or one['state']}")
    return state["project"]


name = time.strftime("example %Y-%m-%d %H-%M-%S")
command("create-project", name=name, part="bracket", stations=6)
project = command("start-scan")
print("points of each station:", [station["points"] for station in project["stations"]])
surface = command("reconstruct")["surface"]
print(
    f"{surface['triangles']} triangles, sigma {1000 * surface['sigma_mm']['combined']:.1f} um, {surface['hole_count']} holes"
)
command("edit", operation="fill-holes", value="10mm")
exports = command("export", format="dxf")["exports"]
pathlib.Path("part.dxf").write_bytes(ask("/api/exports/" + urllib.request.quote(exports[0]["name"])))
print("wrote part.dxf")
