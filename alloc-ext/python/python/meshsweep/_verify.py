"""Proves models."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import NamedTuple

from . import _meshsweep
from ._arrays import word
from ._mesh import Mesh, files, given
from ._meshsweep import BuildError, QueryError
from ._model import Model


class Finding(NamedTuple):
    """A claim of a model, and the outcome of its proof."""

    structure: str
    """As "box tree"."""
    outcome: str
    """ "proved", "failed", or "not proved": neither the claim nor its opposite."""
    text: str
    """The claim that was proved, the place where it fails, or why there is no proof."""
    counts: dict[str, int]
    """Counts of the proof, by name."""


class Proof(NamedTuple):
    """The outcomes of the proofs of a model. Falsy if any claim is not proved."""

    proved: list[Finding]
    unproved: list[Finding]
    """Claims that failed, and claims without a proof."""

    def __bool__(self) -> bool:
        return bool(self.proved) and not self.unproved


def verify(
    model: Model,
    mesh: Mesh,
    *,
    unit: str | None = None,
    frames: Iterable[str | os.PathLike[str]] = (),
) -> Proof:
    """Proves the claims of a model about the mesh, or the curves, that it was built from.

    The blob is parsed again, by code that the build and the questions do not use. The mesh file is
    read by the build's loader, and its repair is proved. `mesh`, `unit` and `frames` are those of
    `build`. The claims: the mesh is that of the file but for repairs; boxes, hulls and triboxes
    hold the mesh; stated errors are bounds.

    `if verify(model, mesh)` is true only if all claims are proved. Raises `BuildError` if the mesh
    is refused. The proofs take a few times as long as the build. Ctrl-C ends the call; threads of
    the proofs may run on for a while.
    """
    if not isinstance(model, Model):
        raise QueryError(f"a Model is wanted, not {type(model).__name__}")
    keys, symbol = files(frames, "frames"), word(unit, "unit", BuildError)
    found = [
        Finding(structure, outcome, text, dict(counts))
        for structure, outcome, text, counts in _meshsweep.verify(
            model._model, given(mesh), symbol, keys
        )
    ]
    proved = [finding for finding in found if finding.outcome == "proved"]
    return Proof(proved, [finding for finding in found if finding.outcome != "proved"])
