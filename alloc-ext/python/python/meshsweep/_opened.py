"""An opened blob: what it holds."""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _meshsweep
from ._meshsweep import BlobError, NotServedError, QueryError


class Note(NamedTuple):
    """A sentence of the report of a build."""

    topic: str
    text: str


class OpenBlob:
    """An opened blob. Its questions are in the classes that inherit it; `Model` has them all."""

    def __init__(self, blob: bytes | bytearray | memoryview | _meshsweep.Model) -> None:
        """Opens the bytes of a blob. Every byte is checked: raises `BlobError`."""
        if isinstance(blob, (str, os.PathLike)):
            raise BlobError(f"bytes are wanted, not {blob!r}: use meshsweep.load for a file")
        if not isinstance(blob, (bytes, bytearray, memoryview, _meshsweep.Model)):
            raise BlobError(f"bytes are wanted, not {type(blob).__name__}")
        self._model = blob if isinstance(blob, _meshsweep.Model) else _meshsweep.Model(bytes(blob))
        self._facts = self._model.facts()
        self._notes = self._model.report()

    def __bytes__(self) -> bytes:
        return self._model.bytes()

    def __reduce__(self) -> tuple[type[OpenBlob], tuple[bytes], list[tuple[str, str]]]:
        return type(self), (bytes(self),), self._notes

    def __setstate__(self, notes: list[tuple[str, str]]) -> None:
        self._notes = notes

    def __eq__(self, other: object) -> bool:
        """Whether the bytes are the same."""
        return bytes(self) == bytes(other) if isinstance(other, OpenBlob) else NotImplemented

    def __hash__(self) -> int:
        return hash(bytes(self))

    def __repr__(self) -> str:
        return f"<meshsweep.Model for {','.join(self.serves)}: {len(bytes(self))} bytes>"

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the blob: what `meshsweep build` writes, for firmware as well."""
        with open(file, "wb") as opened:
            opened.write(bytes(self))

    @property
    def report(self) -> list[Note]:
        """What the build repaired, moved and left out; empty of a model that was loaded."""
        return [Note(*note) for note in self._notes]

    @property
    def serves(self) -> list[str]:
        """The questions that the blob serves, in the words of `for_`."""
        return list(self._facts["serves"])

    @property
    def bounds(self) -> NDArray[np.float32]:
        """Shape (2, 3): a box that holds the input mesh, its vertices included.

        It is the box of the stored geometry, larger by its surface error, and rounded outward; of a
        blob with a distance field alone the field's box. Raises `NotServedError` if the blob has
        neither.
        """
        bounds = self._facts["bounds"]
        if bounds is None:
            raise NotServedError('the blob knows no bounds: build it with for_="closest"')
        return np.array(bounds, np.float32)

    @property
    def is_closed(self) -> bool | None:
        """Whether the mesh bounds a volume; `None` without a box tree."""
        return self._facts["is_closed"]

    @property
    def has_sides(self) -> bool | None:
        """Whether `signed_distance` tells sides; `None` without a box tree and without curves."""
        return self._facts["has_sides"]

    @property
    def frames(self) -> int | None:
        """Number of key frames, that at rest included; `None` of a model that does not deform."""
        return self._facts["frames"]

    @property
    def surface_error(self) -> float | None:
        """No stored point of the box tree's surface, or of the curves, is farther from the input.

        Intervals include it. `None` if the blob has neither a box tree nor curves. Hull hierarchies
        and tight hulls have errors of their own, which their intervals include too.
        """
        return self._facts["surface_error"]

    @property
    def field_kind(self) -> str | None:
        """What a distance field's distances mean: "signed", "solid" or "surface"; else `None`."""
        return self._facts["field_kind"]


def other_of(model: Any) -> _meshsweep.Model:
    """The second model of a question."""
    if not isinstance(model, OpenBlob):
        raise QueryError(f"other: another Model is wanted, not {type(model).__name__}")
    return model._model
