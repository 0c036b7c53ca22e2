from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._scene import Scene as Scene

__version__: str

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

class Along:
    min: Array
    max: Array
    x_min: Array
    x_max: Array

class Ends:
    start: Array
    end: Array

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
    bending_moment: Along
    shear_force: Along
    torque: Along
    stress: Along
    angles: Ends
    tension: Ends
    places: Any
    reactions: Any
    flow: Any
    units: dict[str, str]
    descriptions: dict[str, str]
    def __getattr__(self, name: str) -> Any: ...
    def __getitem__(self, name: str) -> Array: ...
    @property
    def title(self) -> str: ...
    @property
    def status(self) -> str: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def error(self) -> Record | None: ...
    @property
    def warnings(self) -> list[Record]: ...
    @property
    def events(self) -> list[Record]: ...
    @property
    def extremes(self) -> dict[str, Record]: ...
    @property
    def shape_times(self) -> list[float]: ...
    def shape(self, index: int, points: int = 8) -> Record: ...
    def report(self) -> dict[str, Any]: ...
    def csv(self) -> str: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    def to_pandas(self) -> Any: ...
    def plot(self, *names: str, ax: Any = None) -> Any: ...

class Convergence(Record):
    title: str
    quantity: str
    unit: str
    t: float
    error: float
    answer: float
    uncertainty: float
    reached: bool
    reason: str
    predictable_until: float  # of motions
    horizon: float
    setting: Record
    finest: Record
    parts: Record
    levels: list[Record]
    def to_pandas(self) -> Any: ...
    def plot(self, ax: Any = None) -> Any: ...

def run(scene: Mapping[str, Any] | str, *, check: bool | None = None, progress: bool = True) -> Result: ...
def converge(
    scene: Mapping[str, Any] | str,
    quantity: str,
    error: float,
    *,
    relative: bool = False,
    at: float | None = None,
    horizon: bool = False,
    jobs: int = 0,
    limit: float | None = None,
    progress: bool = True,
) -> Convergence: ...
def sweep(
    scene: Mapping[str, Any] | str,
    over: Mapping[str, Sequence[Any] | Mapping[str, Any]],
    *,
    quantities: Sequence[str] | None = None,
    combine: str = "product",
    jobs: int = 0,
    progress: bool = True,
) -> Record: ...
def scene(name: str) -> Scene: ...
def scenes() -> dict[str, str]: ...
def schema(of: str = "scene") -> dict[str, Any]: ...
