"""The geometry of hulls."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._opened import Opened


class TightHull(NamedTuple):
    """A hull that encloses the mesh, by exact predicates on these coordinates."""

    vertices: NDArray[np.float32]
    """Shape (v, 3)."""
    triangles: NDArray[np.uint32]
    """Shape (t, 3)."""
    slack: float
    """No point of the hull is farther from the mesh."""


class Hulls(Opened):
    """The geometry of hulls."""

    def tight_hulls(self) -> list[TightHull]:
        """Hulls of few faces that enclose the mesh, coarse to fine. Needs "tight"."""
        return [TightHull(*arrays, slack) for arrays, slack in self._model.tight_hulls()]

    def hull_levels(self) -> list[tuple[NDArray[np.float32], NDArray[np.uint32]]]:
        """Nested hulls that enclose the mesh, coarse to fine: vertices, triangles. Needs "hull"."""
        return [self._model.hull_level(level) for level in range(self._model.hull_levels())]
