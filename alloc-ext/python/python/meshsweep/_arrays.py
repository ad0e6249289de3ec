"""What callers give, as arrays that Rust reads, or a refusal that names it."""

from __future__ import annotations

import math
import operator
from typing import Any, SupportsFloat, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._meshsweep import MeshsweepError, QueryError
from ._records import Facing

MOST = float(np.finfo(np.float32).max)


def numbers(
    given: ArrayLike, what: str, refused: type[MeshsweepError] = QueryError
) -> NDArray[Any]:
    """An array of real numbers."""
    if isinstance(given, np.ma.MaskedArray):
        raise refused(f"{what}: a masked array is given; leave out what is masked")
    try:
        numbers = np.asarray(given)
    except ValueError as error:
        raise refused(f"{what}: {error}") from None
    if numbers.dtype.kind not in "fiu":
        raise refused(f"{what}: real numbers are wanted, not {numbers.dtype}")
    return numbers


def single(numbers: NDArray[Any]) -> NDArray[np.float32]:
    """In single precision, as Rust reads it. What is too large becomes infinite."""
    with np.errstate(over="ignore"):
        return np.require(numbers, np.float32, ["C", "A"])


def rows(given: ArrayLike, what: str, widths: tuple[int, ...] = (3,)) -> NDArray[Any]:
    """Rows of one of these widths; zeros fill them up to the first."""
    rows = numbers(given, what)
    if rows.ndim == 1 and rows.shape[0] in widths:
        rows = rows[None, :]
    if rows.ndim != 2 or rows.shape[1] not in widths:
        wanted = " or ".join(f"(n, {width})" for width in widths)
        raise QueryError(f"{what}: shape {wanted} is wanted, not {rows.shape}")
    missing = widths[0] - rows.shape[1]
    return np.pad(rows, [(0, 0), (0, missing)]) if missing else rows


def pairs(a: ArrayLike, b: ArrayLike) -> NDArray[np.float32]:
    """Rows of six: both ends, or origin and direction."""
    first, second = rows(a, "starts"), rows(b, "ends")
    try:
        first, second = np.broadcast_arrays(first, second)
    except ValueError:
        raise QueryError(f"{len(first)} starts for {len(second)} ends") from None
    return single(np.hstack([first, second]))


def framed(
    rows: NDArray[Any], what: str, frame: ArrayLike
) -> tuple[NDArray[Any], NDArray[np.float32]]:
    """Rows, and a column of the frame of each. One of both may be given once for all."""
    frames = numbers(frame, "frame")
    if frames.ndim > 1:
        raise QueryError(f"frame: one number or shape (n,) is wanted, not {frames.shape}")
    column = single(frames.reshape(-1, 1))
    try:
        (count,) = np.broadcast_shapes((len(rows),), (len(column),))
    except ValueError:
        raise QueryError(f"{len(rows)} {what} for {len(column)} frames") from None
    return np.broadcast_to(rows, (count, rows.shape[1])), np.broadcast_to(column, (count, 1))


def poses(poses: ArrayLike | None) -> NDArray[np.float32]:
    """Rows of twelve: the upper three rows of each matrix."""
    matrices = np.eye(4) if poses is None else numbers(poses, "poses")
    if matrices.ndim == 2:
        matrices = matrices[None]
    if matrices.ndim != 3 or matrices.shape[1:] not in [(4, 4), (3, 4)]:
        raise QueryError(f"poses: shape (n, 4, 4) or (n, 3, 4) is wanted, not {matrices.shape}")
    wrong = np.flatnonzero(np.any(matrices[:, 3:] != [0, 0, 0, 1], axis=(1, 2)))
    for row in wrong[:1]:
        last = matrices[row, 3].tolist()
        raise QueryError(f"row {row}: the last row is {last}, not 0, 0, 0, 1: transposed?")
    return single(matrices[:, :3, :].reshape(len(matrices), 12))


def solids(given: ArrayLike, what: str = "corners") -> NDArray[Any]:
    """Corners of n solids: shape (n, k, 3)."""
    corners = numbers(given, what)
    if corners.ndim == 2:
        corners = corners[None]
    if corners.ndim != 3 or corners.shape[2] != 3:
        raise QueryError(f"{what}: shape (n, k, 3) is wanted, not {corners.shape}")
    if not 1 <= corners.shape[1] <= 32:
        raise QueryError(f"{what}: 1 to 32 corners are wanted, not {corners.shape[1]}")
    return corners


def real(number: SupportsFloat, what: str, refused: type[MeshsweepError] = QueryError) -> float:
    """A number, which may be infinite or NaN."""
    try:
        if not isinstance(number, (str, bytes)):
            return float(number)
    except OverflowError:
        raise refused(f"{what}: a number is beyond double precision") from None
    except (TypeError, ValueError):
        pass
    raise refused(f"{what}: one number is wanted, not {number!r}")


def checked(
    number: SupportsFloat, what: str = "distance", refused: type[MeshsweepError] = QueryError
) -> float:
    """A number from 0 to the greatest of single precision."""
    value = real(number, what, refused)
    if not (math.isfinite(value) and value >= 0):
        raise refused(f"{what}: {number} is negative or not finite")
    if value > MOST:
        raise refused(f"{what}: {number} is beyond single precision")
    return value


def distances(given: ArrayLike, count: int) -> NDArray[np.float64]:
    """A distance for all rows, or one for each."""
    if not isinstance(given, (list, tuple)) and np.ndim(given) == 0:
        return np.array([checked(cast(SupportsFloat, given))])
    values = numbers(given, "distance").astype(np.float64)
    if values.shape != (count,):
        wanted = f"one number or shape ({count},)"
        raise QueryError(f"distance: {wanted} is wanted, not {values.shape}")
    for row in np.flatnonzero(~((values >= 0) & (values <= MOST)))[:1]:
        checked(values[row], f"row {row}: distance")
    return values


def whole(number: int | None, what: str, refused: type[MeshsweepError] = QueryError) -> int | None:
    """A whole number of 32 bits, if any is given."""
    try:
        value = None if number is None else operator.index(number)
    except TypeError:
        raise refused(f"{what}: a whole number is wanted, not {number!r}") from None
    if value is not None and not 0 <= value < 2**32:
        raise refused(f"{what}: {value} is none from 0 to 2^32 - 1")
    return value


def word(given: str | None, what: str, refused: type[MeshsweepError] = QueryError) -> str | None:
    """A word, if any is given."""
    if given is not None and not isinstance(given, str):
        raise refused(f"{what}: a string is wanted, not {given!r}")
    return given


def yes_or_no(given: bool, what: str, refused: type[MeshsweepError] = QueryError) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise refused(f"{what}: True or False is wanted, not {given!r}")
    return bool(given)


def facing(facing: Facing | int) -> int:
    try:
        return int(Facing(facing))
    except ValueError:
        raise QueryError(f"facing: a meshsweep.Facing is wanted, not {facing!r}") from None


def limits(
    rel: SupportsFloat, abs: SupportsFloat, steps: int | None
) -> tuple[float, float, int | None]:
    """Tolerances, and steps."""
    return checked(rel, "rel"), checked(abs, "abs"), whole(steps, "steps")
