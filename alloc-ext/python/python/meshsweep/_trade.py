"""Measures the widest intervals and the costs of settings, and chooses one that meets limits."""

from __future__ import annotations

from typing import Any, NamedTuple, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike

from . import _meshsweep
from ._arrays import checked, numbers, single, whole, word, yes_or_no
from ._mesh import Bar, Mesh, OnProgress, Progress, given
from ._meshsweep import BuildError
from ._model import Model

# Points or segments of a kind, at most.
_MOST = 1_000_000


class Instructions(NamedTuple):
    """Predicted instructions of a query on a processor."""

    cpu: str
    mean: float
    most: float
    """Of the costliest query that was measured."""
    at_most: float
    """`most` times the largest factor by which the fit missed a question's costliest query."""
    error: float
    """Largest relative error of a predicted mean when costs were fitted."""
    stack: int
    """Bytes of the processor's stack, at most."""


class TradeRow(NamedTuple):
    """A setting, its widest measured interval, and its cost. Lengths are in the mesh's unit."""

    structure: str
    budget: str
    """The options of its queries: "exact", or tolerances and steps, and what is kept between
    queries. `meshsweep trade` calls them dials."""
    build: str
    """Options of `meshsweep build` that give it."""
    error: float | None
    """The width of the widest interval that was measured. Intervals of other queries may be wider,
    and hold. `None` of lower bounds."""
    median_error: float | None
    """The median of the widths."""
    undecided: int
    """Segments that stayed undecided; of curves sides, and verdicts of `within`."""
    instructions: dict[str, Instructions]
    """By the name of the processor. One without fitted costs is missing."""
    flash: int
    """Bytes of the blob."""
    scratch: int
    """Bytes of scratch, and of memory that is kept between queries."""
    nanoseconds: float
    """Of a mean query on one thread here."""
    is_best: bool
    """Whether no other row is as good in `error`, mean instructions of the Cortex-M4F and `flash`,
    and better in one of them. Other processors are not compared. Of equal rows the first is
    best."""


class Trade(NamedTuple):
    """The widest measured interval and the cost of each setting of each structure."""

    rows: list[TradeRow]
    not_built: list[tuple[str, str]]
    """Structures that the mesh does not allow, and why."""
    needles: float
    """The fraction of the triangles that are fifty times as long as high. From 0.1 on the mesh
    takes more instructions than predicted, which `at_most` allows for."""


class Choice(NamedTuple):
    """A setting that meets limits, and its model."""

    model: Model
    first: TradeRow
    """The setting: `budget` has the options of firmware's queries, `build` those of the build."""
    second: TradeRow | None
    """The best of the other settings that meet the limits and have less of something."""
    needles: float
    """As in `Trade`."""


def trade(
    mesh: Mesh,
    for_: str = "closest",
    *,
    at: str | ArrayLike = "near",
    count: int = 1000,
    progress: Progress = None,
    unit: str | None = None,
    closed: bool = False,
) -> Trade:
    """Measures the widest interval and the cost of each setting: `meshsweep trade`.

    `mesh`, `unit` and `closed` as of `build`. `for_` is "closest" or "segment". `at` is "near" the
    surface, "far", or a "path", of `count` points or segments, at most a million; or points of
    shape (n, 3), segments of shape (n, 2, 3), which are rounded to single precision.

    Curves are measured for "closest". Their rows are of distances, of verdicts of `within`, and, of
    a fence, of sides.

    Cost: a build for each structure, and each query against all triangles in double precision.
    `progress` is called as that of `build`, from another thread. Its exception, and Ctrl-C, end the
    call; threads that measure may work on for a while. Raises `BuildError` if the mesh or an option
    is refused.
    """
    with Bar(progress) as on_progress:
        found = _meshsweep.trade(_wanted(mesh, for_, at, count, unit, closed, on_progress))
    rows = [_row(row) for row in found["rows"]]
    return Trade(rows, found["not_built"], found["needles"])


def choose(
    mesh: Mesh,
    for_: str = "closest",
    *,
    flash: int | None = None,
    ram: int | None = None,
    error: SupportsFloat | None = None,
    rate: SupportsFloat | None = None,
    cpu: tuple[str, SupportsFloat] | None = None,
    at: str | ArrayLike = "near",
    count: int = 1000,
    progress: Progress = None,
    unit: str | None = None,
    closed: bool = False,
) -> Choice:
    """Builds the model that meets limits, as `meshsweep build` with limits.

    `flash` is the most bytes of the blob, `ram` those of scratch, of what is kept between queries,
    and of the processor's stack. `error` is the widest interval, in the mesh's unit. `rate` is the
    number of queries a second on `cpu`, a processor and its clock in Hz, as ("m4f", 168e6); others
    are "m7" and "m0". At least one limit is wanted. All else is as for `trade`, which measures.

    Of the settings that meet all limits the one of the fewest undecided segments is chosen, then
    with `error` the one of the fewest instructions, else the one of the smallest error. Of a fence
    a setting of sides is chosen. Raises `BuildError`, which names the nearest setting, if none
    meets the limits.
    """
    device: _meshsweep._Device = {
        "flash": whole(flash, "flash", BuildError),
        "ram": whole(ram, "ram", BuildError),
        "error": None if error is None else checked(error, "error", BuildError),
        "rate": None if rate is None else checked(rate, "rate", BuildError),
        "cpu": None,
    }
    given_limits = [limit for limit in device.values() if limit is not None]
    if not given_limits or 0 in given_limits:
        raise BuildError("choose: one of flash, ram, error and rate is wanted, each above 0")
    if cpu is not None:
        name, clock = _processor(cpu)
        device["cpu"] = name, clock
    elif rate is not None:
        raise BuildError('rate: it takes a processor, as cpu=("m4f", 168e6)')
    with Bar(progress) as on_progress:
        wanted = _wanted(mesh, for_, at, count, unit, closed, on_progress)
        model, found = _meshsweep.choose(wanted, device)
    second = None if found["second"] is None else _row(found["second"])
    return Choice(Model(model), _row(found["first"]), second, found["needles"])


def _processor(cpu: tuple[str, SupportsFloat]) -> tuple[str, float]:
    try:
        name, clock = cpu
    except (TypeError, ValueError):
        name, clock = "", 0
    hertz = checked(clock, "cpu", BuildError)
    if not isinstance(name, str) or not hertz:
        raise BuildError(f'cpu: a name and a clock in Hz are wanted, as ("m4f", 168e6), not {cpu}')
    return name, hertz


def _wanted(
    mesh: Mesh,
    for_: str,
    at: str | ArrayLike,
    count: int,
    unit: str | None,
    closed: bool,
    on_progress: OnProgress,
) -> _meshsweep._Wanted:
    """What is measured."""
    places: str | list[list[float]]
    if isinstance(at, str):
        places = at
    else:
        given_places = numbers(at, "at", BuildError)
        shape, wanted = ((2, 3), "(n, 2, 3)") if for_ == "segment" else ((3,), "(n, 3)")
        if given_places.shape[1:] != shape:
            raise BuildError(f"at: shape {wanted} is wanted, not {given_places.shape}")
        if not np.all(np.isfinite(single(given_places))):
            raise BuildError("at: a number is not finite, or beyond single precision")
        places = single(given_places).reshape(-1, 3).tolist()
    most = whole(count, "count", BuildError)
    if not most:
        raise BuildError("count: at least 1 is wanted")
    if most > _MOST:
        raise BuildError(f"count: at most {_MOST} is wanted, not {most}")
    return {
        "mesh": given(mesh),
        "for_": word(for_, "for_", BuildError) or str(for_),
        "at": places,
        "count": most,
        "unit": word(unit, "unit", BuildError),
        "closed": yes_or_no(closed, "closed", BuildError),
        "progress": on_progress,
    }


def _row(row: dict[str, Any]) -> TradeRow:
    boards = [Instructions(**board) for board in row["instructions"]]
    return TradeRow(**{**row, "instructions": {board.cpu: board for board in boards}})
