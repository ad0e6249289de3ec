"""A model: an opened blob with all questions."""

from __future__ import annotations

import os

from ._arrays import whole
from ._hulls import Hulls
from ._meshsweep import BuildError
from ._pairs import Pairs
from ._points import Points
from ._segments import Segments
from ._solids import Solids
from ._triboxes import TriboxQuestions
from ._views import Views


class Model(Points, Segments, Solids, Pairs, TriboxQuestions, Views, Hulls):
    """An opened blob, which answers questions. Safe to share between threads, and to pickle, with
    its report. Models of the same bytes are equal."""

    def cut(
        self,
        *,
        level: int | None = None,
        triboxes: int | None = None,
        tight: int | None = None,
    ) -> Model:
        """A coarser model of fewer bytes, for firmware: `meshsweep cut`. It has an empty report.

        `level` is the finest level of the hull hierarchy to keep, 0 the coarsest; key frames are
        left out then, and so is the box tree. Of `triboxes` the finest level of at most so many
        stays, of `tight` hulls those of at most so many faces; of both at least the coarsest. What
        has no number stays as it is. Raises `BuildError` if there is nothing of the kind, or no
        such level.
        """
        limits = {"level": level, "triboxes": triboxes, "tight": tight}
        return Model(self._model.cut(*(whole(n, name, BuildError) for name, n in limits.items())))


def load(file: str | os.PathLike[str]) -> Model:
    """The model of a blob in a file. Every byte is checked: raises `BlobError`."""
    with open(file, "rb") as opened:
        return Model(opened.read())
