"""Scenes: dictionaries whose keys are attributes too, with the keys, units and choices of the option table.

The classes here are made from `vlbeam.schema("scene")`, so that a new option needs no line of Python.
"""

import inspect
import json
import keyword
from difflib import get_close_matches
from functools import lru_cache

from . import _vlbeam


def attribute(name):
    """A key or a choice as Python can write it: "generalized-alpha" is generalized_alpha, "from" is from_."""
    name = name.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) or hasattr(dict, name) else name


def _unknown(where, name, known):
    near = get_close_matches(name, known, 1)
    return f"{where} has no key {name!r}; " + (f"the nearest is {near[0]!r}" if near else "there are: " + ", ".join(sorted(known)))


class Part(dict):
    """An object of a scene. `part.key` reads a key, or a part below it; `part.key = value` sets it."""

    _pointer, _schema, _keys, _parts, _choices = "", {}, {}, {}, {}

    def __init__(self, *given, **keys):
        super().__init__(*given)
        object.__setattr__(self, "_attach", None)
        self._set(keys, self._keys)

    def __call__(self, **keys):
        """Sets keys and returns the part."""
        self._set(keys, self._keys)
        return self

    def __getattr__(self, name):
        if name in self._parts:
            return self._below(*self._parts[name])
        if name in self._keys:
            key = self._keys[name]
            if key in self:
                return self[key]
            raise AttributeError(f"{self._pointer}/{key} is not set; {_sentence(self._schema['properties'][key])}")
        if name.startswith("_"):
            raise AttributeError(name)
        raise AttributeError(_unknown(self._pointer or "a scene", name, [*self._keys, *self._choices]))

    def __setattr__(self, name, value):
        self._set({name: value}, self._keys)

    def __setitem__(self, key, value):
        super().__setitem__(key, value)
        if self._attach is not None:
            attach = self._attach
            object.__setattr__(self, "_attach", None)
            attach(self)

    def __dir__(self):
        return [*self._keys, *self._choices, *(name for name in super().__dir__() if name.startswith("__") or not name.startswith("_"))]

    def __reduce__(self):  # the classes are made, so that pickle and copy would not find them by name
        return (_restored, (self._pointer, dict(self)))

    def to_json(self, indent=2):
        """The text of a scene file."""
        return json.dumps(self, indent=indent, default=plain) + "\n"

    def _set(self, keys, allowed):
        for name, value in keys.items():
            if name not in allowed:
                raise AttributeError(_unknown(self._pointer or "a scene", name, allowed))
            self[allowed[name]] = value

    def _below(self, key, kind):
        """The part at a key. One that is not there yet joins the scene with its first key."""
        value = self.get(key)
        if isinstance(value, kind):
            return value
        if isinstance(value, (dict, list)):
            self[key] = kind(value)
            return self[key]
        below = kind()
        object.__setattr__(below, "_attach", lambda part: self.__setitem__(key, part))
        return below

    def _choose(self, choice, keys, given):
        self.clear()
        self["type"] = choice
        self._set(given, keys)
        return self


class PartList(list):
    """A list of a scene; `add`, or the name of a type, appends an entry and returns it."""

    _pointer, _kind, _choices = "", Part, {}

    def __init__(self, entries=()):
        super().__init__(self._kind(entry) if type(entry) is dict else entry for entry in entries)
        self._attach = None

    def add(self, **keys):
        """Appends an entry with these keys, and returns it."""
        entry = self._kind(**keys)
        self.append(entry)
        if self._attach is not None:
            self._attach(self)
            self._attach = None
        return entry

    def __getattr__(self, name):
        raise AttributeError(_unknown(self._pointer, name, ["add", *self._choices]))

    def __reduce__(self):
        return (_restored, (self._pointer, list(self)))


def plain(value):
    """A numpy array or number as what JSON can say."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene cannot hold a {type(value).__name__}: {value!r:.60}")


def _conditions(schema):
    """Which keys of an object stand with which `type` only: {(path of the object, key): types}."""
    found = {}

    def target(node, path):
        for key, below in node.get("properties", {}).items():
            yield from [(path, key)] if below is False else target(below, (*path, key))

    def types(node, path=()):
        for key, below in node.get("properties", {}).items():
            if key == "type" and ("const" in below or "enum" in below):
                yield path, below.get("enum") or [below["const"]]
            else:
                yield from types(below, (*path, key))

    for rule in schema.get("allOf", []):
        conditions = rule["if"].get("anyOf", [rule["if"]])
        for path, key in target(rule.get("else", {}), ()):
            allowed = [choice for condition in conditions for at, values in types(condition) if at == path for choice in values]
            if allowed:
                found[path, key] = allowed
    return found


def _sentence(schema):
    text = schema.get("description", "")
    bounds = [f"{sign} {schema[key]}" for key, sign in (("minimum", ">="), ("exclusiveMinimum", ">"), ("maximum", "<="), ("exclusiveMaximum", "<"))
              if key in schema]
    if bounds:
        text += "; " + " and ".join(bounds)
    if "enum" in schema:
        text += "; one of " + ", ".join(schema["enum"])
    if "default" in schema and schema["default"] not in ("", None):
        text += f"; default {json.dumps(schema['default'])}"
    return text


def object_of(schema):
    """The object among what a key may be: `integrator` may be a name, too."""
    return next((choice for choice in schema.get("anyOf", []) if "properties" in choice), schema)


def choices_of(schema, path, conditions):
    """{type: its keys} of an object, or nothing where it has no types."""
    properties = schema.get("properties", {})
    return {choice: [key for key in properties if key != "type" and choice in conditions.get((path, key), [choice])]
            for choice in properties.get("type", {}).get("enum", [])}


def _signature(keys):
    return inspect.Signature([inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)] +
                             [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in keys])


def _method(choice, names, schema, pointer, of_list):
    """The method of a choice: it sets the part, or appends an entry of the list."""
    keys = {attribute(key): key for key in names}
    if of_list:
        def method(self, **given):
            unknown = [name for name in given if name not in keys]
            if unknown:
                raise AttributeError(_unknown(f"{self._pointer} of type {choice}", unknown[0], keys))
            return self.add(type=choice, **given)
    else:
        def method(self, **given):
            return self._choose(choice, keys, given)
    method.__name__ = attribute(choice)
    method.__doc__ = f"{_title(schema, pointer)}: {choice}.\n\n" + _lines(keys, schema)
    method.__signature__ = _signature(keys)
    return method


def _lines(keys, schema):
    return "\n".join(f"{name}: {_sentence(schema['properties'][key])}" for name, key in keys.items())


def _class(pointer, schema, path, conditions):
    """The class of an object of the schema, with those of what it holds."""
    schema = object_of(schema)
    members = {"_pointer": pointer, "_schema": schema, "_keys": {}, "_parts": {}, "_choices": {}}
    for key, value in schema.get("properties", {}).items():
        below, name = object_of(value), attribute(key)
        members["_keys"][name] = key
        if "properties" in below:
            members["_parts"][name] = key, _class(f"{pointer}/{key}", value, (*path, key), conditions)
        elif below.get("type") == "array" and "properties" in below.get("items", {}):
            members["_parts"][name] = key, _list(f"{pointer}/{key}", below)
    choices = {} if pointer.endswith("/0") else choices_of(schema, path, conditions)  # an entry's are methods of its list
    for choice, names in choices.items():
        members["_choices"][attribute(choice)] = choice
        members[attribute(choice)] = _method(choice, names, schema, pointer, False)
    members["__doc__"] = f"{_title(schema, pointer)}.\n\n" + _lines(members["_keys"], schema)
    members["__signature__"] = _signature(members["_keys"])
    members["__module__"] = "vlbeam"
    _CLASSES[pointer] = type(class_name(pointer), (Part,), members)
    return _CLASSES[pointer]


def class_name(pointer):
    """/beam/curve is BeamCurve, an entry of /loads is LoadsEntry."""
    return "".join("Entry" if name == "0" else name.title().replace("_", "") for name in pointer.split("/")) or "Scene"


def _title(schema, pointer):
    text = schema.get("description") or (f"An entry of {pointer.removesuffix('/0')}" if pointer else "A scene")
    return text[:1].upper() + text[1:]


def _list(pointer, schema):
    items = schema["items"]
    conditions = _conditions(items)
    members = {"_pointer": pointer, "_kind": _class(pointer + "/0", items, (), conditions), "_choices": {},
               "__doc__": schema.get("description", "")}
    for choice, names in choices_of(items, (), conditions).items():
        members["_choices"][attribute(choice)] = choice
        members[attribute(choice)] = _method(choice, names, items, pointer, True)
    _CLASSES[pointer] = type(class_name(pointer), (PartList,), members)
    return _CLASSES[pointer]


_CLASSES = {}


def _restored(pointer, value):
    return scene_class() and _CLASSES[pointer](value)


def _resolved(part, whole):
    """A schema with what it refers to in place of the reference."""
    if isinstance(part, list):
        return [_resolved(entry, whole) for entry in part]
    if not isinstance(part, dict):
        return part
    if "$ref" in part:
        found = whole
        for key in part["$ref"].removeprefix("#/").split("/"):
            found = found[key]
        return _resolved(found, whole)
    return {key: _resolved(value, whole) for key, value in part.items()}


@lru_cache(maxsize=1)
def scene_class():
    """The class of scenes, made at first use."""
    schema = json.loads(_vlbeam.schema("scene"))
    schema = _resolved(schema, schema)
    return _class("", schema, (), _conditions(schema))
