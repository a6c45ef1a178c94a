"""A page of documentation whose sections are written one by one."""
import os


def begin(name):
    return f"<!-- begin {name}: written by `./run figures {name}` -->"


def end(name):
    return f"<!-- end {name} -->"


def write_section(path, names, name, text):
    """Replaces one section of a page; a new section follows the last one that precedes it in `names`."""
    page = path.read_text()
    body = f"{begin(name)}\n{text.rstrip()}\n{end(name)}\n"
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
