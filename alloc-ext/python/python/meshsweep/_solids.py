"""Questions about convex solids, at rest and on their way."""

from __future__ import annotations

from typing import SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _records
from ._arrays import checked, distances, limits, rows, solids, whole, yes_or_no
from ._meshsweep import QueryError
from ._opened import OpenBlob
from ._records import Records, ask
from ._rounding import moved_pairs, rounded, up, verdict_at_unrounded_distance, widened


def _placed(corners: ArrayLike, what: str) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Rows of corners in single precision, and bounds of how far a corner of each was moved."""
    near, moved = rounded(solids(corners, what))
    flat = near.reshape(len(near), 3 * near.shape[1])
    return flat, np.zeros(len(near), np.float32) if moved is None else moved.max(axis=1)


class Solids(OpenBlob):
    """Questions about convex solids.

    A solid is all points within a radius of the hull of its 1 to 32 corners: one corner is a ball,
    two are a capsule, eight a box. Only the surface of the mesh counts: a solid inside may be
    clear. All need "segment" among the words of `for_`, and `field_first` also "sdf". Corners are
    rounded to single precision, and the answers include that.
    """

    def solid_distance(
        self,
        corners: ArrayLike,
        *,
        radius: SupportsFloat = 0.0,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
    ) -> Records:
        """The distance of each solid from the surface. Needs "segment".

        `corners`: shape (n, k, 3), in the mesh's frame: those of a robot's link at n poses are
        `corners @ poses[:, :3, :3].swapaxes(1, 2) + poses[:, None, :3, 3]`.

        Fields: `lower` and `upper`, which is 0 if it is proved that they meet; `points`, of the
        hull of the corners, and of the surface; `triangle`; `ended`; `work`.
        """
        near, moved = _placed(corners, "corners")
        size = checked(radius, "radius")
        how = float(np.float32(size)), limits(rel, abs, steps)
        slack = _slack(moved, size).astype(np.float32)
        slack = np.where(slack > 0, np.nextafter(slack, np.float32(np.inf)), slack)
        return widened(ask(self._model.solid_distance, _records.SOLID, near, *how), slack)

    def solid_within(
        self,
        corners: ArrayLike,
        distance: ArrayLike,
        *,
        radius: SupportsFloat = 0.0,
        steps: int | None = None,
        field_first: bool = False,
    ) -> Records:
        """Whether the surface is at most `distance` from each solid: one number, or shape (n,); 0
        asks whether they meet.

        `corners` as those of `solid_distance`. Fields: `verdict`; `triangle`, the witness of a
        `YES`, or -1; `ended`; `work`, as that of `within`. A flat solid without radius that passes
        through the surface is `UNDECIDED`. With `field_first` the distance field decides about
        balls and capsules where it can; a `YES` of the field has no witness. Needs "segment";
        `field_first` also needs "sdf".
        """
        near, moved = _placed(corners, "corners")
        size = checked(radius, "radius")
        is_first = yes_or_no(field_first, "field_first")
        how = float(np.float32(size)), whole(steps, "steps"), is_first

        def question(limits: NDArray[np.float32]) -> Records:
            limits = np.broadcast_to(limits[:, None], (len(near), 1))
            question = self._model.solid_within
            return ask(question, _records.WITHIN, np.hstack([near, limits]), *how)

        return verdict_at_unrounded_distance(
            question, distances(distance, len(near)), _slack(moved, size)
        )

    def solid_first_contact(
        self,
        from_corners: ArrayLike,
        to_corners: ArrayLike,
        *,
        radius: SupportsFloat = 0.0,
        steps: int | None = None,
        field_first: bool = False,
    ) -> Records:
        """Where each solid first meets the surface on its way: each corner goes straight from its
        place at the start to that at the end. Needs "segment".

        Corners as those of `solid_distance`, equally many at both ends. Corners move on straight
        lines, so a turning solid shrinks midway. Split a large turn into small ones. Fields: those
        of `first_contact`. With `field_first` the distance field proves ways clear where it can.
        `field_first` also needs "sdf".
        """
        begins, moved = _placed(from_corners, "from_corners")
        ends, moved_there = _placed(to_corners, "to_corners")
        if begins.shape != ends.shape:
            shapes = [(len(flat), flat.shape[1] // 3) for flat in (begins, ends)]
            raise QueryError(f"solids and their corners at the start, at the end: {shapes}")
        moved = np.maximum(moved, moved_there)
        moves = np.hstack([begins, ends, moved[:, None]])
        is_first = yes_or_no(field_first, "field_first")
        how = checked(radius, "radius"), whole(steps, "steps"), is_first
        return ask(self._model.solid_first_contact, _records.FIRST_HIT, moves, *how)

    def first_contact(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        radius: SupportsFloat = 0.0,
        tool: ArrayLike = (0.0, 0.0, 0.0),
        steps: int | None = None,
    ) -> Records:
        """Where a convex tool that is carried straight from each start to its end first meets the
        surface. Needs "segment".

        The tool is all points within `radius` of the hull of its 1 to 32 corners, shape (k, 3),
        relative to start and end: one corner is a ball, two are a capsule. To keep a distance, add
        it to the radius.

        Fields: those of `first_hit`. `NO` where it is proved that no point of the tool touches the
        mesh at any instant, `YES` where it certainly meets the mesh by `t_upper`; before `t_lower`
        it is clear. `point` is of the triangle that may stop it. Only the surface counts. Starts,
        ends and corners are rounded to single precision. Their rounding, that of their sums, and
        of the radius, is in the answer: a tool without radius may stay `UNDECIDED` where it hits.
        """
        corners, moved = rounded(rows(tool, "tool"))
        if not 1 <= len(corners) <= 32:
            raise QueryError(f"tool: 1 to 32 corners are wanted, not {len(corners)}")
        how = corners, checked(radius, "radius"), whole(steps, "steps")
        ways = moved_pairs(starts, ends)
        slack = ways[:, 6:].max(axis=1).astype(np.float64)
        if moved is not None:
            slack += moved.max()
        ways = np.column_stack([ways[:, :6], np.where(slack > 0, up(slack), slack)])
        return ask(self._model.first_contact, _records.FIRST_HIT, ways.astype(np.float32), *how)


def _slack(moved: NDArray[np.float32], radius: float) -> NDArray[np.float64]:
    """How far rounding moved the surface of each solid, at most."""
    off = abs(radius - float(np.float32(radius)))
    return np.add(moved, off, dtype=np.float64)
