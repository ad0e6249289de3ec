"""Fences and curves, beside every segment and angle sums in f64."""

import meshsweep
import numpy as np
import pytest
from meshsweep import Side, Verdict


def ring(rng, count, radius, centre):
    """A closed polyline that crosses itself."""
    angle = np.linspace(0, 4 * np.pi, count, endpoint=False)
    out = radius * rng.uniform(0.5, 1.5, count)
    place = np.stack([out * np.cos(angle), out * np.sin(angle)], axis=1) + centre
    return np.round(place * 256) / 256


ZONES = [
    ("inclusion", ring(np.random.default_rng(1), 21, 8.0, [0, 0])),
    ("inclusion", ring(np.random.default_rng(2), 33, 5.0, [9, 3])),
    ("exclusion", ring(np.random.default_rng(3), 15, 2.0, [2, 1])),
]


@pytest.fixture(params=["", ",0.7"])
def fence(request, tmp_path):
    """A fence in the plane z = 0, and one above it."""
    lines = ["x,y" + (",z" if request.param else "") + ",zone"]
    for zone, points in ZONES:
        lines += [f"{x},{y}{request.param},{zone}" for x, y in points.tolist()] + [""]
    (tmp_path / "fence.csv").write_text("\n".join(lines))
    return meshsweep.build(tmp_path / "fence.csv", closed=True), not request.param


def segments_of_zones():
    """Ends of all segments, and polyline and segment of each."""
    ends = [(points, np.roll(points, -1, axis=0)) for _, points in ZONES]
    numbers = [[zone, k] for zone, (_, points) in enumerate(ZONES) for k in range(len(points))]
    return np.vstack([a for a, _ in ends]), np.vstack([b for _, b in ends]), np.array(numbers)


def from_segments(points):
    """The distance of each point from each segment: shape (n, s)."""
    a, b, _ = segments_of_zones()
    p, way = np.asarray(points, np.float64)[:, None], b - a
    t = np.clip(((p - a) * way).sum(axis=2) / (way * way).sum(axis=1), 0, 1)
    return np.linalg.norm(p - a - t[..., None] * way, axis=2)


def allowed(points):
    """By the angles under which each point sees the sides of each zone."""
    inside = {"inclusion": False, "exclusion": False}
    for zone, corners in ZONES:
        a = corners - np.asarray(points, np.float64)[:, None]
        b = np.roll(a, -1, axis=1)
        cross, dot = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(axis=2)
        turns = np.rint(np.arctan2(cross, dot).sum(axis=1) / (2 * np.pi))
        inside[zone] = inside[zone] | (turns != 0)
    return inside["inclusion"] & ~inside["exclusion"]


def around(dtype, count=600):
    points = np.random.default_rng(4).uniform(-15, 18, (count, 2))
    points[:20] = ZONES[0][1][:20]
    points[20:25] = ZONES[0][1][:5] + 1e-9
    return points.astype(dtype)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_side_of_a_fence_is_what_its_zones_allow(fence, dtype):
    model, _ = fence
    assert model.has_sides and model.serves == ["curve"]
    points = around(dtype)
    found, truth = model.signed_distance(points), from_segments(points).min(axis=1)
    decided = found.side != Side.UNDECIDED
    assert (decided == (found.lower * found.upper > 0)).all() and decided.mean() > 0.9
    side = np.where(allowed(points), Side.INSIDE, Side.OUTSIDE)
    assert (found.side == side)[decided].all() and len(set(side)) == 2
    signed = side * truth
    assert (found.lower <= signed + 1e-12).all() and (signed - 1e-12 <= found.upper).all()
    assert (found.upper - found.lower)[decided].max() < 1e-3
    for shape in [points[:, :1], np.pad(points, [(0, 0), (0, 1)])]:
        with pytest.raises(meshsweep.QueryError, match=r"\(n, 2\)"):
            model.signed_distance(shape)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_questions_in_the_plane_find_the_segments(fence, dtype):
    model, is_flat = fence
    points = around(dtype, 200)
    if not is_flat:
        with pytest.raises(meshsweep.QueryError, match=r"\(n, 3\)"):
            model.closest_point(points)
        return
    truth, numbers = from_segments(points), segments_of_zones()[2]
    nearest = truth.min(axis=1)
    close, few = model.closest_point(points), model.nearest(points, 3)
    for found in [close, few[:, 0]]:
        assert (found.lower <= nearest + 1e-12).all() and (nearest - 1e-12 <= found.upper).all()
    wanted = np.sort(truth, axis=1)[:, :3]
    assert (few.lower <= wanted + 1e-12).all() and (wanted - 1e-12 <= few.upper).all()
    at = [np.flatnonzero((numbers == [near.polyline, near.segment]).all(axis=1)) for near in close]
    assert (truth[np.arange(200), np.concatenate(at)] <= nearest + 1e-3).all()
    for distance in [0.0, 0.5, 1 + 1e-12]:
        found = model.within(points, distance)
        assert (nearest[found.verdict == Verdict.NO] > distance).all()
        yes = found.verdict == Verdict.YES
        assert (nearest[yes] <= distance + 1e-12).all() and yes.any() == (distance > 0)
        assert (found.polyline[yes] >= 0).all() and (found.segment[~yes] == -1).all()
    single = points.astype(np.float32)
    for row, found in zip(from_segments(single), model.all_within(single, 2.0), strict=True):
        listed = {(near.polyline, near.segment) for near in found}
        assert {tuple(pair) for pair in numbers[row <= 2.0].tolist()} <= listed
        sure = {(near.polyline, near.segment) for near in found[found.is_certain]}
        assert sure <= {tuple(pair) for pair in numbers[row <= 2.0 + 1e-12].tolist()}


def test_the_fence_of_the_fixtures_has_the_sides_of_the_program(fixtures):
    fence = meshsweep.load(fixtures / "fence.msw")
    (inside,) = fence.signed_distance(np.array([[50, 7]], np.float32))
    assert inside.side == Side.INSIDE and inside.lower <= -7 <= inside.upper
    assert bytes(meshsweep.build(fixtures / "fence.csv", closed=True)) == bytes(fence)


def test_curves_that_bound_no_area_have_no_sides(tmp_path):
    (tmp_path / "path.csv").write_text("0,0\n1,0\n1,1\n")
    path = meshsweep.build(tmp_path / "path.csv")
    assert path.has_sides is False
    with pytest.raises(meshsweep.QueryError, match="closed"):
        path.signed_distance([[0, 0]])
