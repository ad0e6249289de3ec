"""Rows of the trade are what a build and its questions give."""

import meshsweep
import numpy as np
import pytest
from conftest import sphere


def test_errors_and_bytes_are_those_of_the_models():
    told = []
    points = np.random.default_rng(1).uniform(-2, 2, (300, 3)).astype(np.float32)
    found = meshsweep.trade(sphere(6, 8), at=points, progress=lambda *told_: told.append(told_))
    assert len(found.rows) > 20 and 0 <= found.needles <= 1 and max(told)[1] == 1.0
    for bits, name in [(16, "16"), (32, "32")]:
        model = meshsweep.build(sphere(6, 8), "closest", vertex_bits=bits)
        row = next(
            row
            for row in found.rows
            if row.dials == "exact" and row.build == f"--for closest --vertex-bits {name}"
        )
        near = model.closest_point(points)
        widths = near.upper.astype(np.float64) - near.lower
        assert row.flash == len(bytes(model))
        assert row.error == pytest.approx(widths.max(), rel=1e-6)
        assert row.median_error == pytest.approx(np.sort(widths)[150], rel=1e-6)
        (m4f, m0) = row.instructions.values()
        assert 1000 < m4f.mean <= m4f.most <= m4f.at_most and m0.mean > m4f.mean
    lower_bounds = [row.error for row in found.rows if row.structure.startswith("triboxes")]
    assert lower_bounds == [None, None]
    assert all(name.startswith("cut level") and why for name, why in found.not_built)
    measures = np.array(
        [
            [row.error, next(iter(row.instructions.values())).mean, row.flash]
            for row in found.rows
            if row.error is not None and row.instructions
        ]
    )
    best = [row for row in found.rows if row.is_best]
    for row in best:
        own = np.array([row.error, next(iter(row.instructions.values())).mean, row.flash])
        beats = (measures <= own).all(axis=1) & (measures < own).any(axis=1)
        assert not beats.any()
    assert 0 < len(best) < len(measures)


def test_segments_are_measured():
    starts, ends = np.random.default_rng(2).uniform(-2, 2, (2, 40, 3)).astype(np.float32)
    model = meshsweep.build(sphere(), "segment", vertex_bits=16)
    row = meshsweep.trade(sphere(), "segment", at=np.stack([starts, ends], axis=1)).rows[0]
    assert row.build == "--for segment --vertex-bits 16" and row.flash == len(bytes(model))
    hit = model.first_hit(starts, ends)
    free = np.clip([hit.t_lower, hit.t_upper], 0, 1) * np.linalg.norm(ends - starts, axis=1)
    assert row.error == pytest.approx((free[1] - free[0]).max(), rel=1e-3)
    assert row.undecided == (hit.verdict == meshsweep.Verdict.UNDECIDED).sum()


def test_what_cannot_be_measured_is_refused(fixtures):
    for options, words in [
        ({"for_": "tight"}, "closest, segment"),
        ({"at": "nowhere"}, "far, near, path"),
        ({"at": np.zeros((0, 3))}, "nothing to ask"),
        ({"at": np.zeros((4, 2))}, "shape"),
        ({"at": [[np.inf, 0, 0]]}, "finite"),
        ({"count": 0}, "at least 1"),
        ({"count": 1.5}, "count: a whole number"),
        ({"count": 2**70}, "count: .* is none from 0"),
        ({"for_": None}, "closest, segment"),
        ({"unit": 3}, "unit: a string"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.trade(sphere(), **options)
    with pytest.raises(meshsweep.BuildError, match="csv"):
        meshsweep.trade(fixtures / "fence.csv")

    def stop(_stage, _part):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        meshsweep.trade(sphere(), "segment", count=10, progress=stop)
