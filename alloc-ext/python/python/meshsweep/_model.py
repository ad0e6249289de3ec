"""A model: an opened blob with all questions."""

from __future__ import annotations

import os

from ._hulls import Hulls
from ._pairs import Pairs
from ._points import Points
from ._segments import Segments
from ._solids import Solids
from ._triboxes import TriboxQuestions


class Model(Points, Segments, Solids, Pairs, TriboxQuestions, Hulls):
    """An opened blob, which answers questions. Safe to share between threads, and to pickle."""


def load(file: str | os.PathLike[str]) -> Model:
    """The model of a blob in a file. Every byte is checked: raises `BlobError`."""
    with open(file, "rb") as opened:
        return Model(opened.read())
