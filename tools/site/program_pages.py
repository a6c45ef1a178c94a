"""Pages of the program's verbs and options, made from its help."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "package"))
import help_pages  # noqa: E402


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def name_of(page):
    return "-".join(page.verb) or "index"


def page_text(page):
    out = [
        f"# {' '.join(['frangia', *page.verb])}",
        "",
        page.summary.removeprefix("frangia: ").capitalize() + ".",
        "",
        f"    {page.usage}",
        "",
    ]
    for group, entries in page.groups.items():
        out += [f"## {'Verbs' if group == 'Subcommands' else group}", "", "| | |", "|---|---|"]
        for entry in entries:
            names = ", ".join(f"`{name}`" for name in entry.names) + (f" {cell(entry.value)}" if entry.value else "")
            if group == "Subcommands":
                names = f"[{entry.names[0]}]({'-'.join([*page.verb, entry.names[0]])}.md)"
            out.append(f"| {names} | {cell(entry.text)} |")
        out.append("")
    if page.footer:
        title, _, rest = page.footer.partition("\n")
        out += [f"## {title.rstrip(':').capitalize()}", ""] if rest else [title]
        out += ["    " + line for line in rest.split("\n")]
    if page.verb:
        schema = f"{name_of(page)}.schema.json"
        if not page.verbs:
            out += ["", f"With `--json`: [{schema}](../../docs/json/{schema})."]
        out += ["", "[All verbs](index.md), [exit codes](../../docs/json.md)."]
    return "\n".join(out) + "\n"


def pages(program):
    """File name -> text."""
    return {f"{name_of(page)}.md": page_text(page) for page in help_pages.pages_of(program)}
