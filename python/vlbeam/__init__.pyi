from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

Scene = Mapping[str, Any]
Array = NDArray[np.float64]

class InvalidInput(ValueError):
    field: str
    value: str
    allowed: str

class ComputationFailed(RuntimeError):
    result: Result

class Record(dict[str, Any]):
    def __getattr__(self, name: str) -> Any: ...

class Energy:
    kinetic: Array
    axial: Array
    bending: Array
    torsion: Array
    gravity: Array
    dissipated: Array
    supplied: Array
    total: Array
    discrete_total: Array

class Contact:
    force: Array
    tangential: Array
    normal: Array

class Extremes:
    min: Array
    max: Array

class Result:
    t: Array
    joint_position: Array
    joint_velocity: Array
    mass_position: Array
    end: Array
    beam_length: Array
    beam_length_rate: Array
    energy: Energy
    momentum: Array
    angular_momentum: Array
    contact: Contact
    axial_strain: Extremes
    axial_force: Extremes
    curvature: Extremes
    reactions: Any
    flow: Any
    units: dict[str, str]
    warnings: list[Record]
    events: list[Record]
    descriptions: dict[str, str]
    def __getitem__(self, name: str) -> Array: ...
    @property
    def status(self) -> str: ...
    @property
    def shape_times(self) -> list[float]: ...
    def shape(self, index: int, points: int = 8) -> Record: ...
    def report(self) -> dict[str, Any]: ...
    def csv(self) -> str: ...
    def save(self, path: str | PathLike[str]) -> None: ...

def run(scene: Scene | str) -> Result: ...
def converge(
    scene: Scene | str,
    quantity: str,
    error: float,
    *,
    relative: bool = False,
    at: float | None = None,
    horizon: bool = False,
    jobs: int = 0,
) -> Record: ...
def sweep(
    scene: Scene | str,
    over: Mapping[str, Sequence[Any] | Mapping[str, Any]],
    *,
    quantities: Sequence[str] | None = None,
    combine: str = "product",
    jobs: int = 0,
) -> Record: ...
def scene(name: str) -> dict[str, Any]: ...
def scenes() -> dict[str, str]: ...
def schema(of: str = "scene") -> dict[str, Any]: ...
