#!/usr/bin/env python3
"""Writes docs/what_comes_out.md, every quantity of a run's samples, from the schema of the program.

    what_comes_out.py PROGRAM [FILE]        (default: docs/what_comes_out.md; - is standard output)
"""

import json
import re
import subprocess
import sys
from pathlib import Path

HEAD = """# What comes out

Every quantity of a run's samples, by the name that `converge`, `sweep`, `plot`, the CSV file and Python take. Vectors have the components
`.x`, `.y` and, in space, `.z`. A scene has those that mean something in it; a name that it does not have is answered with those that it
has. Made by `docs/what_comes_out.py build/vlbeam`.

**At a place.** `places` of a scene name points of the beam: a material coordinate, an end, a joint, or a point mass. Their position,
velocity, direction, axial force, shear, bending moment, torque and stress are then quantities like all others.

```json
{"places": [{"name": "root", "x": 0}, {"name": "middle", "x": 0.5}, {"name": "fairlead", "end": "end"}]}
```

**Over time.** With `"extremes": true` in `output` the report has an object `extremes`: the largest and the least value of each quantity
over all steps, and when. `vlbeam run --extremes` asks for the same, and prints those that people ask for. `converge` and `sweep` take
`bending_moment.max.largest`, `.least`, `.largest_at` and `.least_at` behind any name; they ask for it themselves. A run looks at every
step, not at the samples, so what comes out does not depend on the output interval.

**How right they are.** The default accuracy is 1e-4 of the beam's length, for places. Forces follow from second derivatives, or from
accelerations: `converge` says how far each is off. On 8 elements a girder that hardly bends has its moments and shears right to 1e-5. A
cantilever that a force P = 3 EI/L^2 bends far has the moment at its clamp right to 4e-4 P L and the shear there to 1.6e-2 P; on 16 elements
to 3e-5 P L and 2.3e-3 P ([how](theory/section_forces.md)). Tension at an end that is held is that of its reaction. What vibrates on the
mesh is in all forces of a motion: a load that grows smoothly (`ramp`, `gravity_ramp`) leaves less of it.
"""

PARTS = [
    ("Motion", ("t", "load_factor", "end", "beam_length", "beam_length_rate", "angles")),
    ("What slides", ("joint_position", "joint_velocity", "mass_position", "contact", "holding_force", "sliding_joints", "winches")),
    ("Forces in the beam", ("axial_force", "bending_moment", "shear_force", "torque", "stress", "axial_strain", "curvature")),
    ("Forces on the beam", ("tension", "reactions", "supports", "vehicles")),
    ("Places", ("places",)),
    ("Balances", ("energy", "momentum", "angular_momentum", "negative_pivots", "flow")),
]


def leaves(schema, name):
    """(name, schema) of every column below."""
    if "properties" not in schema and "patternProperties" not in schema:
        yield name, schema
        return
    for key, value in schema.get("properties", {}).items():
        yield from leaves(value, f"{name}.{key}" if name else key)
    for pattern, value in schema.get("patternProperties", {}).items():
        key = "node_N" if "node" in pattern else "NAME"
        yield from leaves(value, f"{name}.{key}")


def row(name, schema):
    text = schema["description"].replace("; one entry a sample", "")
    unit = re.search(r" \[([^\]]*)\]$", text)
    text = text[: unit.start()] if unit else text
    return f"| `{name}` | {unit[1] if unit else '-'} | {text[:1].upper() + text[1:]} |"


def page(samples):
    properties = samples["properties"]
    placed = {key for _, keys in PARTS for key in keys}
    if set(properties) != placed:
        sys.exit(f"what_comes_out.py: name a part for {sorted(set(properties) ^ placed)}")
    text = HEAD
    for title, keys in PARTS:
        rows = [row(name, schema) for key in keys for name, schema in leaves(properties[key], key)]
        text += f"\n## {title}\n\n| name | unit | meaning |\n|---|---|---|\n" + "\n".join(rows) + "\n"
    return text


def main():
    told = subprocess.run([sys.argv[1], "schema", "run"], capture_output=True, text=True, check=True)
    text = page(json.loads(told.stdout)["properties"]["samples"]["anyOf"][0])
    file = sys.argv[2] if len(sys.argv) > 2 else Path(__file__).with_suffix(".md")
    if file == "-":
        sys.stdout.write(text)
    else:
        Path(file).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
