"""Runs the blocks of README.md and docs as a newcomer pastes them: tutorials_test.py [OPTIONS] [PAGE...]

    --build BUILD     the build tree; it appears as build/release to the blocks (default: build/release)
    --slow            runs the blocks that take minutes as well, and only pages that have one
    --count           runs nothing: checks how the blocks are marked, and prints how many are
    -v                shows what the blocks print

The blocks of a page are run in their order, in one temporary folder that looks like a clone of the repository. ```sh blocks
share their variables, ```python blocks their names. Above a block may stand

    <!-- file: NAME -->          it is written to that file
    <!-- until Ctrl-C -->        it is stopped when it has printed an address
    <!-- not run: REASON -->     hardware, network, builds the repository, or takes minutes; then `./run docs --check` runs it

and a comment that begins with `<!-- before` holds commands for what the reader already has, such as images of a camera.
"""
import argparse
import collections
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable
REASONS = ("hardware", "network", "builds the repository", "takes minutes")
SHOWN = ("toml", "json", "text", "nginx", "caddy", "cpp", "cmake", "ts")  # languages that are not run
SLOW = "takes minutes"
OF_THE_USER = ("DISPLAY", "WAYLAND_DISPLAY", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME")
TIMEOUT_S = 1200
PIECE = re.compile(
    r"^<!-- before\n(?P<before>.*?)^-->$|"
    r"^(?:<!-- (?P<mark>[^\n]*) -->\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$|"
    r"(?:^|\n)\n(?P<indented> {4}[^\n]*)",
    re.MULTILINE | re.DOTALL,
)
WORKER = """
import os, sys, traceback
scope = {"__name__": "__main__"}
for path in map(str.strip, sys.stdin):
    try:
        exec(compile(open(path).read(), path, "exec"), scope)
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    sys.stdout.flush()
    os.write(3, b"+")
"""


class Failure(Exception):
    pass


Block = collections.namedtuple("Block", "kind text name reason line")  # kind: before, file, sh, python, stopped, shown


def block_of(match, line):
    if match["before"] is not None:
        return Block("before", match["before"], None, None, line)
    if match["indented"] is not None:
        raise Failure(f"line {line}: an indented block; fence it, with its language")
    mark, language, text = match["mark"] or "", match["language"], match["text"]
    if mark.startswith("file: "):
        return Block("file", text, mark.removeprefix("file: "), None, line)
    if mark.startswith("not run: "):
        reason = next((one for one in REASONS if mark.removeprefix("not run: ").startswith(one)), None)
        if reason is None:
            raise Failure(f"line {line}: '{mark}' gives none of the reasons {', '.join(REASONS)}")
        return Block(language, text, None, reason, line)
    if mark == "until Ctrl-C":
        return Block("stopped", text, None, None, line)
    if language not in ("sh", "python", *SHOWN):
        raise Failure(f"line {line}: a block of '{language}'; name its language: sh, python, {', '.join(SHOWN)}")
    return Block(language if language not in SHOWN else "shown", text, None, None, line)


def blocks_of(page):
    text = page.read_text()
    return [block_of(match, text.count("\n", 0, match.end()) + 1) for match in PIECE.finditer(text)]


def pages():
    return [
        SOURCE / "README.md",
        *sorted((SOURCE / "docs").glob("*.md")),
        *sorted((SOURCE / "docs/tutorials").glob("*.md")),
    ]


class Session:
    """What a reader has open while reading a page: a terminal in a clone of the repository, and Python."""

    def __init__(self, folder, build, page):
        self.folder = pathlib.Path(folder)
        for name in ("examples", "tests"):
            (self.folder / name).symlink_to(SOURCE / name)
        (self.folder / "build").mkdir()
        (self.folder / "build" / "release").symlink_to(build)
        ours = {name: value for name, value in os.environ.items() if name not in OF_THE_USER}
        self.environment = {
            **ours,
            "HOME": folder,
            "XDG_RUNTIME_DIR": folder,
            "PYTHONPATH": str(build / "python"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        if page.name == "README.md":  # which says how these are set
            del self.environment["PYTHONPATH"]
        else:
            self.environment["PATH"] = f"{build / 'bin'}:{os.environ['PATH']}"
        self.variables = self.folder / ".variables"
        self.output = open(self.folder / ".output", "w+")
        self.python = None

    def start(self, script):
        """A shell with the variables and the folder that earlier blocks left."""
        begin = f". {self.variables}\n" if self.variables.exists() else ""
        end = f"\n{{ export -p; echo \"cd '$PWD'\"; }} >{self.variables}\n"
        return subprocess.Popen(
            ["sh", "-euc", begin + script + end],
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=self.output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    def said(self):
        self.output.flush()
        return (self.folder / ".output").read_text(errors="replace")

    def run(self, block):
        if block.kind in ("sh", "before"):
            process = self.start(block.text)
            try:
                code = process.wait(TIMEOUT_S)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                raise Failure(f"this did not end within {TIMEOUT_S} s") from None
            if code != 0:
                raise Failure(f"this ended with {code}")
        elif block.kind == "stopped":
            self.run_until_address(block)
        elif block.kind == "python":
            self.run_python(block)
        elif block.kind == "file":
            path = self.folder / block.name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text)

    def run_until_address(self, block):
        process = self.start(block.text)
        deadline = time.monotonic() + TIMEOUT_S
        while "http://" not in self.said() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.05)
        if process.poll() is not None:
            raise Failure(f"this ended with {process.returncode} and without an address")
        os.killpg(process.pid, signal.SIGINT)
        process.wait(TIMEOUT_S)

    def run_python(self, block):
        if self.python is None:
            self.done, write = os.pipe()
            self.python = subprocess.Popen(
                ["sh", "-c", f'exec "$@" 3>&{write}', "sh", PYTHON, "-c", WORKER],
                cwd=self.folder,
                env=self.environment,
                stdin=subprocess.PIPE,
                stdout=self.output,
                stderr=subprocess.STDOUT,
                pass_fds=[write],
                text=True,
            )
            os.close(write)
        script = self.folder / f".block-{block.line}.py"
        script.write_text(block.text)
        self.python.stdin.write(f"{script}\n")
        self.python.stdin.flush()
        if os.read(self.done, 1) != b"+":
            raise Failure("this ended with an error")

    def close(self):
        if self.python is not None:
            self.python.stdin.close()
            self.python.wait()
        self.output.close()


def run_page(page, blocks, options):
    with tempfile.TemporaryDirectory() as folder:
        session = Session(folder, options.build.resolve(), page)
        try:
            for block in blocks:
                if block.reason is None or (options.slow and block.reason == SLOW):
                    before = len(session.said())
                    try:
                        session.run(block)
                    except Failure as failure:
                        sys.exit(f"{page}:{block.line}: {failure}:\n{block.text}\n{session.said()[before:]}")
                    if options.v:
                        print(block.text + session.said()[before:], flush=True)
        finally:
            session.close()


def counted(blocks):
    """How many blocks are run, and how many are not for each reason."""
    commands = [block for block in blocks if block.kind in ("sh", "python", "stopped")]
    reasons = collections.Counter(block.reason for block in commands if block.reason)
    marked = f", {sum(reasons.values())} marked" if reasons else ""
    return f"{sum(block.reason is None for block in commands)} blocks are run{marked}" + (
        f" ({', '.join(f'{reason}: {count}' for reason, count in sorted(reasons.items()))})" if reasons else ""
    )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build" / "release")
    for flag in ("--slow", "--count", "-v"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    found = {}
    for page in [page.resolve() for page in options.pages] or pages():
        try:
            found[page] = blocks_of(page)
        except Failure as failure:
            sys.exit(f"{page}: {failure}")
    print(counted([block for blocks in found.values() for block in blocks]), flush=True)
    for page, blocks in found.items():
        if options.count or (options.slow and not any(block.reason == SLOW for block in blocks)):
            continue
        begin = time.monotonic()
        run_page(page, blocks, options)
        print(f"{page.relative_to(SOURCE)}: {time.monotonic() - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
