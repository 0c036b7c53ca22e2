#!/usr/bin/env python3
"""Writes docs/scene_keys.md, every key of a scene, from the option table of the program.

    scene_keys.py PROGRAM [FILE]        (default: docs/scene_keys.md; - is standard output)
"""

import json
import re
import subprocess
import sys
from pathlib import Path

HEAD = """# Keys of a scene

Every key, as the program knows it: `vlbeam schema scene --text` prints the same. A key without a default is required, or chosen by the
program. All units are SI. Made by `docs/scene_keys.py build/vlbeam`.
"""


UNIT = re.compile(r" \[(s, )?(m|rad|N)\b[^\]]*\]$")  # of functions of time: that of the quantity


def cell(text):
    return str(text).replace("|", "\\|")


def allowed(schema):
    """What a value may be, in words."""
    if "$ref" in schema:
        return schema["description"]
    if "enum" in schema:
        return ", ".join(f"`{choice}`" for choice in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    if "anyOf" in schema and "properties" not in schema:
        return " or ".join(allowed(choice) for choice in schema["anyOf"])
    kind = schema.get("type")
    if isinstance(kind, list):
        return " or ".join(allowed(schema | {"type": one}) for one in kind)
    if kind == "array":
        return "a list of " + {"number": "numbers", "array": "points", "object": "objects"}.get(schema["items"].get("type"), "values")
    words = {"number": "number", "integer": "whole number", "boolean": "true or false", "string": "text", "object": "object"}[kind]
    signs = (("minimum", ">="), ("exclusiveMinimum", ">"), ("maximum", "<="), ("exclusiveMaximum", "<"))
    return " ".join([words, *(f"{sign} {schema[key]:g}" for key, sign in signs if key in schema and kind in ("number", "integer"))])


def is_time(properties):
    return {"value", "rate", "ramp", "until"} <= set(properties)


def time_keys(schema):
    """The keys that all functions of time of a schema have, with the first one's schemas."""
    found = []

    def look(node):
        if isinstance(node, dict):
            if is_time(node.get("properties", {})):
                found.append(node["properties"])
            for below in node.values():
                look(below)
        elif isinstance(node, list):
            for below in node:
                look(below)

    look(schema)
    return {key: value for key, value in found[0].items() if all(key in other for other in found)}


def of(schema):
    """The object among what a key may be."""
    return next((choice for choice in schema.get("anyOf", []) if "properties" in choice), schema)


class Page:
    def __init__(self, scene):
        self.parts, self.time = [], time_keys(scene)
        self.part("Scene", "", scene)

    def part(self, title, pointer, schema):
        rows, below = [], []
        properties = schema["properties"]
        if is_time(properties):
            properties = {key: value for key, value in properties.items() if key not in self.time}
        for key, value in properties.items():
            inner = of(value)
            listed = inner.get("type") == "array" and "properties" in inner["items"]
            object_ = inner["items"] if listed else inner
            what, meaning = allowed(value), "" if "$ref" in value else value.get("description", "")
            if "properties" in object_:
                where = f"{pointer}/{key}" + ("/N" if listed else "")
                if is_time(object_["properties"]):
                    what += " with a [function of time](#functions-of-time)"
                if not is_time(object_["properties"]) or set(object_["properties"]) - set(self.time):
                    below.append((where, object_))
            default = "" if value.get("default") in (None, "") else f"`{json.dumps(value['default'])}`"
            rows.append(f"| `{key}` | {cell(what)} | {default} | {cell(meaning[:1].upper() + meaning[1:])} |")
        if rows:
            self.parts.append((title, rows))
        for where, object_ in below:
            self.part(where, where, object_)

    def text(self):
        rows = []
        for key, value in self.time.items():
            default = f"`{json.dumps(value['default'])}`" if "default" in value else ""
            meaning = UNIT.sub("", value.get("description", ""))
            rows.append(f"| `{key}` | {cell(allowed(value))} | {default} | {cell(meaning)} |")
        parts = [*self.parts, ("Functions of time", rows)]
        table = "| key | value | default | meaning |\n|---|---|---|---|\n"
        return HEAD + "".join(f"\n## {title}\n\n{table}" + "\n".join(rows) + "\n" for title, rows in parts)


def main():
    told = subprocess.run([sys.argv[1], "schema", "scene"], capture_output=True, text=True, check=True)
    text = Page(json.loads(told.stdout)).text()
    file = sys.argv[2] if len(sys.argv) > 2 else Path(__file__).with_suffix(".md")
    if file == "-":
        sys.stdout.write(text)
    else:
        Path(file).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
