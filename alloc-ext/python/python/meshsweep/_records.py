"""Answers as NumPy records. `src/record.rs` writes them in this order."""

import functools
from collections.abc import Callable, Iterator
from enum import IntEnum
from typing import Any, SupportsIndex, cast, overload

import numpy as np
from numpy.typing import NDArray

Records = np.recarray[Any, Any]

# Fields are where a structure in C has them, so that loops over one find it aligned. Bytes between
# them are 0 in answers, and any in copies that NumPy makes.
_record = functools.partial(np.dtype, align=True)
_INTERVAL = [("lower", "f4"), ("upper", "f4")]
_END = [("ended", "u1"), ("work", "u4")]
_POINT = ("point", "f4", 3)
_SEGMENT = [("polyline", "i8"), ("segment", "i8")]

CLOSEST = _record([*_INTERVAL, _POINT, ("triangle", "i8"), *_END])
CLOSEST_ON_CURVE = _record([*_INTERVAL, _POINT, *_SEGMENT, ("safe_motion", "f4"), *_END])
SIGNED = _record([*_INTERVAL, ("side", "i1"), _POINT, ("triangle", "i8"), *_END])
SIGNED_OF_FENCE = _record(
    [*_INTERVAL, ("side", "i1"), _POINT, *_SEGMENT, ("safe_motion", "f4"), *_END]
)
WITHIN_OF_CURVE = _record([("verdict", "u1"), *_SEGMENT, *_END])
NEAREST_ON_CURVE = _record([*_INTERVAL, _POINT, *_SEGMENT])
ALL_WITHIN_OF_CURVE = _record([*_INTERVAL, _POINT, *_SEGMENT, ("is_certain", "?")])
WITHIN = _record([("verdict", "u1"), ("triangle", "i8"), *_END])
NEAREST = _record([*_INTERVAL, _POINT, ("triangle", "i8")])
ALL_WITHIN = _record([*_INTERVAL, _POINT, ("triangle", "i8"), ("is_certain", "?")])
WINDING = _record([*_INTERVAL, ("side", "i1"), *_END])
FIRST_HIT = _record(
    [("verdict", "u1"), ("t_lower", "f4"), ("t_upper", "f4"), _POINT, ("triangle", "i8"), *_END]
)
DECIDED = _record([("verdict", "u1"), *_END])
ALL_HITS = _record([("verdict", "u1"), ("t", "f4"), _POINT, ("triangle", "i8")])
BOUNDS = _record([*_INTERVAL, *_END])
SIGNED_BOUNDS = _record([*_INTERVAL, ("side", "i1"), *_END])
FIELD = _record([*_INTERVAL, ("side", "i1"), ("gradient", "f4", 3)])
SOLID = _record([*_INTERVAL, ("points", "f4", (2, 3)), ("triangle", "i8"), *_END])
PAIR = _record([*_INTERVAL, ("points", "f4", (2, 3)), ("triangles", "i8", 2), *_END])
MOVED = _record(
    [
        *[("verdict", "u1"), ("clear_until", "f4")],
        *[("points", "f4", (2, 3)), ("triangles", "i8", 2), *_END],
    ]
)
WITHIN_OF = _record([("verdict", "u1"), ("triangles", "i8", 2), *_END])
OVERLAP = _record([("triangles", "i8", 2), ("is_certain", "?")])
PENETRATION = _record(
    [("relation", "u1"), *_INTERVAL, ("apart", "f4", 3), ("deepest", "f4", 3), *_END]
)
TRIBOX = _record([("lower", "f4"), ("tribox", "i8"), *_END])
TRIBOX_HIT = _record([("verdict", "u1"), ("t_lower", "f4"), ("tribox", "i8"), *_END])
TRIBOX_PAIR = _record([("verdict", "u1"), ("triboxes", "i8", 2), *_END])
CANDIDATE = _record([("triboxes", "i8", 2)])
FACING = _record([("triangle", "i8")])

DIRECTIONS = np.array(
    [
        *[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        *[[1, 1, 0], [1, -1, 0], [0, 1, 1], [0, 1, -1], [1, 0, 1], [-1, 0, 1]],
    ],
    np.float32,
)


class Verdict(IntEnum):
    """The answer to a question whose wrong `NO` would be a collision.

    `NO` alone is falsy: `if not verdict` is true only where it is proved that nothing is there.
    """

    NO = 0
    """Proved: nothing is there. Clear."""
    YES = 1
    """Proved: something is there."""
    UNDECIDED = 2
    """Neither is proved. To avoid collisions, treat it as `YES`."""


class Side(IntEnum):
    """The side of a point."""

    INSIDE = -1
    UNDECIDED = 0
    OUTSIDE = 1


class Relation(IntEnum):
    """How two solids lie to each other. All but `UNDECIDED` are proved; `APART` alone is falsy."""

    APART = 0
    """No point is inside both."""
    OVERLAP = 1
    """The surfaces meet, or points are inside both."""
    FIRST_INSIDE = 2
    """The surfaces do not meet, and a component of the first lies inside the second."""
    SECOND_INSIDE = 3
    """The surfaces do not meet, and a component of the second lies inside the first."""
    UNDECIDED = 4


class Ended(IntEnum):
    """Why a search ended. Intervals hold with every reason."""

    EXACT = 0
    """The search is complete."""
    TOLERANCE = 1
    """The tolerance was met."""
    STEPS = 2
    """The steps were used up."""
    SCRATCH = 3
    """The scratch memory was too short. It does not happen here."""
    RESOLUTION = 4
    """The stored precision leaves the answer undecided."""


class Facing(IntEnum):
    """Which triangles a segment may hit."""

    BOTH = 0
    FRONT = 1
    """Those whose corners run counter-clockwise as seen from the start."""
    BACK = 2


def ask(
    question: Callable[..., Any], dtype: np.dtype[Any], rows: NDArray[np.float32], *how: Any
) -> Records:
    """The records of a question's answers to rows. Fields are attributes too."""
    return cast(Records, question((rows, dtype.itemsize), *how).view(dtype).view(np.recarray))


def ask_lists(
    question: Callable[..., Any], dtype: np.dtype[Any], rows: NDArray[np.float32], *how: Any
) -> tuple[NDArray[np.uint64], Records, NDArray[np.bool_]]:
    """Where the records of each row begin, all records, and of each row whether none is missing."""
    begins, raw, is_complete = question((rows, dtype.itemsize), *how)
    return begins, raw.view(dtype).view(np.recarray), is_complete


class Lists:
    """Answers to n rows that have any number of records each: `lists[3]` has those of row 3.

    All records at once spare the time of making n arrays: those of row 3 are
    `lists.records[lists.begins[3]:lists.begins[4]]`, and `np.diff(lists.begins)` counts them.
    """

    begins: NDArray[np.uint64]
    """Shape (n + 1,): where the records of each row begin, and the number of all."""
    records: Records
    """Those of all rows, one row behind the other."""

    def __init__(self, begins: NDArray[np.uint64], records: Records) -> None:
        self.begins, self.records = begins, records

    def __len__(self) -> int:
        return len(self.begins) - 1

    @overload
    def __getitem__(self, row: SupportsIndex) -> Records: ...
    @overload
    def __getitem__(self, row: slice) -> list[Records]: ...
    def __getitem__(self, row: SupportsIndex | slice) -> Records | list[Records]:
        if isinstance(row, slice):
            return [self[one] for one in range(*row.indices(len(self)))]
        at = range(len(self))[row]
        return cast(Records, self.records[self.begins[at] : self.begins[at + 1]])

    def __iter__(self) -> Iterator[Records]:
        return (self[row] for row in range(len(self)))

    def __repr__(self) -> str:
        return f"<meshsweep.Lists of {len(self)} rows: {len(self.records)} records>"
