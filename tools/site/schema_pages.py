"""The page of the JSON answers, made from docs/json."""
import json


def type_text(node):
    if "$ref" in node:
        return f"`{node['$ref'].rsplit('/', 1)[1]}`, see below"
    if "enum" in node:
        return ", ".join("null" if value is None else f"`{value}`" for value in node["enum"])
    kinds = node.get("type", "object")
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if "items" in node:
        inner = type_text(node["items"])
        kinds = [f"array of {inner}" if kind == "array" else kind for kind in kinds]
    return " or ".join(kinds)


def rows(node, prefix=""):
    """The rows of an object's keys and of the objects in them."""
    for name, value in node.get("properties", {}).items():
        optional = "" if name in node.get("required", []) else ", may be absent"
        yield f"| `{prefix}{name}` | {type_text(value)}{optional} | {value.get('description', '')} |"
        yield from rows(value, f"{prefix}{name}.")
        if isinstance(value.get("items"), dict):
            yield from rows(value["items"], f"{prefix}{name}[].")
        if isinstance(value.get("additionalProperties"), dict):
            yield from rows(value["additionalProperties"], f"{prefix}{name}.*.")


def table(node):
    top = node.get("items", {}) if node.get("type") == "array" else node
    return ["| key | type | meaning |", "|---|---|---|", *rows(top, "[]." if top is not node else ""), ""]


def page(folder):
    out = [
        "# JSON schemas",
        "",
        "Each verb with `--json` prints one document of this form; [json.md](../docs/json.md) explains what "
        "they have in common. `[]` stands for each item of an array, `*` for each key.",
        "",
    ]
    for path in sorted(folder.glob("*.schema.json")):
        schema = json.loads(path.read_text())
        out += [f"## {schema['title']}", "", f"[{path.name}](../docs/json/{path.name})", ""]
        if "description" in schema:
            out += [schema["description"], ""]
        if schema.get("type") in ("object", "array"):
            out += table(schema)
        for name, node in schema.get("$defs", {}).items():
            out += [f"### {schema['title']}: {name}", "", node.get("description", ""), "", *table(node)]
    return "\n".join(out) + "\n"
