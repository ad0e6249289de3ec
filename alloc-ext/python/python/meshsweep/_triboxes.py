"""Questions to stored triboxes, which prove that something is clear and never the opposite."""

from __future__ import annotations

from typing import NamedTuple, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _records
from ._arrays import checked, rows, whole
from ._arrays import poses as poses_of
from ._meshsweep import QueryError
from ._opened import OpenBlob, other_of
from ._records import Lists, Records, ask, ask_lists
from ._rounding import least, moved_pairs, rounded, widened


class Triboxes(NamedTuple):
    """A union of n triboxes that holds the mesh, and its inside if `is_solid`.

    Tribox i is the set of points p for which `low[i] <= directions @ frame @ p <= high[i]` in all
    nine entries, in real arithmetic: a box whose twelve edges are chamfered.
    """

    node: NDArray[np.uint32]
    """Shape (n,): the numbers that answers name triboxes by."""
    low: NDArray[np.float32]
    """Shape (n, 9): least values along the directions."""
    high: NDArray[np.float32]
    """Shape (n, 9): greatest values along the directions."""
    corners: NDArray[np.float32]
    """Shape (n, 32, 3): points whose convex hull holds the tribox, in its frame. Some coincide.

    No plane of the hull is farther out than 2^-20 of the power of two above all values of its
    tribox. `corners @ frame` has them in the mesh's frame, rounded.
    """
    directions: NDArray[np.float32]
    """Shape (9, 3): the axes, and the diagonals of their planes, of length sqrt(2)."""
    frame: NDArray[np.float32]
    """Shape (3, 3): the rotation from the mesh's frame to the triboxes'."""
    is_solid: bool
    """Whether the union holds the inside of the mesh."""
    distance: float | None
    """No point of the union's boundary is farther from the mesh. `None` if that is not stored."""


class TriboxQuestions(OpenBlob):
    """Questions to triboxes, and their geometry."""

    def triboxes(self, count: int | None = None) -> Triboxes:
        """The geometry of at most `count` stored triboxes, or of all. Needs "triboxes"."""
        if whole(count, "count") == 0:
            raise QueryError("count: at least 1 is wanted")
        found = self._model.triboxes(count)
        return Triboxes(
            found["nodes"],
            found["low"].reshape(-1, 9),
            found["high"].reshape(-1, 9),
            found["corners"].reshape(-1, 32, 3),
            _records.DIRECTIONS.copy(),
            np.array(found["frame"], np.float32),
            found["is_solid"],
            found["distance"],
        )

    def tribox_distance(self, points: ArrayLike, *, steps: int | None = None) -> Records:
        """A lower bound of the distance of each point, by triboxes alone. Needs "triboxes".

        Fields: `lower`: no point of the mesh is nearer, nor one inside of it if the triboxes are
        solid; `tribox`, the node with this bound; `ended`; `work`. There is no upper bound. If
        `lower > d`, nothing is within d; else nothing is known.
        """
        near, moved = rounded(rows(points, "points"))
        found = ask(self._model.tribox_distance, _records.TRIBOX, near, whole(steps, "steps"))
        return widened(found, moved)

    def tribox_first_hit(
        self, starts: ArrayLike, ends: ArrayLike, *, steps: int | None = None
    ) -> Records:
        """How far each segment is clear, by triboxes alone. Needs "triboxes".

        Fields: `verdict`: `NO` where it is proved that the segment is clear, else `UNDECIDED`;
        `t_lower`, the parameter before which it is clear, 0 at the start and 1 at the end, infinite
        if it is clear; `tribox`, the node that it may enter there, or -1; `ended`; `work`.

        Segments are rounded to single precision. A `NO` is proved for the segment as it was given:
        of one that was moved, by up to 64 lower bounds of distances along it, which typically cost
        ten times as much, at most some forty times. `t_lower` of others is that of the rounded
        segment.
        """
        question, dtype = self._model.tribox_first_hit, _records.TRIBOX_HIT
        return ask(question, dtype, moved_pairs(starts, ends), whole(steps, "steps"))

    def tribox_within_of(
        self, other: OpenBlob, distance: SupportsFloat, poses: ArrayLike | None = None
    ) -> Records:
        """Whether both models may be at most `distance` apart, at poses of the other as those of
        `distance_to`, by triboxes alone. Both need "triboxes".

        Fields: `verdict`: `NO` where it is proved that all points of both are farther, insides of
        solid triboxes too; else `UNDECIDED`, never `YES`; `triboxes`, a node of each that may be
        nearer, or -1; `ended`; `work`. Poses are rounded to single precision, and the answer is
        about the rounded one.
        """
        how = other_of(other), least(checked(distance))
        return ask(self._model.tribox_within_of, _records.TRIBOX_PAIR, poses_of(poses), *how)

    def tribox_overlap(self, other: OpenBlob, poses: ArrayLike | None = None) -> Records:
        """Whether both models may meet: `tribox_within_of` with a distance of 0. Models that only
        touch are not proved to be apart."""
        return self.tribox_within_of(other, 0.0, poses)

    def tribox_candidates(self, other: OpenBlob, poses: ArrayLike | None = None) -> Lists:
        """All pairs of triboxes that may meet, at poses of the other: `Lists` of n records.

        Field: `triboxes`, a node of each model, as `Triboxes.node` names them. An empty list proves
        that the models are apart, insides of solid triboxes too. Both need "triboxes". Poses are
        rounded, as those of `tribox_within_of`.
        """
        second, question = other_of(other), self._model.tribox_candidates
        begins, found, _ = ask_lists(question, _records.CANDIDATE, poses_of(poses), second)
        return Lists(begins, found)
