"""Bounds by the distance field first, compared with all triangles in f64; options of fields."""

import functools

import meshsweep
import numpy as np
import pytest
from conftest import CORNERS, FACES, distances, sphere
from meshsweep import Side, Verdict

BALL = sphere(6, 8)
CUBE = (CORNERS, FACES)


@functools.cache
def model(kind, is_cube=False):
    mesh, size = (CUBE, 1024) if is_cube else (BALL, 4096)
    options = {"sdf_kind": kind, "sdf_bytes": size, "sdf_layout": "lattice"}
    return meshsweep.build(mesh, "closest,segment,sdf", **options)


def around(count=600):
    return np.random.default_rng(21).uniform(-2.5, 2.5, (count, 3))


@pytest.mark.parametrize("kind", ["signed", "solid", "surface"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("rel", [0.0, 0.2])
def test_bounds_contain_the_distance_to_the_tolerance(kind, dtype, rel):
    vertices, triangles = BALL
    part = model(kind)
    assert part.field_kind == kind
    points = around().astype(dtype)
    truth = distances(points, vertices, triangles).min(axis=1)
    found = part.distance_bounds(points, rel=rel)
    assert (found.lower <= truth + 1e-12).all() and (truth - 1e-12 <= found.upper).all()
    assert (found.upper <= (1 + rel) * found.lower + 1e-3).all()
    alone = found.work == 0
    assert alone.any() == (rel > 0) and not alone.all()
    # The mesh lies between two spheres.
    signed = part.signed_bounds(points, rel=rel)
    radius = np.linalg.norm(points, axis=1)
    sure = np.where(radius > 1, Side.OUTSIDE, np.where(radius < 0.8, Side.INSIDE, 0))
    decided = signed.side != Side.UNDECIDED
    assert decided.mean() > 0.95 and (signed.side == sure)[decided & (sure != 0)].all()
    value = np.where(sure == Side.INSIDE, -truth, truth)[sure != 0]
    of = signed[sure != 0]
    assert (of.lower <= value + 1e-12).all() and (value - 1e-12 <= of.upper).all()
    width = rel * np.maximum(np.abs(of.lower), np.abs(of.upper)) + 1e-3
    assert (of.upper - of.lower <= width)[of.side != 0].all()


@pytest.mark.parametrize("kind", ["signed", "surface"])
def test_points_in_double_precision_on_the_surface_have_their_sign_in_the_interval(kind):
    # The planes of a cube are exact, and points beside them are nearer than single precision tells.
    part = model(kind, True)
    above = np.linspace(-1e-8, 1e-8, 41)
    points = np.stack([np.full(41, 0.5), np.full(41, 0.25), 1 + above], axis=1)
    wanted = [part.signed_bounds(points, rel=0.1), part.signed_distance(points)]
    wanted += [part.field_distance(points)] if kind == "signed" else []
    for found in wanted:
        assert (found.lower <= above + 1e-15).all() and (above - 1e-15 <= found.upper).all()
    for found in [part.distance_bounds(points, rel=0.1), part.closest_point(points)]:
        assert (found.lower <= np.abs(above) + 1e-15).all() and (found.lower >= 0).all()
        assert (np.abs(above) - 1e-15 <= found.upper).all()


def test_verdicts_by_the_field_first_are_those_of_the_tree():
    part = model("signed")
    points = around(2000).astype(np.float32)
    truth = distances(points, *BALL).min(axis=1)
    for distance in [0.0, 0.3, 1.0]:
        by_tree = part.within(points, distance)
        found = part.within(points, distance, field_first=True)
        assert (truth[found.verdict == Verdict.NO] > distance).all()
        assert (truth[found.verdict == Verdict.YES] <= distance).all()
        assert (found.verdict == Verdict.UNDECIDED).sum() <= (by_tree.verdict == 2).sum()
        alone = found.work == 0
        assert 0.5 < alone.mean() and (found.triangle[alone] == -1).all()
        assert (found[~alone] == by_tree[~alone]).all()
    alone = meshsweep.build(BALL, "closest")
    for ask in [
        lambda: alone.within([0, 0, 0], 1, field_first=True),
        lambda: alone.distance_bounds([0, 0, 0]),
        lambda: alone.signed_bounds([0, 0, 0]),
    ]:
        with pytest.raises(meshsweep.NotServedError, match='for_="sdf"'):
            ask()
    assert alone.field_kind is None


def test_fields_are_as_narrow_as_asked_for():
    points = around()
    sizes = []
    for layout in ["lattice", "tree"]:
        part = meshsweep.build(BALL, "sdf", sdf_error=0.4, sdf_layout=layout, sdf_margin=1.0)
        low, high = part.bounds
        within = ((points >= low) & (points <= high)).all(axis=1)
        found = part.field_distance(points[within].astype(np.float32))
        assert within.sum() > 100 and (found.upper - found.lower).max() <= 0.4
        sizes.append(len(bytes(part)))
        wider = meshsweep.build(
            BALL, "sdf", sdf_error=0.4, sdf_rel=0.5, sdf_layout=layout, sdf_margin=1.0
        )
        found = wider.field_distance(points[within].astype(np.float32))
        widths = found.upper - found.lower
        allowed = 0.4 + 0.5 * np.maximum(np.abs(found.lower), np.abs(found.upper))
        assert (widths <= allowed).all() and len(bytes(wider)) <= sizes[-1]
    assert sizes[0] != sizes[1]
    for options, words in [
        ({"sdf_layout": "cube"}, "sdf_layout: no 'cube'|sdf_layout: no \"cube\""),
        ({"sdf_error": 1e-9, "sdf_bytes": 1024}, "1e-9|0.000000001|narrow"),
        ({"sdf_rel": 0.5}, "sdf|error"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.build(BALL, "sdf", **options)


def test_tight_hulls_and_triboxes_take_their_options():
    both = meshsweep.build(BALL, "tight")
    alone = meshsweep.build(BALL, "tight", tight_for="closest")
    assert len(bytes(alone)) < len(bytes(both))
    assert len(alone.tight_hulls()) == len(both.tight_hulls())
    with pytest.raises(meshsweep.BuildError, match="closest, segment"):
        meshsweep.build(BALL, "tight", tight_for="winding")
    part = meshsweep.build(BALL, "triboxes", extrema=True, triboxes=8)
    assert 1 <= len(part.triboxes().node) <= 8


@pytest.mark.parametrize("kind", ["signed", "solid", "surface"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_verdicts_of_the_field_alone_hold(kind, dtype):
    points, limit = around().astype(dtype), 0.3
    found = model(kind).field_within(points, limit)
    is_near = distances(points, *BALL).min(axis=1) <= limit
    # The mesh lies between two spheres.
    is_inside = np.linalg.norm(points, axis=1) < 0.8
    if kind == "solid":
        is_near |= is_inside
    assert not (found.verdict == Verdict.NO)[is_near].any()
    assert not (found.verdict == Verdict.YES)[~is_near].any()
    decided = found.verdict != Verdict.UNDECIDED
    assert decided[~is_inside].mean() > 0.9 and (found.work == 0).all()
    assert ((found.ended == meshsweep.Ended.EXACT) == decided).all()
    with pytest.raises(meshsweep.NotServedError, match="sdf"):
        meshsweep.build(BALL).field_within(points, limit)
