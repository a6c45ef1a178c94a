"""The page of the Python package, made from its type stubs."""
import ast

STUBS = ["_frangia.pyi", "_acquisition.pyi"]


def signature(node):
    """The signature without `self` and without types that only repeat NumPy's."""
    return f"{node.name}({ast.unparse(node.args)})" + (f" -> {ast.unparse(node.returns)}" if node.returns else "")


def doc(node):
    return ast.get_docstring(node) or ""


def is_property(node):
    return any(isinstance(mark, ast.Name) and mark.id == "property" for mark in node.decorator_list)


def function_lines(node, level):
    return [f"{'#' * level} {node.name}", "", f"    {signature(node)}", "", doc(node), ""]


def class_lines(node):
    bases = f" ({', '.join(ast.unparse(base) for base in node.bases)})" if node.bases else ""
    out = [f"### {node.name}", "", doc(node) + (f" {bases}" if bases else ""), ""]
    members = [one for one in node.body if isinstance(one, ast.FunctionDef)]
    properties = [one for one in members if is_property(one)]
    if properties:
        out += ["| | | |", "|---|---|---|"]
        for one in properties:
            kind = ast.unparse(one.returns).replace("|", "\\|") if one.returns else ""
            out.append(
                f"| `{one.name}` | `{kind}` | {doc(one).replace('|', chr(92) + '|').splitlines()[0] if doc(one) else ''} |"
            )
        out.append("")
    for one in members:
        if is_property(one) or (one.name.startswith("_") and one.name != "__init__"):
            continue
        out += [f"    {signature(one)}", "", doc(one), ""]
    return out


def page(package):
    functions, classes = [], []
    for name in STUBS:
        for node in ast.parse((package / name).read_text()).body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                functions += function_lines(node, 3)
            elif isinstance(node, ast.ClassDef):
                classes += class_lines(node)
    head = doc(ast.parse((package / "__init__.py").read_text()))
    return "\n".join(
        [
            "# Python",
            "",
            "[python.md](../docs/python.md) explains the package.",
            "",
            head,
            "",
            "## Functions",
            "",
            *functions,
            "## Classes",
            "",
            *classes,
        ]
    )
