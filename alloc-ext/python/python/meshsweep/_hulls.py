"""The geometry of hulls."""

from __future__ import annotations

from typing import NamedTuple, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import checked, numbers, single
from ._meshsweep import QueryError
from ._opened import OpenBlob


class TightHull(NamedTuple):
    """A hull that encloses the mesh, by exact predicates on these coordinates."""

    vertices: NDArray[np.float32]
    """Shape (v, 3)."""
    triangles: NDArray[np.uint32]
    """Shape (t, 3)."""
    slack: float
    """No point of the hull is farther from the mesh. Includes the surface error."""


class RefinedHull(NamedTuple):
    """A hull that is fine where it was asked for, and encloses the mesh."""

    vertices: NDArray[np.float32]
    """Shape (v, 3)."""
    triangles: NDArray[np.uint32]
    """Shape (t, 3)."""
    error_left: float
    """0 if every face is as near as asked for. Else the largest error that is left in a
    hull of two million faces, which are the most."""


class Hulls(OpenBlob):
    """The geometry of hulls."""

    def tight_hulls(self) -> list[TightHull]:
        """Hulls of few faces that enclose the mesh, coarse to fine. Needs "tight"."""
        return [TightHull(*arrays, slack) for arrays, slack in self._model.tight_hulls()]

    def hull_levels(self) -> list[tuple[NDArray[np.float32], NDArray[np.uint32]]]:
        """Nested hulls that enclose the mesh, coarse to fine: vertices, triangles. Needs "hull"."""
        return [self._model.hull_level(level) for level in range(self._model.hull_levels())]

    def refine(
        self,
        error: SupportsFloat,
        *,
        near: ArrayLike | None = None,
        box: ArrayLike | None = None,
        segment: ArrayLike | None = None,
        within: SupportsFloat = 0.0,
    ) -> RefinedHull:
        """A hull out of the hierarchy that is fine in one place and coarse elsewhere.

        The place: a point `near` of shape (3,), or a `segment` of shape (2, 3), and what is
        `within` that length of it; or a `box` of two corners, shape (2, 3); without any,
        everywhere. There each face is a triangle of the mesh, or the part of the mesh that it
        stands for is at most `error` away from it. A face that stands for none has no bound.

        The hull is closed and encloses the mesh. Lengths are in the mesh's unit, and numbers are
        rounded to single precision. A negative number or one that is not finite is refused. Needs
        "hull". Runs without the interpreter's lock. Ctrl-C takes effect when it is done.
        """
        places = {"near": near, "box": box, "segment": segment}
        given = [(name, place) for name, place in places.items() if place is not None]
        if len(given) > 1:
            raise QueryError(f"{given[0][0]} and {given[1][0]}: one place is wanted")
        radius = checked(within, "within")
        if radius and (not given or given[0][0] == "box"):
            raise QueryError("within: it takes near or segment")
        name, corners = "", np.zeros((0, 3), np.float32)
        for name, place in given:
            shape = (3,) if name == "near" else (2, 3)
            corners = numbers(place, name)
            if corners.shape != shape:
                raise QueryError(f"{name}: shape {shape} is wanted, not {corners.shape}")
        focus = (name, single(corners).reshape(-1, 3).tolist(), radius)
        (vertices, triangles), left = self._model.refine(checked(error, "error"), focus)
        return RefinedHull(vertices, triangles, left)
