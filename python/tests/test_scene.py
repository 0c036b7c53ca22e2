"""Scenes as objects: the keys, choices and words of the option table, and still dictionaries."""

import ast
import copy
import json
import pickle
from pathlib import Path

import pytest
import vlbeam


@pytest.fixture
def built():
    scene = vlbeam.Scene(title="Built", gravity=[0, -9.81], duration=0.1)
    scene.beam.curve.line(start=[0, 0], end=[1, 0])
    scene.beam.section.circle(radius=0.01)
    scene.beam.material(density=7200, youngs_modulus=2e7)
    scene.beam.elements = 10
    scene.supports.clamp(at="start")
    scene.sliding_mass(mass=0.8, position=0.1)
    scene.integrator.generalized_alpha(step=1e-3)
    return scene


def test_what_is_built_is_a_dictionary(built):
    assert json.loads(built.to_json()) == built == {
        "title": "Built", "gravity": [0, -9.81], "duration": 0.1,
        "beam": {"curve": {"type": "line", "start": [0, 0], "end": [1, 0]}, "section": {"type": "circle", "radius": 0.01},
                 "material": {"density": 7200, "youngs_modulus": 2e7}, "elements": 10},
        "supports": [{"type": "clamp", "at": "start"}], "sliding_mass": {"mass": 0.8, "position": 0.1},
        "integrator": {"type": "generalized-alpha", "step": 1e-3}}
    assert vlbeam.run(built).joint_position.tolist() == vlbeam.run(json.loads(built.to_json())).joint_position.tolist()


def test_what_is_only_looked_at_adds_nothing():
    scene = vlbeam.Scene()
    assert scene.beam.curve == {} and scene.supports == [] and scene == {}
    scene.beam.curve.start = [0, 1]
    assert scene == {"beam": {"curve": {"start": [0, 1]}}}


def test_a_choice_takes_the_place_of_another():
    scene = vlbeam.scene("falling_beam")
    scene.beam.curve.arc(radius=2, from_degrees=0, to_degrees=90)
    assert scene["beam"]["curve"] == {"type": "arc", "radius": 2, "from_degrees": 0, "to_degrees": 90}


def test_plain_dictionaries_within_have_attributes_too():
    scene = vlbeam.scene("falling_beam")
    scene["output"] = {"interval": 0.1}
    scene.output.configurations = [0, 0.5]
    assert scene["output"] == {"interval": 0.1, "configurations": [0, 0.5]}
    scene["supports"].append({"at": "end", "type": "pin"})
    assert [support["type"] for support in scene.supports] == ["clamp", "pin"]


@pytest.mark.parametrize("attempt, words", [
    (lambda s: setattr(s.beam, "elments", 3), "/beam has no key 'elments'; the nearest is 'elements'"),
    (lambda s: s.supports.clmp(at="end"), "/supports has no key 'clmp'; the nearest is 'clamp'"),
    (lambda s: s.supports.clamp(att="end"), "/supports of type clamp has no key 'att'; the nearest is 'at'"),
    (lambda s: s.beam.curve.line(radius=1), "/beam/curve has no key 'radius'; there are: end, start"),
    (lambda s: s.beam.rest_shape, "/beam/rest_shape is not set; where strains are measured from"),
    (lambda s: vlbeam.Scene(titel="x"), "a scene has no key 'titel'; the nearest is 'title'"),
])
def test_what_is_not_there_is_named_with_what_is(attempt, words):
    with pytest.raises(AttributeError) as caught:
        attempt(vlbeam.scene("falling_beam"))
    assert words in str(caught.value)


def test_no_key_is_hidden_by_a_choice():
    """A support of type clamp has a key clamp."""
    scene = vlbeam.Scene()
    scene.supports.clamp(at="start", clamp="full")
    assert scene.supports[0].clamp == "full"
    vlbeam.run(vlbeam.scene("pendulum"))
    for pointer, kind in vlbeam._scene._CLASSES.items():
        assert not set(getattr(kind, "_keys", {})) & set(kind._choices), pointer


def test_copies_are_scenes(built):
    for other in (copy.deepcopy(built), pickle.loads(pickle.dumps(built))):
        assert other == built and isinstance(other, vlbeam.Scene)
        other.beam.elements = 4
        assert built.beam.elements == 10


def test_completion_and_help_know_the_option_table(built):
    assert {"line", "arc", "nurbs", "start"} <= set(dir(built.beam.curve))
    assert {"clamp", "pin", "slide", "add"} <= set(dir(built.supports))
    assert "radius: of a circle" in built.beam.section.circle.__doc__ or "[m]" in built.beam.section.circle.__doc__
    assert "youngs_modulus" in type(built.beam.material).__doc__ and "[Pa]" in type(built.beam.material).__doc__


def test_every_key_of_every_example_is_known():
    def keys(part):
        for name, value in part.items():
            assert name in part._keys.values(), (part._pointer, name)
            if isinstance(value, dict) and name != "points":  # those have names of their own
                keys(getattr(part, name))
            elif isinstance(value, list) and value and isinstance(value[0], dict):
                for entry in getattr(part, name):
                    keys(entry)

    for name in vlbeam.scenes():
        keys(vlbeam.scene(name))


def test_the_stub_has_the_keys_of_the_option_table():
    tree = ast.parse((Path(vlbeam.__file__).parent / "_scene.pyi").read_text(encoding="utf-8"))
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    names = {name: {getattr(item, "name", None) or item.target.id for item in node.body if isinstance(item, (ast.FunctionDef, ast.AnnAssign))}
             for name, node in classes.items()}
    for pointer, kind in vlbeam._scene._CLASSES.items():
        here = names[kind.__name__]
        assert set(getattr(kind, "_keys", {})) | set(kind._choices) <= here, pointer
    clamp = next(item for item in classes["Supports"].body if getattr(item, "name", "") == "clamp")
    assert {"at", "clamp", "motion", "feed"} <= {argument.arg for argument in clamp.args.kwonlyargs}
