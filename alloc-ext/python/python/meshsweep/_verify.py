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
    """A claim of a model, and what came of its proof."""

    structure: str
    """As "box tree"."""
    outcome: str
    """ "proved", "failed", or "not proved": neither the claim nor its opposite."""
    text: str
    """What was proved; else what does not hold, with its place, or why there is no proof."""
    counts: dict[str, int]
    """What was counted on the way."""


class Proof(NamedTuple):
    """What came of the proofs of a model. Falsy if any claim is open."""

    proved: list[Finding]
    open: list[Finding]
    """Those that failed, and those without a proof."""

    def __bool__(self) -> bool:
        return bool(self.proved) and not self.open


def verify(
    model: Model,
    mesh: Mesh,
    *,
    unit: str | None = None,
    frames: Iterable[str | os.PathLike[str]] = (),
) -> Proof:
    """Proves what a model claims of the mesh, or of the curves, that it was built from.

    By code of its own: a parser, exact arithmetic and a replay that share no code with the build
    or the questions. `mesh`, `unit` and `frames` are those of `build`. The claims: the mesh is that
    of the file but for repairs; boxes, hulls and triboxes hold the mesh; stated errors are bounds.

    `if verify(model, mesh)` is true only if all is proved. Raises `BuildError` if the mesh is
    refused. The proofs take some
    times as long as the build. Ctrl-C ends the call; threads that prove may work on for a while.
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
