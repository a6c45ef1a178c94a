"""The page of the keys of scan.toml and rig.toml, made from the sources that read them."""
import re
import sys

READERS = {
    "rig.toml": ["src/frangia/rig/read_rig.cpp", "src/frangia/rig/internal/calibration_table.cpp"],
    "scan.toml": [
        "src/frangia/dataset/scan_folder.cpp",
        "src/frangia/dataset/internal/read_pattern.cpp",
        "src/frangia/dataset/internal/read_pattern.cpp",
    ],
}
EXPLAINED = ["docs/scan-format.md", "docs/calibration.md"]
CALL = re.compile(
    r"\.(number|number_or|positive|integer|boolean|text|texts|numbers|rows|table|tables|has)\(\s*\"([a-z_0-9]+)\""
)
KINDS = {
    "number": "number",
    "number_or": "number",
    "positive": "number above 0",
    "integer": "whole number",
    "boolean": "true or false",
    "text": "text",
    "texts": "texts",
    "numbers": "numbers",
    "rows": "rows of numbers",
    "table": "table",
    "tables": "tables",
}


def keys_of(text):
    """Key -> the kinds in which the source reads it."""
    kinds = {}
    for call, key in CALL.findall(text):
        kinds.setdefault(key, set()).update([KINDS[call]] if call in KINDS else [])
    return kinds


def explanation(key, texts):
    """The comment beside the key in an example of the documents, or the page that mentions it."""
    for text in texts.values():
        found = re.search(rf"^#? ?{key} = .*?#\s*(.*)$", text, re.MULTILINE)
        if found:
            return found[1]
    return ""


def page(source):
    texts = {name: (source / name).read_text() for name in EXPLAINED}
    out = [
        "# Keys of scan.toml and rig.toml",
        "",
        "Every key that the program reads; [scan-format.md](../docs/scan-format.md) and "
        "[calibration.md](../docs/calibration.md) explain them. The tables `[devices.*]` are those of "
        "[devices.md](../docs/devices.md). An unknown key is named in a warning.",
        "",
    ]
    for file, sources in READERS.items():
        kinds = {}
        for name in sources:
            for key, found in keys_of((source / name).read_text()).items():
                kinds.setdefault(key, set()).update(found)
        out += [f"## {file}", "", "| key | value | in the example |", "|---|---|---|"]
        for key in sorted(kinds):
            where = [name for name, text in texts.items() if re.search(rf"\b{key}\b", text)]
            if not where:
                sys.exit(f"tools/site: {file} has the key {key}, which {' and '.join(EXPLAINED)} do not explain")
            comment = explanation(key, texts).replace("|", "\\|").replace("<", "&lt;")
            out.append(
                f"| `{key}` | {', '.join(sorted(kinds[key]))} | {comment or f'[{where[0][5:]}](../{where[0]})'} |"
            )
        out.append("")
    return "\n".join(out) + "\n"
