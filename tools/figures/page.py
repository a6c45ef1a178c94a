"""A page of documentation whose sections are written one by one, and the text of a section."""
import os

IN_FULL = "<!-- in full -->"  # begins the last full measurement of a section


class Text:
    """The lines of a section in Markdown."""

    def __init__(self):
        self.lines = []

    def add(self, text=""):
        self.lines.append(text)

    def table(self, *columns):
        """The head of a table."""
        self.add("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")

    def row(self, *cells):
        self.add("| " + " | ".join(map(str, cells)) + " |")

    def __str__(self):
        return "\n".join(self.lines).strip()


def begin(name):
    return f"<!-- begin {name}: written by `./run figures {name}` -->"


def end(name):
    return f"<!-- end {name} -->"


def last_full(page, name):
    """The last full measurement that a page (its text) states, or nothing."""
    if begin(name) not in page:
        return ""
    section = page.split(begin(name), 1)[1].split(end(name), 1)[0]
    return section.split(IN_FULL, 1)[1].strip() if IN_FULL in section else ""


def section_text(page, name, title, text, is_full):
    """A section with a new measurement; below one of a part stays the last full one, each with its command and revision."""
    old = last_full(page, name)
    if is_full:
        return f"## {title}\n{IN_FULL}\n\n{text}"
    return f"## {title}\n\n{text}" + (f"\n\n### {title}: the last full measurement\n{IN_FULL}\n\n{old}" if old else "")


def write_section(path, names, name, title, text, is_full):
    """Replaces one section of a page; a new section follows the last one that precedes it in `names`."""
    page = path.read_text()
    body = f"{begin(name)}\n{section_text(page, name, title, text, is_full).rstrip()}\n{end(name)}\n"
    if begin(name) in page:
        head, rest = page.split(begin(name), 1)
        rest = rest.split(end(name), 1)[1].lstrip("\n")
        page = head + body + ("\n" + rest if rest else "")
    else:
        earlier = [other for other in names[: names.index(name)] if end(other) in page]
        if earlier:
            head, rest = page.split(end(earlier[-1]) + "\n", 1)
            head += end(earlier[-1]) + "\n"
        else:
            first = [page.index(begin(other)) for other in names if begin(other) in page]
            head, rest = (page[: min(first)], page[min(first) :]) if first else (page, "")
        page = head.rstrip("\n") + "\n\n" + body + ("\n" + rest.lstrip("\n") if rest.strip() else "")
    temporary = path.with_suffix(".tmp")
    temporary.write_text(page)
    os.replace(temporary, path)
