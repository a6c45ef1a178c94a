"""Shared by the scripts that measure figures: calls of the program, and a report that is written at the end."""
import json
import subprocess


def ask(program, *arguments):
    """The JSON result of the program."""
    result = subprocess.run([program, "--json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(result.stdout)


class Report:
    """Lines of Markdown, also printed at once."""

    def __init__(self):
        self.lines = []

    def add(self, text=""):
        print(text, flush=True)
        self.lines.append(text)

    def write(self, path):
        temporary = path.with_suffix(".tmp")
        temporary.write_text("\n".join(self.lines).rstrip() + "\n")
        temporary.replace(path)
