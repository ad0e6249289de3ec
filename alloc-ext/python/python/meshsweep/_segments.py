"""Questions about segments and rays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _records
from ._arrays import facing as facing_of
from ._arrays import framed, pairs, whole
from ._meshsweep import QueryError
from ._opened import OpenBlob
from ._records import Facing, Lists, Records, ask, ask_lists
from ._rounding import moved_pairs


class AllHits(NamedTuple):
    """The triangles that each of n segments or rays meets."""

    hits: Lists
    """Records of each segment or ray, in order of the parameter."""
    is_complete: NDArray[np.bool_]
    """Shape (n,): whether it is proved that no other triangle is hit."""


class Segments(OpenBlob):
    """Questions about segments and rays."""

    def first_hit(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        facing: Facing | int = Facing.BOTH,
        steps: int | None = None,
        frame: ArrayLike | None = None,
    ) -> Records:
        """The first point of each segment that lies on the surface.

        Fields: `verdict`: `NO` where it is proved that the segment is clear, `UNDECIDED` where it
        touches or the steps ended; `t_lower`, `t_upper`, which contain the parameter of the first
        common point, 0 at the start and 1 at the end, infinite if there is none; `point`, NaN
        without a hit; `triangle`, or -1; `ended`; `work`.

        Segments are rounded to single precision. A `NO` is proved for the segment as it was given:
        where only the rounded one is clear, by less than the rounding, it is `UNDECIDED`. There
        all facings count, so with `facing` a segment that was moved is `UNDECIDED` where it passes
        the other side of a triangle. All else, a `YES` too, is about the rounded segment: give
        float32 to see no rounding.

        Needs "segment"; without it the hull hierarchy answers, with both facings alone, and names
        no triangle if it was cut. The hierarchy proves a `NO` of a segment that was moved by up to
        64 balls along it, which cost up to 33 times as much as the rounded segment. A long segment
        beside the surface, which takes more balls, stays `UNDECIDED`.

        With `frame` the surface is that of a key frame or between two: one number for all segments,
        or one for each. Between two no hit is proved. It has both facings, and needs "deform".
        """
        if frame is not None:
            rows = self._segments_at(starts, ends, facing, frame)
            return ask(self._model.first_hit_at, _records.FIRST_HIT, rows, whole(steps, "steps"))
        return self._first_hit(starts, ends, False, facing, steps)

    def _segments_at(
        self, starts: ArrayLike, ends: ArrayLike, facing: Facing | int, frame: ArrayLike
    ) -> NDArray[np.float32]:
        """Rows of a segment, how far rounding moved its ends, and its frame."""
        if facing_of(facing) != Facing.BOTH:
            raise QueryError("facing: it takes no frame")
        return np.hstack(framed(moved_pairs(starts, ends), "segments", frame))

    def first_hit_of_ray(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        facing: Facing | int = Facing.BOTH,
        steps: int | None = None,
    ) -> Records:
        """The same of rays without an end. The parameter counts lengths of the direction.

        Origins and directions are rounded. A `NO` is proved for the ray as it was given. Far from
        the model, as ten thousand of its diagonals, a box tree proves it only of a ray that misses
        the model's box. There other rays are `UNDECIDED`, unless they are float32.
        """
        return self._first_hit(origins, directions, True, facing, steps)

    def _first_hit(
        self, a: ArrayLike, b: ArrayLike, is_ray: bool, facing: Facing | int, steps: int | None
    ) -> Records:
        how = is_ray, facing_of(facing), whole(steps, "steps")
        return ask(self._model.first_hit, _records.FIRST_HIT, moved_pairs(a, b), *how)

    def all_hits(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        facing: Facing | int = Facing.BOTH,
        frame: ArrayLike | None = None,
    ) -> AllHits:
        """All triangles that each segment meets, first ones first.

        Fields: `verdict`, `YES` or `UNDECIDED`; `t`; `point`; `triangle`. No other triangle is hit
        where `is_complete`. Elsewhere the segment passes so near to a triangle that what is stored
        does not tell whether it hits: such a triangle may be missing. So an empty list is clear
        only where `is_complete`; `first_hit` tells by its verdict.

        Segments are rounded to single precision, and the lists, with what is said of them, are
        about the rounded ones. Give float32 to see no rounding.

        Needs the words of `first_hit`, and takes its `frame`.
        """
        if frame is not None:
            rows = self._segments_at(starts, ends, facing, frame)
            return _listed(self._model.all_hits_at, rows)
        return self._all_hits(starts, ends, False, facing)

    def all_hits_of_ray(
        self, origins: ArrayLike, directions: ArrayLike, *, facing: Facing | int = Facing.BOTH
    ) -> AllHits:
        """The same of rays without an end, which are rounded. The parameter counts lengths of the
        direction."""
        return self._all_hits(origins, directions, True, facing)

    def _all_hits(self, a: ArrayLike, b: ArrayLike, is_ray: bool, facing: Facing | int) -> AllHits:
        return _listed(self._model.all_hits, pairs(a, b), is_ray, facing_of(facing))


def _listed(question: Callable[..., Any], rows: NDArray[np.float32], *how: Any) -> AllHits:
    begins, found, is_complete = ask_lists(question, _records.ALL_HITS, rows, *how)
    return AllHits(Lists(begins, found), is_complete)
