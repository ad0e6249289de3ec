"""Geometric questions about triangle meshes, answered by intervals that contain the truth.

>>> import meshsweep
>>> part = meshsweep.build("part.stl")
>>> near = part.closest_point([[10, 4.5, 7], [-1, 2, 3]])
>>> near.lower, near.upper, near.point, near.triangle
>>> part.save("part.msw")

Lengths are in the mesh's unit. Questions take rows of an array of shape (n, 3) and give records of
shape (n,), whose fields are attributes: `near.lower` is `near["lower"]`. Fields are aligned, and
copies have any bytes between them: compare records by `==`. For curves in the plane z = 0 questions
take shape (n, 2) too. Questions run on all cores and without the interpreter's lock. Ctrl-C ends
every question except `refine`. Do not write to an array while a question about it runs. For float32
input the bits of all fields except `work` are those that firmware computes.

**Fields of a search.** `work` counts its operations: bounds that were tested, triangles that were
tested or measured, nodes that were opened. It measures cost without a clock. `ended`, an `Ended`,
says why the search ended. The option `steps` is the most nodes that each search may open; `None`
is no limit. Rows in double precision have more than one search. After so many steps an interval is
wider, and holds; a verdict is `UNDECIDED`.

**Which structure answers.** `closest_point` asks the box tree of "closest", else the curves, else
the hull hierarchy, else the finest tight hull; so does `within`. `first_hit`, `all_hits`, `overlap`
and `all_overlaps` ask the box tree of "segment", else the hull hierarchy. Where the structure knows
no triangle of the input, `triangle` is -1. Each docstring names the words of `for_` that a question
needs. A blob without them raises `NotServedError`, which names the word to add.

**Rounding.** Questions are computed from points in single precision. Points in double precision are
rounded first, and intervals of distances, sides and verdicts about one distance are widened by
that, so that they hold for the points as given. So are answers about solids, by the rounding of
their corners. The side by a winding number may change by any motion, so `signed_distance` does not
use it for points that were moved, and `winding_number` tells their sides of a closed mesh alone,
away from it. Segments and rays are rounded, and a `NO` of `first_hit` and of its kin is proved for
the one as given; all else is about the rounded one. Poses are rounded, and the answer is about the
rounded one. Give float32 to see no rounding.

**Key frames.** The model of a mesh that deforms, `build(..., "deform", frames=[...])`, is asked
with `frame`: 1.25 is a quarter of the way from frame 1 to frame 2, and 0 is the mesh at rest.
Between two frames each vertex moves on a straight line. Frames are rounded to single precision, and
the answer is about the rounded one.

**Processes.** A model can be pickled. The child of a fork has threads of its own.
"""

from ._build import build
from ._hausdorff import Hausdorff, hausdorff
from ._hulls import RefinedHull, TightHull
from ._meshsweep import BlobError, BuildError, MeshsweepError, NotServedError, QueryError
from ._model import Model, load
from ._opened import Note
from ._records import Ended, Facing, Lists, Relation, Side, Verdict
from ._segments import AllHits
from ._trade import Choice, Instructions, Trade, TradeRow, choose, trade
from ._triboxes import Triboxes
from ._verify import Finding, Proof, verify

__version__ = "0.1.0"

__all__ = [
    "AllHits",
    "BlobError",
    "BuildError",
    "Choice",
    "Ended",
    "Facing",
    "Finding",
    "Hausdorff",
    "Instructions",
    "Lists",
    "MeshsweepError",
    "Model",
    "NotServedError",
    "Note",
    "Proof",
    "QueryError",
    "RefinedHull",
    "Relation",
    "Side",
    "TightHull",
    "Trade",
    "TradeRow",
    "Triboxes",
    "Verdict",
    "build",
    "choose",
    "hausdorff",
    "load",
    "trade",
    "verify",
]
