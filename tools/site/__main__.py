"""Builds the documentation site with MkDocs: python3 tools/site PROGRAM OUT [API]

The pages are README.md and docs/*.md as they are, docs/tutorials, and the reference, which is made from the code. API is the
folder of the HTML that Doxygen made; it becomes OUT/api. Broken links end the build.
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import keys_page
import program_pages
import python_page
import schema_pages

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")

NAV = {
    "Home": "README.md",
    "Tutorials": {
        "A stranger: first scan": "docs/tutorials/stranger.md",
        "A maker: your own rig": "docs/tutorials/maker.md",
        "An engineer: is the part right?": "docs/tutorials/engineer.md",
        "A researcher: your own algorithm": "docs/tutorials/researcher.md",
    },
    "How to": {
        "Wire a rig": "docs/devices.md",
        "Calibrate a rig": "docs/calibration.md",
        "Bring in your own frames": "docs/your-own-frames.md",
        "Edit a mesh": "docs/editing.md",
        "Inspect a part": "docs/inspection.md",
        "Process many scans": "docs/batch.md",
        "Use Python": "docs/python.md",
        "Recover from faults": "docs/reliability.md",
    },
    "Reference": {
        "Program": "reference/program/index.md",
        "Exit codes and JSON": "docs/json.md",
        "JSON schemas": "reference/json.md",
        "Scan folder": "docs/scan-format.md",
        "Keys of scan.toml and rig.toml": "reference/keys.md",
        "Mesh files": "docs/files.md",
        "Python": "reference/python.md",
        "C++": "reference/cpp.md",
        "Protocol of the app": "docs/service-api.md",
        "Parameters": "docs/parameters.md",
        "Terms": "docs/terms.md",
    },
    "Explanation": {
        "Phase": "docs/phase.md",
        "Surface": "docs/surface.md",
        "Uncertainty": "docs/uncertainty.md",
        "Figures": "docs/figures.md",
        "Figures of captures": "docs/figures-capture.md",
        "Coverage": "docs/coverage.md",
        "Decisions": "docs/decisions.md",
    },
    "Project": {
        "Map of the code": "docs/map.md",
        "How to change it": "docs/how-to-change.md",
        "Contributing": "CONTRIBUTING.md",
        "Security": "SECURITY.md",
        "Changelog": "CHANGELOG.md",
    },
}
NOT_PAGES = {"api.md"}  # the first page of Doxygen's reference


def nav_lines(nav, indent=2):
    for title, target in nav.items():
        if isinstance(target, dict):
            yield f"{' ' * indent}- {title!r}:"
            yield from nav_lines(target, indent + 4)
        else:
            yield f"{' ' * indent}- {title!r}: {target}"


def targets(nav):
    for target in nav.values():
        yield from targets(target) if isinstance(target, dict) else [target]


def missing_from_nav():
    known = set(targets(NAV))
    return [
        path.name
        for path in sorted((SOURCE / "docs").glob("*.md"))
        if f"docs/{path.name}" not in known and path.name not in NOT_PAGES
    ]


def copy_page(page, pages):
    """Copies a page and the files that it links to; a link to a folder becomes plain text."""
    out = pages / page
    out.parent.mkdir(parents=True, exist_ok=True)

    def relinked(match):
        target = match[1]
        if re.match(r"[a-z]+:", target):
            return match[0]
        linked = (SOURCE / page).parent.joinpath(target).resolve()
        if linked.is_dir() or linked.name in NOT_PAGES:
            return "]()"
        if linked.is_file() and linked.suffix != ".md":
            copy = pages / linked.relative_to(SOURCE)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(linked, copy)
        return match[0]

    text = LINK.sub(relinked, (SOURCE / page).read_text())
    text = re.sub(r"(?<!!)\[([^\]]*)\]\(\)", r"\1", text)
    out.write_text(re.sub(r"^<!--.*?-->\n", "", text, flags=re.MULTILINE | re.DOTALL))


def write_pages(program, pages, has_api):
    for page in targets(NAV):
        if not page.startswith("reference/"):
            copy_page(page, pages)
    for page in sorted((SOURCE / "docs" / "phase").glob("*.md")):
        copy_page(page.relative_to(SOURCE), pages)
    reference = pages / "reference"
    (reference / "program").mkdir(parents=True)
    for name, text in program_pages.pages(program).items():
        (reference / "program" / name).write_text(text)
    (reference / "json.md").write_text(schema_pages.page(SOURCE / "docs" / "json"))
    for schema in (SOURCE / "docs" / "json").glob("*.json"):
        (pages / "docs" / "json").mkdir(exist_ok=True)
        shutil.copyfile(schema, pages / "docs" / "json" / schema.name)
    (reference / "keys.md").write_text(keys_page.page(SOURCE))
    (reference / "python.md").write_text(python_page.page(SOURCE / "python" / "frangia"))
    first = (SOURCE / "docs" / "api.md").read_text().replace("# API reference", "# C++")
    # An absolute link, because MkDocs does not know Doxygen's pages; hooks would cost more.
    link = '<a href="../api/index.html">All public headers</a> (Doxygen).\n\n' if has_api else ""
    (reference / "cpp.md").write_text(first.replace("\n\n", "\n\n" + link, 1))


def faults_of(site):
    """What a page loads from elsewhere, and links to what is not there; MkDocs does not check anchors."""
    texts = {
        page: page.read_text(errors="replace")
        for page in site.rglob("*.html")
        if page.relative_to(site).parts[0] != "api"
    }
    faults = []
    for page, text in texts.items():
        faults += [
            f"{page}: loads {url}"
            for url in re.findall(r"<(?:script|link|img)[^>]*(?:src|href)=\"((?:https?:)?//[^\"]*)", text)
        ]
        for url in set(re.findall(r"(?:href|src)=\"([^\"]+)\"", text)):
            path, _, anchor = urllib.parse.unquote(html.unescape(url)).partition("#")
            if re.match(r"[a-z]+:|//|/", path) or page.name == "404.html":
                continue
            target = (page.parent / path.partition("?")[0]).resolve() if path else page.resolve()
            if not target.exists():
                faults.append(f"{page}: {url} is not there")
            elif anchor and target.suffix == ".html" and target in texts and f'id="{anchor}"' not in texts[target]:
                faults.append(f"{page}: {url}: there is no such heading")
    return faults


def build(program, out, api=None):
    left_out = missing_from_nav()
    if left_out:
        sys.exit(
            f"tools/site: {', '.join(left_out)} in docs is not in the navigation; add it to NAV in tools/site/__main__.py"
        )
    out = str(pathlib.Path(out).resolve())
    with tempfile.TemporaryDirectory() as folder:
        stage = pathlib.Path(folder)
        write_pages(program, stage / "pages", api is not None)
        config = [
            "site_name: Frangia",
            "docs_dir: pages",
            f"site_dir: {out}",
            "use_directory_urls: false",
            "strict: true",
            "theme:",
            "  name: mkdocs",
            "  highlightjs: false",
            "plugins: [search]",
            "markdown_extensions: [tables, fenced_code, toc]",
            "nav:",
            *nav_lines(NAV),
        ]
        (stage / "mkdocs.yml").write_text("\n".join(config) + "\n")
        done = subprocess.run(
            ["mkdocs", "build", "--strict", "--clean", "-f", stage / "mkdocs.yml"], stderr=subprocess.PIPE, text=True
        )
        said = re.sub(r"\x1b\[[0-9;]*m", "", done.stderr)  # MkDocs colours its words
        sys.stderr.writelines(
            line for line in said.splitlines(keepends=True) if line.startswith(("WARNING", "ERROR", "Aborted"))
        )
        done.check_returncode()
    if api:
        shutil.copytree(api, pathlib.Path(out) / "api")
    faults = faults_of(pathlib.Path(out))
    if faults:
        sys.exit("tools/site: " + "\n".join(faults))


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    try:
        build(*sys.argv[1:])
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
