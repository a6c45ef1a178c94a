"""What the studies of figures share: the program's answers, and a report that appears when it is whole."""
import json
import subprocess


def ask(program, *arguments):
    """The program's JSON answer."""
    result = subprocess.run([program, "--json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(result.stdout)


class Report:
    """Lines of Markdown, printed as they come."""

    def __init__(self):
        self.lines = []

    def tell(self, text=""):
        print(text, flush=True)
        self.lines.append(text)

    def write(self, path):
        temporary = path.with_suffix(".tmp")
        temporary.write_text("\n".join(self.lines).rstrip() + "\n")
        temporary.replace(path)
