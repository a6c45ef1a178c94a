"""Runs every command and snippet of docs/tutorials: tutorials_test.py PROGRAM PYTHONPATH SOURCE_DIR [PAGE...]

Of each page, ```sh blocks are run by sh, ```python blocks by Python, those of a page in one session, in order, in one temporary
folder. A block below `<!-- file: NAME -->` is written to that file.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

BLOCK = re.compile(r"^(?:<!-- file: (\S+) -->\n)?```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def fail(page, block, done):
    sys.exit(f"{page.name}: this ended with {done.returncode}:\n{block}\n{done.stdout}\n{done.stderr}")


def run_page(page, environment):
    python = ""  # what the blocks before have done
    with tempfile.TemporaryDirectory() as folder:
        for name, language, block in BLOCK.findall(page.read_text()):
            if name:
                pathlib.Path(folder, name).write_text(block)
                continue
            if language == "sh":
                command = ["sh", "-euc", block]
            elif language == "python":
                python += block
                command = [sys.executable, "-c", python]
            else:
                sys.exit(f"{page.name}: a block of {language} that is neither run nor a file")
            done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
            if done.returncode != 0:
                fail(page, block, done)
            if "-v" in sys.argv:
                print(done.stdout, done.stderr)


def main(program, python_path, source, *pages):
    environment = dict(
        os.environ,
        PYTHONPATH=str(pathlib.Path(python_path).resolve()),
        PATH=f"{pathlib.Path(program).resolve().parent}:{os.environ['PATH']}",
    )
    for page in sorted((pathlib.Path(source) / "docs" / "tutorials").glob("*.md")):
        if pages and page.stem not in pages:
            continue
        begin = time.monotonic()
        run_page(page, environment)
        print(f"{page.name}: {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*[argument for argument in sys.argv[1:] if argument != "-v"])
