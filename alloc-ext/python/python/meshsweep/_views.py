"""Which triangles may be seen."""

from __future__ import annotations

from numpy.typing import ArrayLike

from . import _records
from ._arrays import rows, single
from ._opened import OpenBlob
from ._records import Lists, ask_lists


class Views(OpenBlob):
    """Which triangles may be seen."""

    def front_facing(self, eyes: ArrayLike) -> Lists:
        """The triangles that may face each eye, a point: `Lists` of n records. Needs "cull".

        Field: `triangle`, by rising number in the input file. A triangle faces a point from which
        its corners run counter-clockwise. No other triangle faces the eye, as it is stored; of
        those that are listed some may show their back, for up to eight are listed together. Eyes
        are rounded to single precision, and the answer is about the rounded ones.
        """
        return self._front_facing(eyes, "eyes", False)

    def front_facing_along(self, directions: ArrayLike) -> Lists:
        """The same of parallel lines of sight, which run along a direction from the eye into the
        scene. Its length is any but 0, with which all are listed."""
        return self._front_facing(directions, "directions", True)

    def _front_facing(self, places: ArrayLike, what: str, is_along: bool) -> Lists:
        eyes, question = single(rows(places, what)), self._model.front_facing
        begins, found, _ = ask_lists(question, _records.FACING, eyes, is_along)
        return Lists(begins, found)
