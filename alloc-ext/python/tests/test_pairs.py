"""Pairs of models, beside exact predicates, winding numbers and samples in f64."""

from fractions import Fraction

import meshsweep
import numpy as np
import pytest
from conftest import crosses, distances, sphere, winding_numbers
from meshsweep import Relation, Verdict


def ball():
    return sphere(5, 7)


def poses_at(places):
    poses = np.tile(np.eye(4), (len(places), 1, 1))
    poses[:, :3, 3] = places
    return poses


def exact(vertices, triangles):
    corners = vertices.astype(np.float64)[triangles]
    return [[[Fraction(x) for x in p] for p in t] for t in corners.tolist()], corners


def test_all_overlaps_leave_out_no_pair_that_meets():
    vertices, triangles = ball()
    part = meshsweep.build((vertices, triangles), "segment", vertex_bits=32)
    # Places are eighths, so that f64 adds them to corners without rounding.
    places = np.random.default_rng(31).integers(-12, 13, (6, 3)) / 8
    places[0] = [9, 0, 0]
    first, boxes = exact(vertices, triangles)
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    found, seen = part.all_overlaps(part, poses_at(places)), 0
    assert len(found) == 6 and len(found[0]) == 0
    for place, pairs in zip(places, found, strict=True):
        second = [
            [[x + Fraction(y) for x, y in zip(p, place.tolist(), strict=True)] for p in t]
            for t in first
        ]
        listed = {tuple(pair) for pair in pairs.triangles.tolist()}
        sure = {tuple(pair) for pair in pairs.triangles[pairs.is_certain].tolist()}
        apart = (low[:, None] > high + place) | (low + place > high[:, None])
        may = [tuple(pair) for pair in np.argwhere(~apart.any(axis=2)).tolist()]
        truly = {(a, b) for a, b in may if crosses(first[a], second[b])}
        assert truly <= listed and sure <= set(may)
        assert len(listed) == len(pairs)
        seen += len(truly)
        meets = part.overlap(part, poses_at([place])).verdict[0]
        assert (meets == Verdict.NO) == (len(pairs) == 0)
        assert (meets == Verdict.YES) == pairs.is_certain.any()
    assert seen > 50


def test_depths_of_penetration_hold_and_translations_separate():
    vertices, triangles = ball()
    words = "closest,segment,winding"
    part = meshsweep.build((vertices, triangles), words)
    small = meshsweep.build((vertices * np.float32(0.25), triangles), words)
    places = [[9, 0, 0], [1.5, 0.2, 0.1], [0, 0, 1.25], [0.1, 0, 0]]
    found = part.penetration(part, poses_at(places))
    assert found.relation.tolist()[:3] == [Relation.APART, Relation.OVERLAP, Relation.OVERLAP]
    assert not Relation(found.relation[0]) and Relation(found.relation[1])
    assert found.lower[0] == found.upper[0] == 0 and (found.lower <= found.upper).all()
    # Along their axis two of the same height are apart after 0.75; another way may be shorter.
    assert 0 < found.lower[2] <= 0.75 and 0 < found.lower[1]
    rng = np.random.default_rng(32)
    for near, place in zip(found[1:], np.array(places[1:]), strict=True):
        moved = vertices + near.apart
        assert np.linalg.norm(near.apart - place) <= near.upper * (1 + 1e-6)
        # At the translation no sample is inside both, and no corner of one in the other.
        samples = rng.uniform(-2.2, 2.2, (4000, 3))
        inside = winding_numbers(samples, vertices, triangles) > 0.5
        both = inside & (winding_numbers(samples, moved, triangles) > 0.5)
        assert inside.any() and not both.any()
        # The deepest point is inside of both as they are, and proves the lower end.
        at = near.deepest[None].astype(np.float64)
        depth = 0.0
        for of in [vertices, vertices + place]:
            assert winding_numbers(at, of, triangles) > 0.5
            depth += distances(at, of, triangles).min()
        assert near.lower <= depth + 1e-6
    inside = part.penetration(small, poses_at([[0, 0, 0], [0.2, 0, 0.1]]))
    assert (inside.relation == Relation.SECOND_INSIDE).all()
    outside = small.penetration(part, poses_at([[0, 0, 0]]))
    assert outside.relation == [Relation.FIRST_INSIDE]
    loose = part.penetration(part, poses_at(places), steps=1)
    assert (loose.lower <= found.upper).all() and (found.lower <= loose.upper).all()
    with pytest.raises(meshsweep.NotServedError, match="winding"):
        part.penetration(meshsweep.build(ball()))


def test_triboxes_that_are_no_candidates_hold_no_pair_that_meets():
    vertices, triangles = sphere(6, 8)
    part = meshsweep.build((vertices, triangles), "triboxes,segment", triboxes=16)
    places = np.random.default_rng(33).uniform(-2.2, 2.2, (20, 3)).astype(np.float32)
    poses = poses_at(places)
    union = part.triboxes()
    found = part.tribox_candidates(part, poses)
    apart = part.tribox_overlap(part, poses).verdict == Verdict.NO
    assert [len(pairs) == 0 for pairs in found] == apart.tolist() and 0 < apart.sum() < 20
    directions = union.directions.astype(np.float64)
    points = np.random.default_rng(34).uniform(-1.1, 1.1, (3000, 3))
    inside = lambda at: (
        ((at @ directions.T)[:, None] >= union.low).all(axis=2)
        & ((at @ directions.T)[:, None] <= union.high).all(axis=2)
    )
    held = inside(points @ union.frame.astype(np.float64).T)
    for place, pairs in zip(places.astype(np.float64), found, strict=True):
        listed = {tuple(pair) for pair in pairs.triboxes.tolist()}
        other = inside((points - place) @ union.frame.astype(np.float64).T)
        for one, two in zip(held, other, strict=True):
            for a in union.node[one].tolist():
                assert all((a, b) in listed for b in union.node[two].tolist())
    assert sum(map(len, found)) < 20 * 16 * 16 / 2
