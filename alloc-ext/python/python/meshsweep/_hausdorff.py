"""How far two meshes are from each other."""

from __future__ import annotations

from typing import Any, NamedTuple, SupportsFloat

import numpy as np
from numpy.typing import NDArray

from . import _meshsweep
from ._arrays import checked, word, yes_or_no
from ._mesh import Mesh, given
from ._meshsweep import BuildError


class Hausdorff(NamedTuple):
    """Bounds of a Hausdorff distance. Lengths are in the meshes' unit."""

    lower: float
    upper: float
    """`lower` ≤ distance ≤ `upper`, in real arithmetic, between the meshes as they were given."""
    point_a: NDArray[np.float64] | None
    """Shape (3,): one of the two points that attain `lower`, but for rounding; `a` has it."""
    point_b: NDArray[np.float64] | None
    """Shape (3,): the other one, on `b`. Both points, their triangles and `is_backward` are `None`
    if no point is known to be apart from the other mesh."""
    triangle_a: int | None
    """Number of the triangle of `point_a` in its mesh as given."""
    triangle_b: int | None
    is_backward: bool | None
    """Whether `point_b` is the farthest point and `point_a` the closest one to it; else the
    opposite."""
    stopped_by: str
    """ "precision" if the bounds are as close as `rel` or `abs`, or `at_most` is decided;
    "rounding" if rounding allows no closer ones; "piece_limit" after 50 million pieces of
    triangles, or with four million in the queue."""
    pieces: int
    """Pieces of triangles that were bounded."""
    holds: bool | None
    """Whether the distance is at most `at_most`; `None` if that is undecided, or was not asked."""
    unit: str | None
    """The unit of lengths, as "mm": `unit`, or that of the files; `None` if no file has one."""
    rounding: tuple[float, float]
    """How far the rounding to single precision moved vertices of `a`, and of `b`. The bounds
    include it."""
    warnings: list[str]
    """Parts of the files that are doubtful or were left out. Each begins with "a: " or "b: "."""


def hausdorff(
    a: Mesh,
    b: Mesh,
    *,
    one_sided: bool = False,
    rel: SupportsFloat = 1e-4,
    abs: SupportsFloat = 0.0,
    at_most: SupportsFloat | None = None,
    unit: str | None = None,
) -> Hausdorff:
    """Bounds how far the farthest point of either mesh is from the other: `meshsweep hausdorff`.

    `a`, `b` and `unit` are as `mesh` and `unit` of `build`, without CSV. Meshes may be open, and
    are surfaces: a
    point inside the other one is apart from it. With `one_sided` only points of `a` count, and the
    distance is that of the farthest of them from `b`.

    The search ends once `upper` ≤ `lower` · (1 + `rel`), or `upper` - `lower` ≤ `abs`. With
    `at_most` it ends, in place of both, once it is known whether the distance is at most that.
    Vertices are rounded to single precision. The bounds include that, so they come no closer than
    `rounding`; nor closer than about 1e-11 times the largest coordinate, by which the cuts of
    triangles are rounded.

    Cost: a box tree of each mesh, a query of each vertex, and more of pieces of triangles: most for
    meshes that are equally far apart everywhere. Raises `BuildError` that names `a` or `b` if it is
    refused, or if they have different units. Runs without the interpreter's lock. Ctrl-C ends the
    call; threads that build a tree may work on for a while.
    """
    precision = (
        checked(rel, "rel"),
        checked(abs, "abs"),
        None if at_most is None else checked(at_most, "at_most"),
    )
    meshes, symbol = (_named(a, "a"), _named(b, "b")), word(unit, "unit", BuildError)
    is_one_sided = yes_or_no(one_sided, "one_sided")
    found = _meshsweep.hausdorff(meshes, is_one_sided, precision, symbol)
    end_a, end_b = found["ends"] or (None, None)
    return Hausdorff(
        lower=found["lower"],
        upper=found["upper"],
        point_a=None if end_a is None else np.array(end_a[0]),
        point_b=None if end_b is None else np.array(end_b[0]),
        triangle_a=None if end_a is None else end_a[1],
        triangle_b=None if end_b is None else end_b[1],
        is_backward=found["is_backward"],
        stopped_by=found["stopped_by"],
        pieces=found["pieces"],
        holds=_holds(found["lower"], found["upper"], precision[2]),
        unit=found["unit"],
        rounding=(found["rounding"][0], found["rounding"][1]),
        warnings=found["warnings"],
    )


def _named(mesh: Any, name: str) -> Any:
    """What was given, or a refusal that names it."""
    try:
        return given(mesh)
    except BuildError as error:
        raise BuildError(f"{name}: {error}") from None


def _holds(lower: float, upper: float, at_most: float | None) -> bool | None:
    if at_most is None or lower <= at_most < upper:
        return None
    return upper <= at_most
