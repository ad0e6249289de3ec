"""Geometric questions about triangle meshes, answered by intervals that contain the truth.

>>> import meshsweep
>>> part = meshsweep.build("part.stl")
>>> near = part.closest_point([[10, 4.5, 7], [-1, 2, 3]])
>>> near.lower, near.upper, near.point, near.triangle
>>> part.save("part.msw")

Lengths are in the mesh's unit. Questions take rows of an array of shape (n, 3) and give records of
shape (n,), whose fields are attributes: `near.lower` is `near["lower"]`. Of curves in the plane
z = 0 they take shape (n, 2) too. They run on all cores and without the interpreter's lock; Ctrl-C
ends them. The bits of the answers are those that firmware computes.

**Rounding.** Questions are asked in single precision. Points in double precision are rounded first,
and intervals of distances, sides and verdicts about one distance are widened by that, so that they
hold for the points as given. The side by a winding number may change by any motion, so
`signed_distance` does not use it for points that were moved. Segments, rays and poses are rounded,
and the answer is about the rounded one: give float32 to see none.

**Processes.** A model can be pickled. The child of a fork has threads of its own.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, SupportsFloat, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _meshsweep, _records
from ._meshsweep import BlobError, BuildError, MeshsweepError, NotServedError, QueryError
from ._records import Ended, Facing, Side, Verdict, records

__version__ = "0.1.0"

__all__ = [
    "AllHits",
    "BlobError",
    "BuildError",
    "Ended",
    "Facing",
    "Finding",
    "Instructions",
    "MeshsweepError",
    "Model",
    "NotServedError",
    "Note",
    "Proof",
    "QueryError",
    "Side",
    "TightHull",
    "Trade",
    "TradeRow",
    "Triboxes",
    "Verdict",
    "build",
    "load",
    "trade",
    "verify",
]

Records = np.recarray[Any, Any]
Mesh = str | os.PathLike[str] | tuple[ArrayLike, ArrayLike] | Any
Progress = bool | Callable[[str, float], Any] | None


class Note(NamedTuple):
    """A sentence of the report of a build."""

    topic: str
    text: str


class TightHull(NamedTuple):
    """A hull that encloses the mesh, by exact predicates on these coordinates."""

    vertices: NDArray[np.float32]
    """Shape (v, 3)."""
    triangles: NDArray[np.uint32]
    """Shape (t, 3)."""
    slack: float
    """No point of the hull is farther from the mesh."""


class AllHits(NamedTuple):
    """The triangles that each of n segments or rays meets."""

    hits: list[Records]
    """A list of n records."""
    is_complete: NDArray[np.bool_]
    """Shape (n,): whether it is proved that no other triangle is hit."""


class Triboxes(NamedTuple):
    """A union of n triboxes that holds the mesh, and its inside where `is_solid`.

    A tribox holds the points p of its part for which `low[i] <= directions @ frame @ p <= high[i]`,
    in real arithmetic: a box whose twelve edges are chamfered.
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
    """No point of the union's boundary is farther from the mesh; `None`: that is not stored."""


def build(
    mesh: Mesh,
    for_: str | Iterable[str] = (),
    *,
    progress: Progress = None,
    unit: str | None = None,
    vertex_bits: int | None = None,
    base_faces: int | None = None,
    triboxes: int | None = None,
    tribox_error: float | None = None,
    orient: str | None = None,
    tight_faces: Sequence[int] | None = None,
    slack: float | None = None,
    void_percent: float | None = None,
    margin: float | None = None,
    effort: float | None = None,
    sdf_bytes: int | None = None,
    sdf_kind: str | None = None,
    sdf_margin: float | None = None,
    frames: Iterable[str | os.PathLike[str]] = (),
    closed: bool = False,
) -> Model:
    """Builds the model of a mesh: the bytes of `meshsweep build`, in memory.

    `mesh` is a file (STL, PLY, OBJ, OFF, glTF, 3MF, COLLADA; or CSV of a curve), a pair of vertices
    (v, 3) and triangles (t, 3), or an object with `vertices` and `faces`, as `trimesh.Trimesh`.
    `for_` names the questions, as "closest,segment", which is the default. The other options are
    those of `meshsweep build`, which its help explains; `None` is the default.

    `progress` is called with the name of the stage and the part of the work that is done; `True`
    shows a bar, if tqdm is installed. An exception of it, or Ctrl-C, ends the build.

    Raises `BuildError`, which names the defect and its place, if the mesh or an option is refused.
    What was repaired is in `Model.report`.
    """
    if isinstance(frames, (str, os.PathLike)):
        raise BuildError(f"frames: a list of files is wanted, as [{os.fspath(frames)!r}]")
    if isinstance(tight_faces, str) or not isinstance(tight_faces, Iterable | None):
        raise BuildError(f"tight_faces: a list of numbers is wanted, as [{tight_faces}]")
    words = for_.split(",") if isinstance(for_, str) else list(for_)
    options = {
        "for_": [word.strip() for word in words if word.strip()],
        "unit": unit,
        "vertex_bits": vertex_bits,
        "base_faces": base_faces,
        "triboxes": triboxes,
        "tribox_error": tribox_error,
        "orient": orient,
        "tight_faces": None if tight_faces is None else list(tight_faces),
        "slack": slack,
        "void_percent": void_percent,
        "margin": margin,
        "effort": effort,
        "sdf_bytes": sdf_bytes,
        "sdf_kind": sdf_kind,
        "sdf_margin": sdf_margin,
        "frames": [os.fspath(frame) for frame in frames],
        "closed": closed,
    }
    with _Bar(progress) as tell:
        return Model(_meshsweep.build(_given(mesh), options, tell))


def load(file: str | os.PathLike[str]) -> Model:
    """The model of a blob in a file. Every byte is checked: raises `BlobError`."""
    with open(file, "rb") as opened:
        return Model(opened.read())


class Finding(NamedTuple):
    """A claim of a model, and what came of its proof."""

    structure: str
    """As "box tree"."""
    outcome: str
    """ "proved", "failed", or "not proved": neither the claim nor its opposite."""
    text: str
    """What was proved; else what does not hold, with its place, or why there is no proof."""
    counts: dict[str, int]
    """What was counted on the way."""


class Proof(NamedTuple):
    """What came of the proofs of a model. Falsy if any claim is open."""

    proved: list[Finding]
    open: list[Finding]
    """Those that failed, and those without a proof."""

    def __bool__(self) -> bool:
        return bool(self.proved) and not self.open


def verify(
    model: Model,
    mesh: Mesh,
    *,
    unit: str | None = None,
    frames: Iterable[str | os.PathLike[str]] = (),
) -> Proof:
    """Proves what a model claims of the mesh, or of the curves, that it was built from.

    By code of its own: a parser, exact arithmetic and a replay that share no code with the build
    or the questions. `mesh`, `unit` and `frames` are those of `build`. The claims: the mesh is that
    of the file but for repairs; boxes, hulls and triboxes hold the mesh; stated errors are bounds.

    `if verify(model, mesh)` is true only if all is proved. Raises `BuildError` if the mesh is
    refused. Ctrl-C is seen at the end: the proofs take some times as long as the build.
    """
    if not isinstance(model, Model):
        raise QueryError(f"a Model is wanted, not {type(model).__name__}")
    files = [os.fspath(frame) for frame in frames]
    found = [
        Finding(structure, outcome, text, dict(counts))
        for structure, outcome, text, counts in _meshsweep.verify(
            model._model, _given(mesh), unit, files
        )
    ]
    proved = [finding for finding in found if finding.outcome == "proved"]
    return Proof(proved, [finding for finding in found if finding.outcome != "proved"])


class Instructions(NamedTuple):
    """Predicted instructions of a query on a processor."""

    cpu: str
    mean: float
    most: float
    """Of the costliest query that was asked."""
    at_most: float
    """The same, times the most that predictions were short of counts when they were fitted."""
    error: float
    """Largest relative error of a predicted mean when costs were fitted."""
    stack: int
    """Bytes of the processor's stack, at most."""


class TradeRow(NamedTuple):
    """A setting, what it guarantees and what it costs. Lengths are in the mesh's unit."""

    structure: str
    dials: str
    """How it is asked: "exact", or tolerances, steps, and what is kept between queries."""
    build: str
    """Options of `meshsweep build` that give it."""
    error: float | None
    """The widest interval that was found: of other queries it may be wider, and holds. `None` of
    lower bounds."""
    median_error: float | None
    undecided: int
    """Segments that stayed undecided."""
    instructions: dict[str, Instructions]
    """By the name of the processor. One without fitted costs is missing."""
    flash: int
    """Bytes of the blob."""
    scratch: int
    """Bytes of scratch, and of memory that is kept between queries."""
    nanoseconds: float
    """Of a mean query on one thread here."""
    is_best: bool
    """Whether no other row has as small an error, as few instructions and as little flash."""


class Trade(NamedTuple):
    """What each setting of each structure costs and guarantees."""

    rows: list[TradeRow]
    not_built: list[tuple[str, str]]
    """Structures that the mesh does not allow, and why."""
    needles: float
    """The part of the triangles that are fifty times as long as high: from 0.1 on the mesh takes
    more instructions than predicted, which `at_most` allows for."""


def trade(
    mesh: Mesh,
    for_: str = "closest",
    *,
    at: str | ArrayLike = "near",
    count: int = 1000,
    progress: Progress = None,
    unit: str | None = None,
) -> Trade:
    """Measures what each setting of each structure guarantees and costs: `meshsweep trade`.

    `mesh` and `unit` as of `build`. `for_` is "closest" or "segment". `at` is "near" the surface,
    "far", or a "path", of `count` points or segments; or points of shape (n, 3), segments of shape
    (n, 2, 3), which are rounded to single precision.

    Cost: a build for each structure, and each query against all triangles in double precision.
    `progress` is called as that of `build`. Its exception, and Ctrl-C, are seen at the end.
    """
    places: str | list[list[float]]
    if isinstance(at, str):
        places = at
    else:
        given = _numbers(at, "at")
        shape, wanted = ((2, 3), "(n, 2, 3)") if for_ == "segment" else ((3,), "(n, 3)")
        if given.shape[1:] != shape:
            raise QueryError(f"at: shape {wanted} is wanted, not {given.shape}")
        if not np.all(np.isfinite(_single(given))):
            raise QueryError("at: a number is not finite, or beyond single precision")
        places = _single(given).reshape(-1, 3).tolist()
    if count < 1:
        raise QueryError("count: at least 1 is wanted")
    with _Bar(progress) as tell:
        found = _meshsweep.trade(_given(mesh), for_, places, count, unit, tell)
    rows = []
    for row in found["rows"]:
        boards = [Instructions(**board) for board in row["instructions"]]
        rows.append(TradeRow(**{**row, "instructions": {board.cpu: board for board in boards}}))
    return Trade(rows, found["not_built"], found["needles"])


class Model:
    """An opened blob, which answers questions. Safe to share between threads, and to pickle."""

    def __init__(self, blob: bytes | bytearray | memoryview | _meshsweep.Model) -> None:
        """Opens the bytes of a blob. Every byte is checked: raises `BlobError`."""
        if isinstance(blob, (str, os.PathLike)):
            raise BlobError(f"bytes are wanted, not {blob!r}: use meshsweep.load for a file")
        if not isinstance(blob, (bytes, bytearray, memoryview, _meshsweep.Model)):
            raise BlobError(f"bytes are wanted, not {type(blob).__name__}")
        self._model = blob if isinstance(blob, _meshsweep.Model) else _meshsweep.Model(bytes(blob))
        self._facts = self._model.facts()

    def __bytes__(self) -> bytes:
        return self._model.bytes()

    def __reduce__(self) -> tuple[type[Model], tuple[bytes]]:
        return Model, (bytes(self),)

    def _points(self, points: ArrayLike) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
        return _points(points, (3, 2) if self._facts["is_flat"] else (3,))

    def __repr__(self) -> str:
        return f"<meshsweep.Model for {','.join(self.serves)}: {len(bytes(self))} bytes>"

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the blob: what `meshsweep build` writes, for firmware as well."""
        with open(file, "wb") as opened:
            opened.write(bytes(self))

    @property
    def report(self) -> list[Note]:
        """What the build repaired, moved and left out; empty of a model that was loaded."""
        return [Note(*note) for note in self._model.report()]

    @property
    def serves(self) -> list[str]:
        """The questions that the blob serves, in the words of `for_`."""
        return list(self._facts["serves"])

    @property
    def bounds(self) -> NDArray[np.float32]:
        """Shape (2, 3): a box that holds the input mesh, its vertices included.

        It is the box of what is stored, `surface_error` larger, and rounded outward; of a blob with a
        field alone the field's box. Raises `NotServedError` if the blob has nothing that knows it.
        """
        bounds = self._facts["bounds"]
        if bounds is None:
            raise NotServedError('the blob knows no bounds: build it with for_="closest"')
        return np.array(bounds, np.float32)

    @property
    def is_closed(self) -> bool | None:
        """Whether the mesh bounds a volume; `None` without a box tree."""
        return self._facts["is_closed"]

    @property
    def has_sides(self) -> bool | None:
        """Whether `signed_distance` tells sides; `None` without a box tree and without curves."""
        return self._facts["has_sides"]

    @property
    def surface_error(self) -> float | None:
        """No stored point of the surface is farther from the input mesh. Intervals include it."""
        return self._facts["surface_error"]

    def closest_point(
        self,
        points: ArrayLike,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
        steps: int | None = None,
    ) -> Records:
        """The distance of each point from the surface, and a point of the surface.

        Fields: `lower` and `upper`, which contain the distance to the input mesh; `point`, of the
        surface and at most `upper` away from the rounded query; `triangle`, its number in the
        input file, or -1; `ended`; `work`. Curves have `polyline`, `segment` and `safe_motion` in
        place of `triangle`: of every point that is less than `safe_motion` away from the one given,
        the segment is the closest one. 0 is no statement.

        A search ends once the interval is narrower than `rel` of the distance or than `abs`, or
        after so many `steps`: the interval is wider then, and holds.
        """
        dtype = _records.CLOSEST_ON_CURVE if self._facts["is_curve"] else _records.CLOSEST
        rows, moved = self._points(points)
        found = self._model.closest_point(rows, (float(rel), float(abs), steps), dtype.itemsize)
        return _widened(records(found, dtype), moved)

    def signed_distance(self, points: ArrayLike, *, steps: int | None = None) -> Records:
        """The distance of each point, negative inside.

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
        if self._facts["is_curve"]:
            rows, moved = _points(points, (2,))
            size = _records.SIGNED_OF_FENCE.itemsize
            raw = self._model.signed_distance_of_fence(rows, steps, size)
            return _widened(records(raw, _records.SIGNED_OF_FENCE), moved)
        rows, moved = _points(points)

        def ask(rows: NDArray[np.float32], by_nearest_alone: bool) -> Records:
            size = _records.SIGNED.itemsize
            found = self._model.signed_distance(rows, steps, by_nearest_alone, size)
            return records(found, _records.SIGNED)

        if moved is None:
            return ask(rows, False)
        found, is_held = ask(rows, True), moved == 0
        if "winding" in self._facts["serves"] and np.any(is_held):
            found[is_held] = ask(rows[is_held], False)
        return _widened(found, moved)

    def within(
        self, points: ArrayLike, distance: SupportsFloat, *, steps: int | None = None
    ) -> Records:
        """Whether the surface is at most `distance` from each point.

        Fields: `verdict` (a `Verdict`: 0 only where it is proved that nothing is so near);
        `triangle`, the witness of a `YES`, or -1; of curves `polyline` and `segment`; `ended`;
        `work`. Deep inside a part nothing is near.
        """
        rows, moved = self._points(points)
        dtype = _records.WITHIN_OF_CURVE if self._facts["is_curve"] else _records.WITHIN
        limit = _checked(distance)

        def ask(limits: NDArray[np.float32]) -> Records:
            limits = np.broadcast_to(limits[:, None], (len(rows), 1))
            found = self._model.within(np.hstack([rows, limits]), steps, dtype.itemsize)
            return records(found, dtype)

        if moved is None:
            return _asked(ask, limit, np.zeros(1))
        return _asked(ask, limit, moved.astype(np.float64))

    def nearest(self, points: ArrayLike, count: int) -> Records:
        """The `count` triangles nearest to each point, nearest first: shape (n, count).

        Fields: `lower`, `upper`, `point`, `triangle`; of curves `polyline` and `segment`. A mesh
        with fewer triangles has fewer.
        """
        rows, moved = self._points(points)
        if count < 1:
            raise QueryError("count: at least 1 is wanted")
        ask, dtype = self._model.nearest, _records.NEAREST
        if self._facts["is_curve"]:
            ask, dtype = self._model.nearest_on_curve, _records.NEAREST_ON_CURVE
        found = records(ask(rows, count, dtype.itemsize), dtype)
        each = found.reshape(len(rows), -1) if len(rows) else found.reshape(0, count)
        return _widened(cast(Records, each), moved)

    def all_within(self, points: ArrayLike, distance: SupportsFloat) -> list[Records]:
        """All triangles that may be at most `distance` from each point: a list of n records.

        Fields: `lower`, `upper`, `point`, `triangle` (of curves `polyline` and `segment`), and
        `is_certain`: false of triangles that are perhaps a little farther. Lists are complete,
        always: no other triangle is so near. Points in double precision that single precision does
        not hold are refused.
        """
        rows, moved = self._points(points)
        if moved is not None:
            raise QueryError("all_within: the points are not in single precision; round them first")
        ask, dtype, limit = self._model.all_within, _records.ALL_WITHIN, _checked(distance)
        if self._facts["is_curve"]:
            ask, dtype = self._model.all_within_on_curve, _records.ALL_WITHIN_OF_CURVE
        begins, raw, _ = ask(rows, _least(limit), dtype.itemsize)
        found = records(raw, dtype)
        found.is_certain[:] = found.upper.astype(np.float64) <= limit
        return _parts(begins, found)

    def winding_number(self, points: ArrayLike) -> Records:
        """How often the mesh encloses each point. Needs "winding" among the words of `for_`.

        Fields: `lower` and `upper`, which contain the winding number of the input's triangles;
        `side`; `ended`; `work`. The points are rounded to single precision.
        """
        rows, _ = _points(points)
        found = self._model.winding_number(rows, _records.WINDING.itemsize)
        return records(found, _records.WINDING)

    def first_hit(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        facing: Facing | int = Facing.BOTH,
        steps: int | None = None,
    ) -> Records:
        """The first point of each segment that lies on the surface.

        Fields: `verdict`: `NO` where it is proved that the segment is clear, `UNDECIDED` where it
        touches or the steps ended; `t_lower`, `t_upper`, which contain the parameter of the first
        common point, 0 at the start and 1 at the end, infinite if there is none; `point`, NaN
        without a hit; `triangle`, or -1; `ended`; `work`.
        """
        return self._first_hit(starts, ends, False, facing, steps)

    def first_hit_of_ray(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        facing: Facing | int = Facing.BOTH,
        steps: int | None = None,
    ) -> Records:
        """The same of rays without an end. The parameter counts lengths of the direction."""
        return self._first_hit(origins, directions, True, facing, steps)

    def _first_hit(
        self, a: ArrayLike, b: ArrayLike, is_ray: bool, facing: Facing | int, steps: int | None
    ) -> Records:
        size, rows = _records.FIRST_HIT.itemsize, _pairs(a, b)
        found = self._model.first_hit(rows, is_ray, _facing(facing), steps, size)
        return records(found, _records.FIRST_HIT)

    def all_hits(
        self, starts: ArrayLike, ends: ArrayLike, *, facing: Facing | int = Facing.BOTH
    ) -> AllHits:
        """All triangles that each segment meets, first ones first: lists of n records.

        Fields: `verdict`, `YES` or `UNDECIDED`; `t`; `point`; `triangle`. No other triangle is hit
        where `is_complete`. Elsewhere the segment passes so near to a triangle that what is stored
        does not tell whether it hits: such a triangle may be missing. So an empty list is clear
        only where `is_complete`; `first_hit` tells by its verdict.
        """
        return self._all_hits(starts, ends, False, facing)

    def all_hits_of_ray(
        self, origins: ArrayLike, directions: ArrayLike, *, facing: Facing | int = Facing.BOTH
    ) -> AllHits:
        """The same of rays without an end. The parameter counts lengths of the direction."""
        return self._all_hits(origins, directions, True, facing)

    def _all_hits(self, a: ArrayLike, b: ArrayLike, is_ray: bool, facing: Facing | int) -> AllHits:
        size, rows = _records.ALL_HITS.itemsize, _pairs(a, b)
        begins, found, is_complete = self._model.all_hits(rows, is_ray, _facing(facing), size)
        return AllHits(_parts(begins, records(found, _records.ALL_HITS)), is_complete)

    def distance_to(
        self,
        other: Model,
        poses: ArrayLike | None = None,
        *,
        rel: SupportsFloat = 0.0,
        abs: SupportsFloat = 0.0,
    ) -> Records:
        """The distance of this surface from that of another model, at poses of the other.

        `poses`: shape (n, 4, 4) or (n, 3, 4), rigid, from the other's frame to this one's; one as
        built if there are none. Both need "segment" among the words of `for_`.

        Fields: `lower` and `upper`; `points`, one of each surface in this frame; `triangles`;
        `ended`; `work`.
        """
        size, second, rows = _records.PAIR.itemsize, _other(other), _poses(poses)
        found = self._model.distance_to(second, rows, float(rel), float(abs), size)
        return records(found, _records.PAIR)

    def within_of(
        self, other: Model, distance: SupportsFloat, poses: ArrayLike | None = None
    ) -> Records:
        """Whether both surfaces are at most `distance` apart, at poses of the other.

        Fields: `verdict`; `triangles`, the witnesses of a `YES`, or -1; `ended`; `work`.
        """
        size, second, rows = _records.MEETS.itemsize, _other(other), _poses(poses)

        def ask(limits: NDArray[np.float32]) -> Records:
            (limit,) = limits
            found = self._model.meets(second, rows, float(limit), size)
            return records(found, _records.MEETS)

        return _asked(ask, _checked(distance), np.zeros(1))

    def overlap(self, other: Model, poses: ArrayLike | None = None) -> Records:
        """Whether both surfaces meet, at poses of the other. Fields: those of `within_of`."""
        size = _records.MEETS.itemsize
        found = self._model.meets(_other(other), _poses(poses), None, size)
        return records(found, _records.MEETS)

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
        ends and corners are rounded to single precision. The rounding of their sums, and of the
        radius, is in the answer: a tool without radius may stay `UNDECIDED` where it hits.
        """
        size, moves = _records.FIRST_HIT.itemsize, _pairs(starts, ends)
        corners = _single(_rows(tool, "tool"))
        if not 1 <= len(corners) <= 32:
            raise QueryError(f"tool: 1 to 32 corners are wanted, not {len(corners)}")
        limit = _checked(radius, "radius")
        found = self._model.first_contact(moves, corners, limit, steps, size)
        return records(found, _records.FIRST_HIT)

    def first_contact_of(
        self,
        other: Model,
        from_poses: ArrayLike,
        to_poses: ArrayLike,
        *,
        keep: SupportsFloat = 0.0,
        straight: bool = False,
    ) -> Records:
        """How far another model may move before it is within `keep` of this surface.

        Poses as those of `distance_to`, one of each for a move. The way from one to the other is a
        screw, on which the model stays rigid; with `straight` each point goes along a straight
        line, and a model that turns shrinks on the way. Both need "segment".

        Fields: `verdict`: `NO` where it is proved that the surfaces are farther apart than `keep`
        during the whole move, else `UNDECIDED`; `clear_until`, the part of the move, 0 to 1, before
        which they are, infinite if they always are; `points`, of each surface, in this frame, and
        their `triangles`, which may stop the move; `ended`; `work`.
        """
        begins, ends = _poses(from_poses), _poses(to_poses)
        if len(begins) != len(ends):
            raise QueryError(f"{len(begins)} poses to begin at, {len(ends)} to end at")
        size, limit = _records.MOVED.itemsize, _least(_checked(keep, "keep"))
        moves = np.hstack([begins, ends])
        found = self._model.first_contact_of(_other(other), moves, straight, limit, size)
        return records(found, _records.MOVED)

    def field_distance(self, points: ArrayLike) -> Records:
        """Bounds of the distance by the distance field: the bits that a Cortex-M computes.

        Needs "sdf" among the words of `for_`. Fields: `lower`, `upper`; `side`; `gradient`, the
        direction in which the distance rises, without a guarantee.
        """
        rows, moved = _points(points)
        found = self._model.field(rows, _records.FIELD.itemsize)
        return _widened(records(found, _records.FIELD), moved)

    def triboxes(self, count: int | None = None) -> Triboxes:
        """The geometry of at most `count` stored triboxes, or of all. Needs "triboxes"."""
        if count is not None and not 1 <= count < 2**32:
            raise QueryError(f"count: {count} is none from 1 to 2^32 - 1")
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
        solid; `tribox`, the node with this bound; `ended`; `work`. There is no upper bound. So
        `lower > d` proves that nothing is within d, and else nothing is known.
        """
        rows, moved = _points(points)
        found = self._model.tribox_distance(rows, steps, _records.TRIBOX.itemsize)
        return _widened(records(found, _records.TRIBOX), moved)

    def tribox_first_hit(
        self, starts: ArrayLike, ends: ArrayLike, *, steps: int | None = None
    ) -> Records:
        """How far each segment is clear, by triboxes alone. Needs "triboxes".

        Fields: `verdict`: `NO` where it is proved that the segment is clear, else `UNDECIDED`;
        `t_lower`, the parameter before which it is clear, 0 at the start and 1 at the end, infinite
        if it is clear; `tribox`, the node that it may enter there, or -1; `ended`; `work`.
        """
        size, rows = _records.TRIBOX_HIT.itemsize, _pairs(starts, ends)
        return records(self._model.tribox_hit(rows, steps, size), _records.TRIBOX_HIT)

    def tribox_within_of(
        self, other: Model, distance: SupportsFloat, poses: ArrayLike | None = None
    ) -> Records:
        """Whether both models may be at most `distance` apart, at poses of the other as those of
        `distance_to`, by triboxes alone. Both need "triboxes".

        Fields: `verdict`: `NO` where it is proved that all points of both are farther, insides of
        solid triboxes too; else `UNDECIDED`, never `YES`; `triboxes`, a node of each that may be
        nearer, or -1; `ended`; `work`.
        """
        size, limit = _records.TRIBOX_PAIR.itemsize, _least(_checked(distance))
        found = self._model.tribox_separation(_other(other), _poses(poses), limit, size)
        return records(found, _records.TRIBOX_PAIR)

    def tribox_overlap(self, other: Model, poses: ArrayLike | None = None) -> Records:
        """Whether both models may meet: `tribox_within_of` with a distance of 0. Models that only
        touch are not proved to be apart."""
        return self.tribox_within_of(other, 0.0, poses)

    def tight_hulls(self) -> list[TightHull]:
        """Hulls of few faces that enclose the mesh, coarse to fine. Needs "tight"."""
        return [TightHull(*arrays, slack) for arrays, slack in self._model.tight_hulls()]

    def hull_levels(self) -> list[tuple[NDArray[np.float32], NDArray[np.uint32]]]:
        """Nested hulls that enclose the mesh, coarse to fine: vertices, triangles. Needs "hull"."""
        return [self._model.hull_level(level) for level in range(self._model.hull_levels())]


def _given(mesh: Any) -> str | tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """The file, or vertices and triangles, of whatever `build` takes."""
    if isinstance(mesh, (str, os.PathLike)):
        return os.fspath(mesh)
    if hasattr(mesh, "to_geometry") and not hasattr(mesh, "faces"):
        raise BuildError("a scene is no mesh: give scene.to_geometry()")
    pair = (mesh.vertices, mesh.faces) if hasattr(mesh, "faces") else mesh
    try:
        vertices, faces = pair
    except (TypeError, ValueError):
        text = "a mesh is a file, a pair of vertices and triangles, or has `vertices` and `faces`"
        raise BuildError(text) from None
    vertices = _numbers(vertices, "vertices", BuildError)
    numbers = _numbers(faces, "triangles", BuildError)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise BuildError(f"vertices: shape (v, 3) is wanted, not {vertices.shape}")
    if numbers.ndim != 2 or numbers.shape[1] != 3:
        raise BuildError(f"triangles: shape (t, 3) is wanted, not {numbers.shape}")
    if not np.issubdtype(numbers.dtype, np.integer):
        raise BuildError(f"triangles: integers are wanted, not {numbers.dtype}")
    if numbers.size and (numbers.min() < 0 or numbers.max() > 0xFFFFFFFF):
        raise BuildError("triangles: a vertex number is negative or beyond 32 bits")
    vertices = np.require(vertices, np.float64, ["C", "A"])
    return vertices, np.require(numbers, np.uint32, ["C", "A"])


def _numbers(
    given: ArrayLike, what: str, refused: type[MeshsweepError] = QueryError
) -> NDArray[Any]:
    """An array of real numbers."""
    if isinstance(given, np.ma.MaskedArray):
        raise refused(f"{what}: a masked array is given; leave out what is masked")
    try:
        numbers = np.asarray(given)
    except ValueError as error:
        raise refused(f"{what}: {error}") from None
    if numbers.dtype.kind not in "fiu":
        raise refused(f"{what}: real numbers are wanted, not {numbers.dtype}")
    return numbers


def _single(numbers: NDArray[Any]) -> NDArray[np.float32]:
    """In single precision, as Rust reads it. What is too large becomes infinite."""
    with np.errstate(over="ignore"):
        return np.require(numbers, np.float32, ["C", "A"])


def _rows(given: ArrayLike, what: str, widths: tuple[int, ...] = (3,)) -> NDArray[Any]:
    """Rows of one of these widths; zeros fill them up to the first."""
    rows = _numbers(given, what)
    if rows.ndim == 1 and rows.shape[0] in widths:
        rows = rows[None, :]
    if rows.ndim != 2 or rows.shape[1] not in widths:
        wanted = " or ".join(f"(n, {width})" for width in widths)
        raise QueryError(f"{what}: shape {wanted} is wanted, not {rows.shape}")
    missing = widths[0] - rows.shape[1]
    return np.pad(rows, [(0, 0), (0, missing)]) if missing else rows


def _points(
    given: ArrayLike, widths: tuple[int, ...] = (3,)
) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
    """The points in single precision, and bounds of how far each was moved, if any was."""
    rows = _rows(given, "points", widths)
    single = _single(rows)
    if rows.dtype.kind == "f" and rows.dtype.itemsize <= 4:
        return single, None
    with np.errstate(over="ignore"):
        wide = rows.astype(np.float64)
    # These differences are exact. A number that is not finite is refused later.
    with np.errstate(invalid="ignore"):
        off = np.abs(wide - single)
    if rows.dtype.kind in "iu" or rows.dtype.itemsize > 8:
        # Other numbers were perhaps rounded to double precision before.
        is_exact = (np.abs(wide) < 2.0**53) if rows.dtype.kind in "iu" else wide == rows
        off = np.where(is_exact, off, off + np.abs(wide) * 2.0**-52)
    off[~np.isfinite(off)] = 0.0
    if not np.any(off):
        return single, None
    moved = np.nextafter(np.linalg.norm(off, axis=1).astype(np.float32), np.float32(np.inf))
    return single, np.where(np.any(off, axis=1), moved, np.float32(0))


def _widened(found: Records, moved: NDArray[np.float32] | None) -> Records:
    """Intervals of distances that hold for points before rounding."""
    if moved is None:
        return found
    slack = moved.reshape(moved.shape + (1,) * (found.ndim - 1))
    is_held = slack == 0
    names = found.dtype.names or ()
    is_unsigned = (found.lower >= 0) & (found.upper > 0) if "upper" in names else False
    lower = np.nextafter(found.lower - slack, np.float32(-np.inf))
    lower = np.where(is_held, found.lower, lower)
    if "upper" in names:
        upper = np.nextafter(found.upper + slack, np.float32(np.inf))
        upper = found.upper[:] = np.where(is_held, found.upper, upper)
    if "side" in names:
        certain = np.where(lower > 0, Side.OUTSIDE, np.where(upper < 0, Side.INSIDE, 0))
        # A field that does not tell sides keeps its distances at 0 and above.
        kept = np.where(is_held | (found.side == certain), found.side, 0)
        is_plain = (found.side == 0) & is_unsigned
        lower = np.where(is_plain, np.maximum(lower, 0), lower)
        found.side[:] = kept
    else:
        lower = np.maximum(lower, np.float32(0))
    if "safe_motion" in names:
        left = np.nextafter(found.safe_motion - slack, np.float32(-np.inf))
        left = np.where(is_held, found.safe_motion, left)
        found.safe_motion[:] = np.maximum(left, np.float32(0))
    found.lower[:] = lower
    return found


def _asked(
    ask: Callable[[NDArray[np.float32]], Records], distance: float, slack: NDArray[np.float64]
) -> Records:
    """Verdicts about `distance`, which single precision may not hold, with so much slack.

    Farther than the distance and the slack is farther; nearer than the distance less the slack is
    nearer; the rest is undecided.
    """
    if float(np.float32(distance)) == distance and not np.any(slack):
        return ask(np.array([distance], np.float32))
    found = ask(_up(distance + slack))
    near = ask(_down(np.maximum(distance - slack, 0.0)))
    is_near = (near.verdict == Verdict.YES) & (distance >= slack)
    is_open = (found.verdict == Verdict.YES) & ~is_near
    found[is_near] = near[is_near]
    found.verdict[is_open] = Verdict.UNDECIDED
    found.ended[is_open] = Ended.RESOLUTION
    for witness in {"triangle", "triangles", "polyline", "segment"} & {*(found.dtype.names or ())}:
        found[witness][is_open] = -1
    return found


def _up(values: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.nextafter(values.astype(np.float32), np.float32(np.inf))


def _down(values: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.maximum(np.nextafter(values.astype(np.float32), np.float32(-np.inf)), np.float32(0))


def _checked(distance: SupportsFloat, what: str = "distance") -> float:
    try:
        value = float(distance)
    except (TypeError, ValueError):
        raise QueryError(f"{what}: one number is wanted, not {distance!r}") from None
    if not (np.isfinite(value) and value >= 0):
        raise QueryError(f"{what}: {distance} is negative or not finite")
    if value > float(np.finfo(np.float32).max):
        raise QueryError(f"{what}: {distance} is beyond single precision")
    return value


def _least(limit: float) -> float:
    """The distance, or a little more that single precision holds."""
    single = np.float32(limit)
    return float(np.nextafter(single, np.float32(np.inf)) if float(single) < limit else single)


def _facing(facing: Facing | int) -> int:
    try:
        return int(Facing(facing))
    except ValueError:
        raise QueryError(f"facing: a meshsweep.Facing is wanted, not {facing!r}") from None


def _other(other: Model) -> _meshsweep.Model:
    if not isinstance(other, Model):
        raise QueryError(f"other: another Model is wanted, not {type(other).__name__}")
    return other._model


def _pairs(a: ArrayLike, b: ArrayLike) -> NDArray[np.float32]:
    """Rows of six: both ends, or origin and direction."""
    first, second = _rows(a, "starts"), _rows(b, "ends")
    try:
        first, second = np.broadcast_arrays(first, second)
    except ValueError:
        raise QueryError(f"{len(first)} starts for {len(second)} ends") from None
    return _single(np.hstack([first, second]))


def _poses(poses: ArrayLike | None) -> NDArray[np.float32]:
    """Rows of twelve: the upper three rows of each matrix."""
    matrices = np.eye(4) if poses is None else _numbers(poses, "poses")
    if matrices.ndim == 2:
        matrices = matrices[None]
    if matrices.ndim != 3 or matrices.shape[1:] not in [(4, 4), (3, 4)]:
        raise QueryError(f"poses: shape (n, 4, 4) or (n, 3, 4) is wanted, not {matrices.shape}")
    wrong = np.flatnonzero(np.any(matrices[:, 3:] != [0, 0, 0, 1], axis=(1, 2)))
    for row in wrong[:1]:
        last = matrices[row, 3].tolist()
        raise QueryError(f"row {row}: the last row is {last}, not 0, 0, 0, 1: transposed?")
    return _single(matrices[:, :3, :].reshape(len(matrices), 12))


def _parts(begins: NDArray[np.uint64], found: Records) -> list[Records]:
    return [cast(Records, found[begin:end]) for begin, end in itertools.pairwise(begins)]


class _Bar:
    """Progress as a bar, or as the caller wants it."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._bar: Any = None

    def __enter__(self) -> Callable[[str, float], Any] | None:
        if self._progress is not True:
            return self._progress or None
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
        except ImportError:
            return None
        self._bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}")
        return self._show

    def _show(self, stage: str, part: float) -> None:
        self._bar.set_description_str(stage, refresh=False)
        self._bar.update(part - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
