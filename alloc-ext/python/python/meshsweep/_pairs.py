"""Questions about two models, the second at many poses or on its way between two."""

from __future__ import annotations

from typing import SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _records
from ._arrays import checked, framed, limits, yes_or_no
from ._arrays import poses as poses_of
from ._meshsweep import QueryError
from ._opened import OpenBlob, other_of
from ._records import Lists, Records, ask, ask_lists
from ._rounding import least, verdict_at_unrounded_distance


class Pairs(OpenBlob):
    """Questions about two models."""

    def distance_to(
        self,
        other: OpenBlob,
        poses: ArrayLike | None = None,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
    ) -> Records:
        """The distance of this surface from that of another model, at poses of the other.

        `poses`: shape (n, 4, 4) or (n, 3, 4), rigid, from the other's frame to this one's; one as
        built if there are none. Both need "segment" among the words of `for_`. Poses are rounded to
        single precision, and the answer is about the rounded one: far from the origin, and far out
        on a large model, that moves it by some 1e-7 of these lengths. Add that to distances to
        keep, or give float32 to see no rounding.

        Fields: `lower` and `upper`; `points`, one of each surface in this frame; `triangles`;
        `ended`; `work`.
        """
        how = other_of(other), checked(rel, "rel"), checked(abs, "abs")
        return ask(self._model.distance_to, _records.PAIR, poses_of(poses), *how)

    def within_of(
        self, other: OpenBlob, distance: SupportsFloat, poses: ArrayLike | None = None
    ) -> Records:
        """Whether both surfaces are at most `distance` apart, at poses of the other. Both need
        "segment".

        Fields: `verdict`; `triangles`, the witnesses of a `YES`, or -1; `ended`; `work`. Poses are
        rounded, as those of `distance_to`; the distance is not.
        """
        second, matrices = other_of(other), poses_of(poses)

        def question(limits: NDArray[np.float32]) -> Records:
            return ask(
                self._model.within_of, _records.WITHIN_OF, matrices, second, float(limits[0])
            )

        return verdict_at_unrounded_distance(question, checked(distance), np.zeros(1))

    def overlap(
        self,
        other: OpenBlob,
        poses: ArrayLike | None = None,
        *,
        frame: ArrayLike | None = None,
    ) -> Records:
        """Whether both surfaces meet, at poses of the other. Fields: those of `within_of`. Poses
        are rounded, as those of `distance_to`.

        The box trees of "segment" answer. Where one has no "segment", and both have a hull
        hierarchy, the hierarchies answer: `NO` or undecided, without triangles, if one of them was
        cut.

        With `frame` this surface is that of a key frame or between two: one number for all poses,
        or one for each. This model needs "deform", the other one, at rest, a hull hierarchy.
        """
        matrices, second = poses_of(poses), other_of(other)
        if frame is not None:
            rows = np.hstack(framed(matrices, "poses", frame))
            return ask(self._model.overlap_at, _records.WITHIN_OF, rows, second)
        return ask(self._model.overlap, _records.WITHIN_OF, matrices, second)

    def all_overlaps(self, other: OpenBlob, poses: ArrayLike | None = None) -> Lists:
        """All pairs of triangles that meet or may meet, at poses of the other: `Lists` of n
        records. Poses are rounded, as those of `distance_to`.

        Fields: `triangles`, one of each model; `is_certain`: whether it is proved that they meet.
        Lists are complete, always: no other pair meets. Both need "segment"; without it hull
        hierarchies answer as for `overlap`, if none was cut.
        """
        second, question = other_of(other), self._model.all_overlaps
        begins, found, _ = ask_lists(question, _records.OVERLAP, poses_of(poses), second)
        return Lists(begins, found)

    def penetration(
        self,
        other: OpenBlob,
        poses: ArrayLike | None = None,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
    ) -> Records:
        """How two solids lie to each other, and how deep they are in each other, at poses of the
        other, which are rounded. Both need "closest,segment,winding", and closed meshes.

        Fields: `relation` (a `Relation`); `lower` and `upper` of the penetration depth, which is
        the length of the shortest translation after which no point is inside both; `apart`, a
        translation of the other, in place of that of the pose, at which they are proved to be
        apart: at most `upper` away, NaN if none was found; `deepest`, the point that proves
        `lower`, or NaN; `ended`; `work`. Searches may miss the best, and the interval holds all
        the same.
        Solids that only touch, and meshes that are not closed, are `UNDECIDED`.
        """
        how = other_of(other), limits(rel, abs, steps)
        return ask(self._model.penetration, _records.PENETRATION, poses_of(poses), *how)

    def first_contact_of(
        self,
        other: OpenBlob,
        from_poses: ArrayLike,
        to_poses: ArrayLike,
        *,
        clearance: SupportsFloat = 0.0,
        straight: bool = False,
    ) -> Records:
        """How far another model may move before it is within `clearance` of this surface.

        Poses as those of `distance_to`, rounded too, one of each for a move. The way from one to
        the other is a screw, on which the model stays rigid; with `straight` each point goes along
        a straight line, so a turning model shrinks midway. Both need "segment".

        Fields: `verdict`: `NO` where it is proved that the surfaces are farther apart than
        `clearance` during the whole move, else `UNDECIDED`; `clear_until`, the fraction of the
        move, 0 to 1, before which they are, infinite if they always are; `points`, of each surface,
        in this frame, and their `triangles`, which may stop the move; `ended`; `work`.
        """
        begins, ends = poses_of(from_poses), poses_of(to_poses)
        if len(begins) != len(ends):
            raise QueryError(f"{len(begins)} poses to begin at, {len(ends)} to end at")
        is_straight = yes_or_no(straight, "straight")
        how = other_of(other), is_straight, least(checked(clearance, "clearance"))
        return ask(self._model.first_contact_of, _records.MOVED, np.hstack([begins, ends]), *how)
