"""Every interval contains the truth, and no verdict is wrong."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere
from meshsweep import Side, Verdict

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
    near = part.nearest(points, 5)
    assert near.shape == (60, 5)
    wanted = np.sort(truth, axis=1)[:, :5]
    assert (near.lower <= wanted + 1e-12).all() and (wanted - 1e-12 <= near.upper).all()


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
    assert all(len(found) >= 2 for found in part.all_hits(-2 * way, 2 * way))
    beside = np.cross(way, [0.3, 0.5, 0.7]).astype(np.float32)
    beside *= 1.001 / np.linalg.norm(beside, axis=1)[:, None].astype(np.float32)
    clear = part.first_hit(beside - way, beside + way)
    assert (clear.verdict == Verdict.NO).all() and np.isinf(clear.t_lower).all()
    rays = part.first_hit_of_ray(2 * way, way)
    assert (rays.verdict == Verdict.NO).all()
    assert (part.first_hit_of_ray(2 * way, -way).verdict != Verdict.NO).all()


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
