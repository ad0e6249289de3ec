"""Questions about points: of surfaces, and of curves and fences."""

from __future__ import annotations

from typing import SupportsFloat, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _records
from ._arrays import checked, distances, framed, limits, rows, whole, yes_or_no
from ._meshsweep import QueryError
from ._opened import OpenBlob
from ._records import Lists, Records, Verdict, ask, ask_lists
from ._rounding import least, rounded, verdict_at_unrounded_distance, widened


class Points(OpenBlob):
    """Questions about points."""

    def _points(self, points: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
        return rounded(rows(points, "points", (3, 2) if self._facts["is_flat"] else (3,)))

    def _points_at(
        self, points: ArrayLike, frame: ArrayLike
    ) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
        """Rows of a point and its frame."""
        places, frames = framed(rows(points, "points"), "points", frame)
        near, moved = rounded(places)
        return np.hstack([near, frames]), moved

    def closest_point(
        self,
        points: ArrayLike,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
        precise: bool = False,
        frame: ArrayLike | None = None,
    ) -> Records:
        """The distance of each point from the surface, and a point of the surface.

        Fields: `lower` and `upper`, which contain the distance to the input mesh; `point`, of the
        surface and at most `upper` away from the rounded query, but then rounded itself to single
        precision, and of a model that was cut, of its hull; `triangle`, its number in the input
        file, or -1; `ended`; `work`. A search is shorter if a point before it in the same 16384
        rows is near, so `work` alone depends on the other rows. Curves have `polyline`, `segment`
        and `safe_motion` in place of `triangle`: the segment is the closest one of every point that
        is less than `safe_motion` away from the one given. 0 is no statement.

        A search ends once the interval is narrower than `rel` of the distance or than `abs`, or
        after so many `steps`: the interval is wider then, and holds.

        The box tree of "closest" answers, else curves, else the hull hierarchy, else the finest
        tight hull. `triangle` is -1 where the structure knows none: of tight hulls, and of a hull
        hierarchy that was cut.

        With `precise` the triangles that may be the closest are measured in double precision. The
        interval is then some rounding of single precision wide at each end, and wider by
        `surface_error`: build with `vertex_bits=32`, or that hides the gain. Give float32, or the
        interval is wider by the rounding of the points. It needs a box tree for "closest", takes
        no `rel` and no `abs`, and costs a second search.

        With `frame` the distance is that of the mesh at a key frame or between two: one number for
        all points, or one for each. Needs "deform".
        """
        how, is_precise = limits(rel, abs, steps), yes_or_no(precise, "precise")
        if frame is not None:
            if is_precise:
                raise QueryError("precise: it takes no frame")
            near, moved = self._points_at(points, frame)
            found = ask(self._model.closest_point_at, _records.CLOSEST, near, how)
            return widened(found, moved)
        if is_precise and any(how[:2]):
            raise QueryError("precise: it takes no rel and no abs, only steps")
        dtype = _records.CLOSEST_ON_CURVE if self._facts["is_curve"] else _records.CLOSEST
        near, moved = self._points(points)
        found = ask(self._model.closest_point, dtype, near, how, is_precise)
        return widened(found, moved)

    def signed_distance(self, points: ArrayLike, *, steps: int | None = None) -> Records:
        """The distance of each point, negative inside. Needs "closest", or a fence.

        trimesh and libigl differ: trimesh's `signed_distance` is positive inside.

        Fields: `lower`, `upper`, `side` (a `Side`), and those of `closest_point`. An undecided side
        has an interval with both signs. The side is by the nearest triangle of a closed mesh; where
        that is undecided, and of open meshes, by the winding number, if `for_` names "winding".

        The winding number of an open mesh passes 1/2 away from the surface. So it tells no side of
        a point that single precision does not hold: of an open mesh such points are undecided. Give
        float32 to have their sides.

        Of a fence, which is closed curves in a plane of constant z, `points` have shape (n, 2), and
        `INSIDE` says that the fence allows the point: it is in an inclusion zone, or there is none,
        and in no exclusion zone. Fields are `polyline`, `segment` and `safe_motion` in place of
        `triangle`. The distance is that of the nearest line of any zone.
        """
        question, steps = self._model.signed_distance, whole(steps, "steps")
        if self._facts["is_curve"]:
            near, moved = rounded(rows(points, "points", (2,)))
            return widened(ask(question, _records.SIGNED_OF_FENCE, near, steps, False), moved)
        near, moved = rounded(rows(points, "points"))
        found = ask(question, _records.SIGNED, near, steps, moved is not None)
        if moved is not None and "winding" in self._facts["serves"]:
            is_held = moved == 0
            if np.any(is_held):
                found[is_held] = ask(question, _records.SIGNED, near[is_held], steps, False)
        return widened(found, moved)

    def within(
        self,
        points: ArrayLike,
        distance: ArrayLike,
        *,
        steps: int | None = None,
        field_first: bool = False,
    ) -> Records:
        """Whether the surface is at most `distance` from each point: one number, or shape (n,).

        The structures of `closest_point` answer; a hull hierarchy by the interval of the closest
        point, so rows are `UNDECIDED` where the distance is within it.

        Fields: `verdict` (a `Verdict`: 0 only where it is proved that nothing is so near);
        `triangle`, the witness of a `YES`, or -1; of curves `polyline` and `segment`; `ended`;
        `work`. Deep inside a part nothing is near. If single precision does not hold the distances
        or the points, each row is asked twice, and `work` counts both.

        With `field_first` the distance field answers where it decides, and the box tree elsewhere:
        faster, but the field names no triangle with a `YES`. That needs "closest,sdf".
        """
        near, moved = self._points(points)
        dtype = _records.WITHIN_OF_CURVE if self._facts["is_curve"] else _records.WITHIN
        how = whole(steps, "steps"), yes_or_no(field_first, "field_first")

        def question(limits: NDArray[np.float32]) -> Records:
            limits = np.broadcast_to(limits[:, None], (len(near), 1))
            return ask(self._model.within, dtype, np.hstack([near, limits]), *how)

        slack = np.zeros(1) if moved is None else moved.astype(np.float64)
        return verdict_at_unrounded_distance(question, distances(distance, len(near)), slack)

    def nearest(self, points: ArrayLike, count: int, *, frame: ArrayLike | None = None) -> Records:
        """The `count` triangles nearest to each point, nearest first: shape (n, count). Needs
        "closest" or curves, with `frame` "deform".

        Fields: `lower`, `upper`, `point`, `triangle`, as those of `closest_point`; of curves
        `polyline` and `segment`. If the mesh has fewer triangles, rows have fewer records. `frame`
        is that of `closest_point`. If the system refuses the memory for all answers, `MemoryError`
        is raised.
        """
        most = whole(count, "count")
        if not most:
            raise QueryError("count: at least 1 is wanted")
        if frame is None:
            near, moved = self._points(points)
            dtype = _records.NEAREST_ON_CURVE if self._facts["is_curve"] else _records.NEAREST
            found = ask(self._model.nearest, dtype, near, most)
        else:
            near, moved = self._points_at(points, frame)
            found = ask(self._model.nearest_at, _records.NEAREST, near, most)
        width = -1 if len(near) else min(most, self._facts["elements"] or most)
        each = found.reshape(len(near), width)
        return widened(cast(Records, each), moved)

    def all_within(self, points: ArrayLike, distance: SupportsFloat) -> Lists:
        """All triangles that may be at most `distance` from each point: `Lists` of n records.

        Needs "closest" or curves.

        Fields: `lower`, `upper`, `point`, `triangle`, as those of `closest_point` (of curves
        `polyline` and `segment`), and `is_certain`: false of triangles that are perhaps a little
        farther. Lists are complete, always: no other triangle is so near. Points in double
        precision that single precision does not hold are refused.
        """
        near, moved = self._points(points)
        if moved is not None:
            raise QueryError("all_within: the points are not in single precision; round them first")
        limit = checked(distance)
        dtype = _records.ALL_WITHIN_OF_CURVE if self._facts["is_curve"] else _records.ALL_WITHIN
        begins, found, _ = ask_lists(self._model.all_within, dtype, near, least(limit))
        found.is_certain[:] = found.upper.astype(np.float64) <= limit
        return Lists(begins, found)

    def winding_number(self, points: ArrayLike) -> Records:
        """How often the mesh encloses each point. Needs "winding" among the words of `for_`.

        Fields: `lower` and `upper`, which contain the winding number of the input's triangles about
        the point as it is rounded to single precision; `side`; `ended`; `work`.

        A point that was moved has a side, and the interval holds for the point as given, where the
        mesh is closed and farther away than the rounding: that needs "closest" too. Elsewhere its
        side is undecided. Give float32 to see no rounding.
        """
        near, moved = rounded(rows(points, "points"))
        found = ask(self._model.winding_number, _records.WINDING, near)
        if moved is not None:
            is_open = moved > 0
            if self.is_closed and "closest" in self.serves:
                rows_of = np.column_stack([near, moved])
                met = ask(self._model.within, _records.WITHIN, rows_of, None, False)
                is_open &= met.verdict != Verdict.NO
            found.side[is_open] = 0
        return found

    def field_distance(self, points: ArrayLike) -> Records:
        """Bounds of the distance by the distance field: the bits that a Cortex-M computes.

        Needs "sdf" among the words of `for_`. Fields: `lower`, `upper`; `side`; `gradient`, the
        direction in which the distance rises, without a guarantee.
        """
        near, moved = rounded(rows(points, "points"))
        found = ask(self._model.field_distance, _records.FIELD, near)
        return widened(found, moved, is_signed=self.field_kind == "signed")

    def field_within(self, points: ArrayLike, distance: SupportsFloat) -> Records:
        """Whether the surface is at most `distance` from each point, by the distance field alone.

        Of a field of kind "solid" whether the solid is: a point inside is never `NO`, so a guard
        takes this kind. Of the others a point deep inside is `NO`. Undecided where the field's
        interval holds lengths on both sides of `distance`. Needs "sdf".

        Fields: `verdict`; `ended`; `work`, which is 0.
        """
        near, moved = rounded(rows(points, "points"))

        def question(limits: NDArray[np.float32]) -> Records:
            limits = np.broadcast_to(limits[:, None], (len(near), 1))
            return ask(self._model.field_within, _records.DECIDED, np.hstack([near, limits]))

        slack = np.zeros(1) if moved is None else moved.astype(np.float64)
        return verdict_at_unrounded_distance(question, checked(distance), slack)

    def distance_bounds(
        self,
        points: ArrayLike,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
    ) -> Records:
        """Bounds of the distance of each point from the surface, by the distance field first.

        Where the field's interval is narrower than `rel` of the distance or than `abs`, it is the
        answer, for the cost of a look-up. Elsewhere the box tree searches between its ends. Without
        a tolerance the box tree always searches. Needs "closest,sdf".

        Fields: `lower`, `upper`; `ended`; `work`, 0 where the field answered alone.
        """
        near, moved = rounded(rows(points, "points"))
        how = limits(rel, abs, steps)
        return widened(ask(self._model.distance_bounds, _records.BOUNDS, near, how), moved)

    def signed_bounds(
        self,
        points: ArrayLike,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
    ) -> Records:
        """The same of the signed distance, negative inside, with the `side`.

        A field of kind "signed" tells sides, one of kind "solid" that of points outside. Elsewhere
        the box tree searches the side by the nearest triangle, without a tolerance. An undecided
        side has an interval with both signs, or with 0 at an end.
        """
        near, moved = rounded(rows(points, "points"))
        how = limits(rel, abs, steps)
        return widened(ask(self._model.signed_bounds, _records.SIGNED_BOUNDS, near, how), moved)
