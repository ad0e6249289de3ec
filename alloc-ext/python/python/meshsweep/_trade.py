"""Measures what settings guarantee and cost."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _meshsweep
from ._arrays import numbers, single, whole, word
from ._mesh import Bar, Mesh, Progress, given
from ._meshsweep import BuildError


class Instructions(NamedTuple):
    """Predicted instructions of a query on a processor."""

    cpu: str
    mean: float
    most: float
    """Of the costliest query that was asked."""
    at_most: float
    """The same, times the most that predictions were short of counts when they were fitted."""
    error: float
    """Largest relative error of a predicted mean when costs were fitted."""
    stack: int
    """Bytes of the processor's stack, at most."""


class TradeRow(NamedTuple):
    """A setting, what it guarantees and what it costs. Lengths are in the mesh's unit."""

    structure: str
    dials: str
    """How it is asked: "exact", or tolerances, steps, and what is kept between queries."""
    build: str
    """Options of `meshsweep build` that give it."""
    error: float | None
    """The widest interval that was found: of other queries it may be wider, and holds. `None` of
    lower bounds."""
    median_error: float | None
    undecided: int
    """Segments that stayed undecided."""
    instructions: dict[str, Instructions]
    """By the name of the processor. One without fitted costs is missing."""
    flash: int
    """Bytes of the blob."""
    scratch: int
    """Bytes of scratch, and of memory that is kept between queries."""
    nanoseconds: float
    """Of a mean query on one thread here."""
    is_best: bool
    """Whether no other row has as small an error, as few instructions and as little flash."""


class Trade(NamedTuple):
    """What each setting of each structure costs and guarantees."""

    rows: list[TradeRow]
    not_built: list[tuple[str, str]]
    """Structures that the mesh does not allow, and why."""
    needles: float
    """The part of the triangles that are fifty times as long as high: from 0.1 on the mesh takes
    more instructions than predicted, which `at_most` allows for."""


def trade(
    mesh: Mesh,
    for_: str = "closest",
    *,
    at: str | ArrayLike = "near",
    count: int = 1000,
    progress: Progress = None,
    unit: str | None = None,
) -> Trade:
    """Measures what each setting of each structure guarantees and costs: `meshsweep trade`.

    `mesh` and `unit` as of `build`. `for_` is "closest" or "segment". `at` is "near" the surface,
    "far", or a "path", of `count` points or segments; or points of shape (n, 3), segments of shape
    (n, 2, 3), which are rounded to single precision.

    Cost: a build for each structure, and each query against all triangles in double precision.
    `progress` is called as that of `build`, from another thread. Its exception, and Ctrl-C, end the
    call; threads that measure may work on for a while. Raises `BuildError` if the mesh or an option
    is refused.
    """
    places: str | list[list[float]]
    if isinstance(at, str):
        places = at
    else:
        asked = numbers(at, "at", BuildError)
        shape, wanted = ((2, 3), "(n, 2, 3)") if for_ == "segment" else ((3,), "(n, 3)")
        if asked.shape[1:] != shape:
            raise BuildError(f"at: shape {wanted} is wanted, not {asked.shape}")
        if not np.all(np.isfinite(single(asked))):
            raise BuildError("at: a number is not finite, or beyond single precision")
        places = single(asked).reshape(-1, 3).tolist()
    most = whole(count, "count", BuildError)
    if not most:
        raise BuildError("count: at least 1 is wanted")
    question, symbol = word(for_, "for_", BuildError) or str(for_), word(unit, "unit", BuildError)
    with Bar(progress) as tell:
        found = _meshsweep.trade(given(mesh), question, places, most, symbol, tell)
    rows = []
    for row in found["rows"]:
        boards = [Instructions(**board) for board in row["instructions"]]
        rows.append(TradeRow(**{**row, "instructions": {board.cpu: board for board in boards}}))
    return Trade(rows, found["not_built"], found["needles"])
