#!/usr/bin/env python3
"""Writes the types of scenes, for editors: vlbeam/_scene.pyi, from the option table. The build calls it.

    stubs.py FOLDER        of the package that was built
"""

import json
import sys
from pathlib import Path

sys.dont_write_bytecode = True
FOLDER = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(FOLDER.parent))
from vlbeam import _scene  # noqa: E402

PLAIN = {"number": "float", "integer": "int", "string": "str", "boolean": "bool"}


def type_of(schema):
    """The type of a key's value."""
    if "const" in schema:
        return f"Literal[{schema['const']!r}]"
    if "enum" in schema:
        return f"Literal[{', '.join(map(repr, schema['enum']))}]"
    if "anyOf" in schema:
        return " | ".join(type_of(choice) for choice in schema["anyOf"])
    if isinstance(schema.get("type"), list):
        return " | ".join(type_of(schema | {"type": one}) for one in schema["type"])
    if schema.get("type") == "array":
        return f"Sequence[{type_of(schema.get('items', {}))}]"
    if schema.get("type") == "object" or "properties" in schema:
        return "Mapping[str, Any]"
    return PLAIN.get(schema.get("type"), "Any")


def text(words, indent):
    """A docstring."""
    lines = words.replace("\\", "\\\\").strip().splitlines()
    one = len(lines) == 1 and not lines[0].endswith('"')
    return f'{indent}"""' + f"\n{indent}".join(lines) + ('"""' if one else f'\n{indent}"""')


def method(name, keys, schema, gives, doc):
    given = ", ".join(f"{python}: {type_of(schema['properties'][key])} = ..." for python, key in keys.items())
    return f"    def {name}(self{', *, ' + given if given else ''}) -> {gives}:\n{text(doc, ' ' * 8)}"


def write(kind):
    """The text of a class, and of those that it needs before it."""
    schema, name, lines, before = kind._schema, kind.__name__, [], []
    for python, key in kind._keys.items():
        if python in kind._parts:
            below = kind._parts[python][1]
            if issubclass(below, _scene.PartList):
                before.append(write_list(below))
            else:
                before.append(write(below))
            lines.append(f"    {python}: _Below[{below.__name__}, {type_of(schema['properties'][key])}] = ...\n"
                         f"{text(_scene._sentence(schema['properties'][key]), ' ' * 4)}")
        else:
            lines.append(f"    {python}: {type_of(schema['properties'][key])}\n{text(_scene._sentence(schema['properties'][key]), ' ' * 4)}")
    for special in ("__init__", "__call__"):
        gives = "None" if special == "__init__" else name
        given = ", ".join(f"{python}: {type_of(schema['properties'][key])} = ..." for python, key in kind._keys.items())
        first = ", given: Mapping[str, Any] = ..." if special == "__init__" else ""
        lines.append(f"    def {special}(self{first}, *, {given}) -> {gives}: ...")
    for python, choice in kind._choices.items():
        made = getattr(kind, python)
        lines.append(method(python, _keys(kind, choice, schema), schema, name, made.__doc__))
    lines.append("    def to_json(self, indent: int = 2) -> str: ...")
    return "\n".join([*before, f"class {name}(dict[str, Any]):\n{text(kind.__doc__, '    ')}", *lines, ""])


def write_list(kind):
    entry, lines = kind._kind, []
    for python, choice in kind._choices.items():
        lines.append(method(python, _keys(kind, choice, entry._schema), entry._schema, entry.__name__, getattr(kind, python).__doc__))
    keys = {python: key for python, key in entry._keys.items()}
    lines.append(method("add", keys, entry._schema, entry.__name__, kind.add.__doc__))
    return "\n".join([write(entry), f"class {kind.__name__}(list[{entry.__name__}]):", *lines, ""])


def _keys(kind, choice, schema):
    names = [name for name in getattr(kind, _scene.attribute(choice)).__signature__.parameters if name != "self"]
    return {name: key for key in schema["properties"] for name in [_scene.attribute(key)] if name in names}


def main():
    head = ('"""The types of scenes, made from the option table."""\n\nfrom collections.abc import Mapping, Sequence\n'
            "from typing import Any, Generic, Literal, TypeVar\n\n_Part = TypeVar(\"_Part\")\n_Given = TypeVar(\"_Given\")\n\n"
            "class _Below(Generic[_Part, _Given]):\n"
            '    """A part of a scene: reading gives it, and any mapping or list may be written."""\n'
            "    def __get__(self, instance: Any, owner: Any) -> _Part: ...\n"
            "    def __set__(self, instance: Any, value: _Part | _Given) -> None: ...\n\n")
    tail = "\n\ndef scene_class() -> type[Scene]: ...\n"
    stub = head + write(_scene.scene_class()) + tail
    compile(stub, "_scene.pyi", "exec")
    (FOLDER / "_scene.pyi").write_text(stub, encoding="utf-8")


if __name__ == "__main__":
    main()
