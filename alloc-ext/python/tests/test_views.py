"""Triangles that may be seen, and answers of hull hierarchies: beside exact signs."""

from fractions import Fraction

import meshsweep
import numpy as np
import pytest
from conftest import crosses, orientation, passes, sphere
from meshsweep import Facing, Verdict

VERTICES, TRIANGLES = sphere(5, 7)
CORNERS = [[[Fraction(x) for x in p] for p in t] for t in VERTICES[TRIANGLES].tolist()]


def build(words):
    base = 12 if words == "hull" else None
    return meshsweep.build((VERTICES, TRIANGLES), words, vertex_bits=32, base_faces=base)


def segments(count=80):
    starts, ends = np.random.default_rng(51).uniform(-1.5, 1.5, (2, count, 3)).astype(np.float32)
    return starts, starts + (ends - starts) / 2


def passed(starts, ends):
    """Of each segment the triangles that it passes through."""
    both = zip(starts.tolist(), ends.tolist(), strict=True)
    return [{k for k, t in enumerate(CORNERS) if passes(a, b, t)} for a, b in both]


def test_no_triangle_that_faces_an_eye_is_left_out():
    part = build("cull")
    eyes = np.random.default_rng(52).uniform(-4, 4, (20, 3)).astype(np.float32)
    eyes[0] = 0
    directions = eyes[1:]
    left_out = []
    for found, far in [
        (part.front_facing(eyes), [([Fraction(x) for x in eye], None) for eye in eyes.tolist()]),
        (part.front_facing_along(directions), [(None, way) for way in directions.tolist()]),
    ]:
        assert len(found) == len(far)
        for seen, (eye, way) in zip(found, far, strict=True):
            listed = seen.triangle.tolist()
            assert listed == sorted({*listed})
            for number, corners in enumerate(CORNERS):
                # Against a direction the eye is beside a corner.
                place = eye or [x - Fraction(y) for x, y in zip(corners[0], way, strict=True)]
                assert orientation(*corners, place) >= 0 or number in listed
            left_out.append(len(TRIANGLES) - len(listed))
    assert left_out[0] > len(TRIANGLES) / 2 and 10 < np.mean(left_out) < 30
    assert len(part.front_facing_along([[0, 0, 0]])[0]) == len(TRIANGLES)
    with pytest.raises(meshsweep.QueryError, match=r"row 1: .*finite"):
        part.front_facing([[0, 0, 1], [0, np.nan, 0]])
    with pytest.raises(meshsweep.NotServedError, match='for_="cull"'):
        build("closest").front_facing(eyes)


def test_without_a_box_tree_the_hulls_tell_hits():
    part, (starts, ends) = build("hull"), segments()
    first, (lists, is_complete) = part.first_hit(starts, ends), part.all_hits(starts, ends)
    truly = passed(starts, ends)
    assert is_complete.all() and "segment" not in part.serves
    for numbers, hit, hits in zip(truly, first, lists, strict=True):
        assert {*hits.triangle.tolist()} == numbers and (hits.verdict == Verdict.YES).all()
        assert hit.verdict == bool(numbers)
        assert not numbers or hit.triangle == hits.triangle[0]
    way = ends - starts
    ray, (rays, _) = part.first_hit_of_ray(starts, way), part.all_hits_of_ray(starts, way)
    by_tree = build("segment").first_hit_of_ray(starts, way)
    assert (ray.verdict == by_tree.verdict).all() and (ray.triangle == by_tree.triangle).all()
    assert [len(hits) > 0 for hits in rays] == (ray.verdict != Verdict.NO).tolist()
    cut = part.cut(level=0)
    coarse = cut.first_hit(starts, ends)
    assert not (coarse.verdict == Verdict.YES).any() and (coarse.triangle == -1).all()
    assert not (coarse.verdict == Verdict.NO)[[bool(numbers) for numbers in truly]].any()
    for ask in [part.first_hit, part.all_hits, part.first_hit_of_ray]:
        with pytest.raises(meshsweep.NotServedError, match='for_="segment"'):
            ask(starts, ends, facing=Facing.BACK)


def test_without_box_trees_the_hulls_tell_overlaps():
    part, tree = build("hull"), build("segment")
    places = np.random.default_rng(53).integers(-16, 17, (12, 3)) / 8
    poses = np.tile(np.eye(4), (12, 1, 1))
    poses[:, :3, 3] = places
    found, lists = part.overlap(part, poses), part.all_overlaps(part, poses)
    by_tree = tree.all_overlaps(tree, poses)
    for place, meets, pairs, others in zip(places, found, lists, by_tree, strict=True):
        listed = {tuple(pair) for pair in pairs.triangles.tolist()}
        assert listed == {tuple(pair) for pair in others.triangles.tolist()}
        assert (meets.verdict == Verdict.NO) == (not listed)
        if meets.verdict == Verdict.YES:
            a, b = meets.triangles
            moved = [[x + Fraction(y) for x, y in zip(p, place, strict=True)] for p in CORNERS[b]]
            assert crosses(CORNERS[a], moved) and (a, b) in listed
    assert {*found.verdict.tolist()} >= {Verdict.NO, Verdict.YES}
    cut = part.cut(level=0)
    coarse = cut.overlap(part, poses)
    assert not (coarse.verdict == Verdict.YES).any() and (coarse.triangles == -1).all()
    assert (found.verdict[coarse.verdict == Verdict.NO] == Verdict.NO).all()
    with pytest.raises(meshsweep.NotServedError, match="cut knows no triangles"):
        part.all_overlaps(cut, poses)
    with pytest.raises(meshsweep.NotServedError, match='for_="segment"'):
        part.overlap(tree, poses)
