"""Answers about input in double precision, from queries in single precision."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import MOST, pairs, rows, single
from ._meshsweep import QueryError
from ._records import Ended, Records, Side, Verdict


def rounded(rows: NDArray[Any]) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
    """Points in single precision, and upper bounds of the distances that rounding moved them by;
    `None` if it moved none."""
    near = single(rows)
    if rows.dtype.kind == "f" and rows.dtype.itemsize <= 4:
        return near, None
    with np.errstate(over="ignore"):
        wide = rows.astype(np.float64)
    # These differences are exact. A number that is not finite is refused later.
    with np.errstate(invalid="ignore"):
        off = np.abs(wide - near)
    if rows.dtype.kind in "iu" or rows.dtype.itemsize > 8:
        # The conversion to double precision rounds large integers and long doubles, and the least
        # of them to 0.
        is_exact = (np.abs(wide) < 2.0**53) if rows.dtype.kind in "iu" else wide == rows
        off = np.where(is_exact, off, off + np.abs(wide) * 2.0**-52 + 5e-324)
    off[~np.isfinite(off)] = 0.0
    if not np.any(off):
        return near, None
    moved = np.nextafter(np.linalg.norm(off, axis=-1).astype(np.float32), np.float32(np.inf))
    return near, np.where(np.any(off, axis=-1), moved, np.float32(0))


def moved_pairs(a: ArrayLike, b: ArrayLike) -> NDArray[np.float32]:
    """Rows of eight: those of `pairs`, and for each of both points an upper bound of the distance
    that rounding moved it by."""
    both = pairs(a, b)
    bounds = [rounded(rows(a, "starts"))[1], rounded(rows(b, "ends"))[1]]
    columns = [np.zeros(1, np.float32) if moved is None else moved for moved in bounds]
    return np.column_stack([both, *[np.broadcast_to(moved, len(both)) for moved in columns]])


def widened(
    found: Records, moved: NDArray[np.float32] | None, *, is_signed: bool = True
) -> Records:
    """Intervals of distances, widened so that they hold for the points before rounding. With
    `is_signed` the intervals of records with a side may be negative."""
    if moved is None:
        return found
    slack = moved.reshape(moved.shape + (1,) * (found.ndim - 1))
    is_held = slack == 0
    names = found.dtype.names or ()
    lower = np.nextafter(found.lower - slack, np.float32(-np.inf))
    lower = np.where(is_held, found.lower, lower)
    if "upper" in names:
        upper = np.nextafter(found.upper + slack, np.float32(np.inf))
        upper = found.upper[:] = np.where(is_held, found.upper, upper)
    if "side" in names:
        certain = np.where(lower > 0, Side.OUTSIDE, np.where(upper < 0, Side.INSIDE, 0))
        found.side[:] = np.where(is_held | (found.side == certain), found.side, 0)
    if "side" not in names or not is_signed:
        lower = np.maximum(lower, np.float32(0))
    if "safe_motion" in names:
        left = np.nextafter(found.safe_motion - slack, np.float32(-np.inf))
        left = np.where(is_held, found.safe_motion, left)
        found.safe_motion[:] = np.maximum(left, np.float32(0))
    found.lower[:] = lower
    return found


def verdict_at_unrounded_distance(
    ask: Callable[[NDArray[np.float32]], Records],
    distance: float | NDArray[np.float64],
    slack: NDArray[np.float64],
) -> Records:
    """Verdicts about a distance in double precision, one number or one of each row.

    `ask` answers about distances in single precision, of rounded points: no point was moved by more
    than `slack`. A `NO` is that of the distance plus the slack, rounded up. A `YES` is that of the
    distance less the slack, rounded down. Other rows are undecided. `work` adds both questions.
    """
    distance = np.atleast_1d(distance)
    limits = single(distance)
    if np.all(limits == distance) and not np.any(slack):
        return ask(limits)
    if np.any(single(distance + slack) >= MOST):
        raise QueryError("distance: with the rounding it is beyond single precision")
    found = ask(up(distance + slack))
    near = ask(down(np.maximum(distance - slack, 0.0)))
    work = found.work.astype(np.uint64) + near.work
    found.work[:] = near.work[:] = np.minimum(work, np.uint64(2**32 - 1))
    is_near = (near.verdict == Verdict.YES) & (distance >= slack)
    is_open = (found.verdict == Verdict.YES) & ~is_near
    # By fields: a copy of whole records has any bytes between them.
    for name in found.dtype.names or ():
        found[name][is_near] = near[name][is_near]
    found.verdict[is_open] = Verdict.UNDECIDED
    found.ended[is_open] = Ended.RESOLUTION
    for witness in {"triangle", "triangles", "polyline", "segment"} & {*(found.dtype.names or ())}:
        found[witness][is_open] = -1
    return found


def up(values: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.nextafter(values.astype(np.float32), np.float32(np.inf))


def down(values: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.maximum(np.nextafter(values.astype(np.float32), np.float32(-np.inf)), np.float32(0))


def least(limit: float) -> float:
    """The least number of single precision that is not below the distance."""
    single = np.float32(limit)
    return float(np.nextafter(single, np.float32(np.inf)) if float(single) < limit else single)
