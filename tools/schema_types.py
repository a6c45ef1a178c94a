#!/usr/bin/env python3
"""Writes the TypeScript types of the messages of `frangia serve`: schema_types.py docs/service-schema.json web/src/schema.ts

A definition `rig_figures` becomes the type `RigFigures`; a description becomes its comment. The build of the app runs it.
"""

import json
import pathlib
import sys

# Lists of a fixed length of at most this many items are tuples.
LONGEST_TUPLE = 4


def name_of(definition):
    return "".join(word.capitalize() for word in definition.split("_"))


def comment(schema, indent):
    return f"{indent}/** {schema['description']} */\n" if "description" in schema else ""


def members(schema, indent):
    required = schema.get("required", [])
    inner = indent + "  "
    return "".join(
        f"{comment(one, inner)}{inner}{name if name.isidentifier() else json.dumps(name)}"
        f"{'' if name in required else '?'}: {type_of(one, inner)};\n"
        for name, one in schema["properties"].items()
    )


def list_of(schema, indent):
    items = type_of(schema.get("items", {}), indent)
    least, most = schema.get("minItems"), schema.get("maxItems")
    if least is not None and least == most and most <= LONGEST_TUPLE:
        return f"[{', '.join([items] * most)}]"
    return f"({items})[]" if " | " in items or " & " in items else f"{items}[]"


def object_of(schema, indent):
    if "properties" in schema:
        return f"{{\n{members(schema, indent)}{indent}}}"
    values = schema.get("additionalProperties")
    return f"Record<string, {type_of(values, indent) if isinstance(values, dict) else 'unknown'}>"


def type_of(schema, indent=""):
    if "$ref" in schema:
        return name_of(schema["$ref"].rsplit("/", 1)[1])
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema["enum"])
    for key in ("anyOf", "oneOf"):
        if key in schema:
            return " | ".join(dict.fromkeys(type_of(one, indent) for one in schema[key]))
    if "allOf" in schema:
        parts = [type_of(one, indent) for one in schema["allOf"]]
        return " & ".join([*parts, object_of(schema, indent)] if "properties" in schema else parts)
    kinds = schema.get("type", [])
    simple = {"integer": "number", "number": "number", "string": "string", "boolean": "boolean", "null": "null"}
    made = {"array": list_of, "object": object_of}
    found = [
        made[kind](schema, indent) if kind in made else simple[kind]
        for kind in ([kinds] if isinstance(kinds, str) else kinds)
    ]
    return " | ".join(dict.fromkeys(found)) or "unknown"


def main():
    schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
    text = "// Written by tools/schema_types.py from docs/service-schema.json.\n"
    for definition, one in schema["definitions"].items():
        text += f"\n{comment(one, '')}export type {name_of(definition)} = {type_of(one)};\n"
    output = pathlib.Path(sys.argv[2])
    if not output.exists() or output.read_text() != text:
        output.write_text(text)


if __name__ == "__main__":
    main()
