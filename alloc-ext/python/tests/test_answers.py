"""Every interval contains the truth, and no verdict is wrong."""

import meshsweep
import numpy as np
import pytest
from conftest import CORNERS, FACES, distances, orientation, sphere, winding_numbers
from meshsweep import Side, Verdict
from meshsweep._rounding import rounded

SCALES = [1.0, 1e-30, 1e30]


def around(seed: int, scale: float, count: int = 500):
    """Points in and around the sphere, some of them on its vertices."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-2, 2, (count, 3))
    points[:20] = sphere()[0][:20]
    return points * scale


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_intervals_contain_the_distance_of_the_point_as_given(scale, dtype):
    vertices, triangles = sphere(scale=scale)
    part = meshsweep.build((vertices, triangles), "closest,sdf", sdf_bytes=1024)
    points = around(1, scale).astype(dtype)
    truth = distances(points, vertices, triangles).min(axis=1)
    slack = 1e-12 * (truth + scale)
    for found in [part.closest_point(points), part.nearest(points, 3)[:, 0]]:
        assert (found.lower <= truth + slack).all()
        assert (truth - slack <= found.upper).all()
        assert (found.upper - found.lower).max() < 1e-3 * scale
    signed = np.where(np.abs(part.signed_distance(points).side) == 1, truth, 0)
    signed *= part.signed_distance(points).side
    for found in [part.signed_distance(points), part.field_distance(points)]:
        of = np.abs(found.side) == 1
        assert (found.lower[of] <= signed[of] + slack[of]).all()
        assert (signed[of] - slack[of] <= found.upper[of]).all()
        both = ~of
        assert (found.lower[both] <= slack[both]).all() and (found.upper[both] >= 0).all()


def test_sides_are_those_of_the_sphere():
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles), "closest,winding")
    points = around(2, 1.0)
    radius = np.linalg.norm(points, axis=1)
    for found in [part.signed_distance(points), part.winding_number(points)]:
        assert (found.side[radius > 1.001] == Side.OUTSIDE).all()
        assert (found.side[radius < 0.85] == Side.INSIDE).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_no_verdict_within_a_distance_is_wrong(dtype):
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles))
    points = around(3, 1.0).astype(dtype)
    truth = distances(points, vertices, triangles).min(axis=1)
    for distance in [0.0, 0.1, 0.5, 1.0]:
        found = part.within(points, distance)
        assert (truth[found.verdict == Verdict.NO] > distance).all()
        assert (truth[found.verdict == Verdict.YES] <= distance + 1e-12).all()
        assert np.mean(found.verdict == Verdict.UNDECIDED) < 0.1
        witness = found.triangle[found.verdict == Verdict.YES]
        assert ((witness >= 0) & (witness < len(triangles))).all()


def test_all_within_leaves_out_no_triangle_and_nearest_orders_them():
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles))
    points = around(4, 1.0, 60).astype(np.float32)
    truth = distances(points, vertices, triangles)
    for row, found in zip(truth, part.all_within(points, 0.6), strict=True):
        certain = set(found.triangle[found.is_certain])
        assert set(np.flatnonzero(row <= 0.6 - 1e-4)) <= certain
        assert certain <= set(np.flatnonzero(row <= 0.6 + 1e-12))
        assert set(np.flatnonzero(row <= 0.6)) <= set(found.triangle)
    # Distances that single precision rounds down.
    for row, point in zip(truth[:20], points, strict=False):
        distance = row.min() + 1e-9
        (found,) = part.all_within(point, distance)
        assert set(np.flatnonzero(row <= distance - 1e-12)) <= set(found.triangle)
        assert (found.upper[found.is_certain].astype(np.float64) <= distance).all()
    near = part.nearest(points, 5)
    assert near.shape == (60, 5)
    wanted = np.sort(truth, axis=1)[:, :5]
    assert (near.lower <= wanted + 1e-12).all() and (wanted - 1e-12 <= near.upper).all()


def test_each_point_has_a_distance_of_its_own_if_wanted_and_work_counts_both_searches():
    part = meshsweep.build(sphere(), "closest,segment")
    points = around(5, 1.0, 60)
    many = np.random.default_rng(6).uniform(0, 1, 60)
    for ask, rows in [(part.within, points), (part.solid_within, points[:, None])]:
        found = ask(rows, many)
        for row, distance in enumerate(many):
            (one,) = ask(rows[row : row + 1], distance)
            assert one.verdict == found[row].verdict and one.triangle == found[row].triangle
        single, exact = rows.astype(np.float32), np.float32(0.5)
        below = ask(single, np.nextafter(exact, np.float32(0)))
        above = ask(single, np.nextafter(exact, np.float32(1)))
        both = ask(single, np.float64(exact) + 1e-12)
        assert both.work.sum() > ask(single, exact).work.sum()
        assert abs(int(both.work.sum()) - int(below.work.sum() + above.work.sum())) < 100


def test_a_winding_number_has_a_side_of_the_point_as_given_or_none():
    vertices, triangles = sphere()
    points = around(2, 1.0)
    moved = (points != points.astype(np.float32)).any(axis=1)
    closed = meshsweep.build((vertices, triangles), "winding")
    assert (closed.winding_number(points).side[moved] != Side.UNDECIDED).all()
    # Within the rounding of the surface.
    middle = vertices.astype(np.float64)[triangles].mean(axis=1)
    near = middle * (1 + np.random.default_rng(9).uniform(-1e-8, 1e-8, (len(middle), 1)))
    assert (closed.winding_number(near).side == Side.UNDECIDED).all()
    # Of an open mesh it changes everywhere.
    ajar = meshsweep.build((vertices, triangles[1:]), "winding")
    assert (ajar.winding_number(points).side[moved] == Side.UNDECIDED).all()
    assert (ajar.winding_number(points.astype(np.float32)).side != Side.UNDECIDED).mean() > 0.9


def test_lists_give_the_records_of_a_row_when_they_are_wanted():
    part = meshsweep.build(sphere())
    points = around(4, 1.0, 60).astype(np.float32)
    found = part.all_within(points, 0.6)
    assert isinstance(found, meshsweep.Lists) and len(found) == 60
    assert found.begins.shape == (61,) and found.begins[-1] == len(found.records)
    assert [len(row) for row in found] == np.diff(found.begins).tolist()
    for row in [0, 7, np.int64(59), -1]:
        wanted = list(found)[row]
        assert found[row].tobytes() == wanted.tobytes() and len(wanted.triangle) == len(wanted)
    assert [row.tobytes() for row in found[5:9]] == [found[row].tobytes() for row in range(5, 9)]
    with pytest.raises(IndexError):
        found[60]
    assert "60 rows" in repr(found)
    # A record equals no other as a whole, so lists are not searched.
    assert not hasattr(found, "index") and not hasattr(found, "count")


def test_a_hull_hierarchy_tells_what_is_within_from_its_closest_points():
    mesh = sphere(24, 32)
    part, tree = meshsweep.build(mesh, "hull"), meshsweep.build(mesh)
    for points in [around(7, 2.0, 200), around(7, 2.0, 200).astype(np.float32)]:
        true = distances(points, *mesh).min(axis=1)
        found, wanted = part.within(points, 0.4), tree.within(points, 0.4)
        assert (true[found.verdict == Verdict.NO] > 0.4).all()
        assert (true[found.verdict == Verdict.YES] <= 0.4 + 1e-6).all()
        is_certain = found.verdict != Verdict.UNDECIDED
        assert is_certain.mean() > 0.95
        assert (found.verdict == wanted.verdict)[is_certain].all()
        assert (found.triangle[found.verdict != Verdict.YES] == -1).all()
    few = part.within(points, 0.4, steps=1)
    assert (few.ended[few.verdict == Verdict.UNDECIDED] == meshsweep.Ended.STEPS).all()


def test_the_least_long_doubles_count_as_moved():
    if np.finfo(np.longdouble).eps == np.finfo(np.float64).eps:
        pytest.skip("long doubles are doubles")
    near, moved = rounded(np.array([[np.longdouble("1e-400"), 0, 0], [1, 0, 0]], np.longdouble))
    assert moved is not None and moved[0] > 0 and moved[1] == 0 and not near[0].any()


@pytest.mark.parametrize("count", [5, 5000])
def test_nearest_of_no_points_has_the_width_of_others(count):
    part = meshsweep.build(sphere())
    none, one = (part.nearest(np.zeros((rows, 3)), count) for rows in (0, 1))
    assert none.shape == (0, *one.shape[1:]) and one.shape[1] == min(count, len(sphere()[1]))


def test_segments_through_the_middle_hit_twice_and_those_beside_are_clear():
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles))
    rng = np.random.default_rng(5)
    way = rng.normal(size=(200, 3)).astype(np.float32)
    way /= np.linalg.norm(way, axis=1)[:, None]
    hit = part.first_hit(-2 * way, 2 * way)
    assert (hit.verdict != Verdict.NO).all()
    certain = hit.verdict == Verdict.YES
    assert certain.mean() > 0.9
    off = distances(hit.point, vertices, triangles).min(axis=1)
    assert off.max() < 1e-4
    # Where a way passes an edge only the far side may be proved to be hit.
    assert (hit.t_upper < 0.5).mean() > 0.95 and (hit.t_lower > 0.2).all()
    assert all(len(found) >= 2 for found in part.all_hits(-2 * way, 2 * way).hits)
    beside = np.cross(way, [0.3, 0.5, 0.7]).astype(np.float32)
    beside *= 1.001 / np.linalg.norm(beside, axis=1)[:, None].astype(np.float32)
    clear = part.first_hit(beside - way, beside + way)
    assert (clear.verdict == Verdict.NO).all() and np.isinf(clear.t_lower).all()
    rays = part.first_hit_of_ray(2 * way, way)
    assert (rays.verdict == Verdict.NO).all()
    assert (part.first_hit_of_ray(2 * way, -way).verdict != Verdict.NO).all()


def test_a_list_without_a_triangle_that_is_hit_is_not_complete():
    vertices, triangles = sphere(30, 41)
    part = meshsweep.build((vertices, triangles))
    assert part.surface_error > 0
    rng = np.random.default_rng(7)
    chosen = rng.integers(0, len(triangles), 600)
    corners = vertices[triangles[chosen]].astype(np.float64)
    middle = corners.mean(axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    depth = rng.uniform(-0.5, 1.5, (600, 1)) * part.surface_error
    starts = (middle + 0.3 * normal).astype(np.float32)
    ends = (middle - depth * normal).astype(np.float32)
    is_hit = np.zeros(600, bool)
    for row, (start, end, (a, b, c)) in enumerate(
        zip(starts, ends, corners.astype(np.float32), strict=True)
    ):
        sides = orientation(a, b, c, start), orientation(a, b, c, end)
        around = {orientation(start, end, *edge) for edge in [(a, b), (b, c), (c, a)]}
        is_hit[row] = sides[0] * sides[1] <= 0 and not {-1, 1} <= around
    for found in [
        part.all_hits(starts, ends),
        part.all_hits_of_ray(ends, (starts - ends) * np.float32(10)),
    ]:
        assert found.is_complete.shape == (600,) and found.is_complete.dtype == bool
    found = part.all_hits(starts, ends)
    listed = np.array([t in h.triangle for t, h in zip(chosen, found.hits, strict=True)])
    assert (listed | ~found.is_complete)[is_hit].all()
    # The surface error leaves some of them out, or the test would show nothing.
    assert is_hit.mean() > 0.5 and (is_hit & ~listed).any()
    assert (part.first_hit(starts, ends).verdict[is_hit] != Verdict.NO).all()
    far = part.all_hits(starts, starts + np.float32(0.1))
    assert far.is_complete.all() and all(len(hits) == 0 for hits in far.hits)


def test_a_side_by_a_winding_number_is_that_of_the_point_as_given():
    corners, faces = CORNERS.astype(np.float32), FACES[:-2]
    box = meshsweep.build((corners, faces), "closest,winding")
    closed = meshsweep.build((corners, FACES), "closest,winding")
    assert not box.is_closed and closed.is_closed

    winding = lambda point: winding_numbers([point], corners, faces)[0]
    points = []
    for x, y in np.random.default_rng(8).uniform(0.1, 0.9, (50, 2)):
        low, high = 0.5, 1.5
        for _ in range(45):
            middle = (low + high) / 2
            low, high = (middle, high) if winding([x, y, middle]) > 0.5 else (low, middle)
        points += [[x, y, low - 1e-9], [x, y, high + 1e-9]]
    points = np.array(points)
    found, truth = box.signed_distance(points), distances(points, corners, np.array(faces))
    nearest = truth.min(axis=1)
    assert (found.side == Side.UNDECIDED).all()
    assert (found.lower <= -nearest).all() and (nearest <= found.upper).all()
    within = np.array([[0.5, 0.5, 0.25], [0.5, 0.5, 0.1], [0.5, 0.5, 5]])
    assert box.signed_distance(within).side.tolist() == [-1, 0, 1]
    assert box.signed_distance(within.astype(np.float32)).side.tolist() == [-1, -1, 1]
    assert closed.signed_distance(within).side.tolist() == [-1, -1, 1]


@pytest.mark.parametrize("offset", [0.0, 1e6])
@pytest.mark.parametrize("words", ["closest", "tight", "hull", "winding", "sdf"])
def test_the_bounds_hold_every_vertex_of_the_input(offset, words):
    vertices = sphere(20, 31)[0].astype(np.float64) * [2.337, 4.1, 1.973] + [0.1, 0.7, -3.3]
    part = meshsweep.build((vertices + offset, sphere(20, 31)[1]), words)
    low, high = part.bounds
    assert (low <= vertices + offset).all() and (vertices + offset <= high).all()
    # Hulls lie around the part, and a field has a margin.
    factor = {"sdf": 2.0, "tight": 1.1}.get(words, 1.01)
    assert (high - low < factor * np.ptp(vertices, axis=0) + offset * 1e-6).all()


def test_pairs_are_within_a_distance_that_single_precision_does_not_hold():
    part = meshsweep.build(sphere(), vertex_bits=32)
    pose = np.eye(4)
    pose[2, 3] = 3.0
    for distance, wrong in [(1 - 1e-12, Verdict.YES), (1 + 1e-12, Verdict.NO)]:
        (found,) = part.within_of(part, distance, pose)
        assert found.verdict != wrong
    assert part.within_of(part, 1.1, pose).verdict == [Verdict.YES]
    assert part.within_of(part, np.float32(0.9), pose).verdict == [Verdict.NO]


def test_no_verdict_about_a_rounded_distance_is_wrong_even_if_each_one_asked_is_decided():
    truths = 1 + np.linspace(-5e-7, 5e-7, 101)

    def ask(limits):
        found = np.recarray(len(truths), meshsweep._records.WITHIN_OF)
        found.verdict = np.where(truths <= limits, Verdict.YES, Verdict.NO)
        return found

    for distance in 1 + np.linspace(-1e-7, 1e-7, 41):
        found = meshsweep._rounding.verdict_at_unrounded_distance(ask, distance, np.zeros(1))
        assert (truths[found.verdict == Verdict.NO] > distance).all()
        assert (truths[found.verdict == Verdict.YES] <= distance).all()
        assert (found.verdict == Verdict.NO).any() and (found.verdict == Verdict.YES).any()


def test_pairs_are_as_far_apart_as_their_pose_puts_them():
    vertices, triangles = sphere()
    part = meshsweep.build((vertices, triangles))
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 2, 3] = [1.0, 3.0, 10.0]  # along the axis, where both have a vertex
    found = part.distance_to(part, poses)
    truth = np.array([0.0, 1.0, 8.0])
    assert (found.lower <= truth).all() and (truth <= found.upper).all()
    assert part.overlap(part, poses).verdict.tolist() == [Verdict.YES, Verdict.NO, Verdict.NO]
    verdicts = part.within_of(part, 2.0, poses[:, :3]).verdict.tolist()
    assert verdicts == [Verdict.YES, Verdict.YES, Verdict.NO]


def test_hulls_enclose_every_vertex():
    vertices, triangles = sphere(16, 24)
    part = meshsweep.build((vertices, triangles), "tight,hull", tight_faces=[20, 100])
    hulls = [(hull.vertices, hull.triangles) for hull in part.tight_hulls()]
    assert [len(faces) for _, faces in hulls][-1] <= 100
    hulls += part.hull_levels()
    assert len(hulls) > 3
    for corners, faces in hulls:
        a, b, c = corners.astype(np.float64)[faces.T]
        normal = np.cross(b - a, c - a)
        # The sphere is convex, and so is a hull of its tangent planes; others have few dents.
        side = np.einsum("vtk,tk->vt", vertices[:, None, :] - a, normal)
        volume = np.einsum("tk,tk->", a, np.cross(b, c)) / 6
        assert volume > 4.0
        assert np.linalg.norm(corners, axis=1).max() >= 1.0
        assert (side.min(axis=1) <= 0).all()


def test_with_a_tolerance_or_few_steps_the_interval_still_holds():
    vertices, triangles = sphere(30, 40)
    part = meshsweep.build((vertices, triangles))
    points = around(6, 1.0).astype(np.float32)
    truth = distances(points, vertices, triangles).min(axis=1)
    exact = part.closest_point(points)
    for found in [part.closest_point(points, rel=0.1), part.closest_point(points, steps=3)]:
        assert (found.lower <= truth + 1e-12).all() and (truth - 1e-12 <= found.upper).all()
        assert found.work.sum() < exact.work.sum()


def test_only_a_proof_of_nothing_is_falsy():
    assert not Verdict.NO and Verdict.YES and Verdict.UNDECIDED
