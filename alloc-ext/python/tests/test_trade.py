"""Rows of the trade are what a build and its questions give."""

import meshsweep
import numpy as np
import pytest
from conftest import distances, sphere


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
            if row.budget == "exact" and row.build == f"--for closest --vertex-bits {name}"
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
        ({"count": 2**32 - 1}, "count: at most 1000000"),
        ({"for_": None}, "closest, segment"),
        ({"unit": 3}, "unit: a string"),
    ]:
        with pytest.raises(meshsweep.BuildError, match=words):
            meshsweep.trade(sphere(), **options)
    with pytest.raises(meshsweep.BuildError, match="curves are measured for closest"):
        meshsweep.trade(fixtures / "fence.csv", "segment")

    def stop(_stage, _part):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        meshsweep.trade(sphere(), "segment", count=10, progress=stop)


def test_the_model_that_is_chosen_meets_the_limits():
    mesh, limit = sphere(4, 5), 0.01
    points = np.random.default_rng(3).uniform(-2, 2, (30, 3)).astype(np.float32)
    choice = meshsweep.choose(mesh, flash=4096, ram=4096, error=limit, at=points)
    assert isinstance(choice.model, meshsweep.Model) and choice.model.report
    assert len(bytes(choice.model)) == choice.first.flash <= 4096
    assert choice.first.scratch + choice.first.instructions["Cortex-M4F"].stack <= 4096
    assert choice.first.error <= limit and choice.second.error <= limit
    truth = distances(points, *mesh).min(axis=1)
    near = choice.model.closest_point(points)
    assert (near.lower <= truth + 1e-12).all() and (truth - 1e-12 <= near.upper).all()


def test_the_choice_is_the_best_of_the_settings_that_meet_the_limits():
    starts, ends = np.random.default_rng(2).uniform(-2, 2, (2, 40, 3)).astype(np.float32)
    mesh, how = sphere(24, 32), {"for_": "segment", "at": np.stack([starts, ends], axis=1)}
    rows = [row for row in meshsweep.trade(mesh, **how).rows if row.error is not None]
    of = lambda row, cpu="Cortex-M4F": row.instructions[cpu]
    flash = sorted({row.flash for row in rows})[1]
    best = min((row.undecided, row.error, of(row).mean) for row in rows if row.flash <= flash)
    choice = meshsweep.choose(mesh, flash=flash, **how)
    first = choice.first
    assert (first.undecided, first.error, of(first).mean) == best
    assert len(bytes(choice.model)) == first.flash <= flash
    hit = choice.model.first_hit(starts, ends)
    assert (hit.verdict == meshsweep.Verdict.UNDECIDED).sum() == first.undecided
    # With a limit of the error the quickest. A stack counts as RAM.
    ram = max(row.scratch + of(row).stack for row in rows) - 1
    meeting = [row for row in rows if row.error <= 1 and row.scratch + of(row).stack <= ram]
    quick = meshsweep.choose(mesh, error=1, ram=ram, **how).first
    assert 0 < len(meeting) < len(rows)
    fewest = min((row.undecided, of(row).mean) for row in meeting)
    assert (quick.undecided, of(quick).mean) == fewest
    # Two cycles an instruction.
    for name, cpu in [("m4f", "Cortex-M4F"), ("m7", "Cortex-M4F"), ("m0", "Cortex-M0")]:
        clock = 2000.1 * min(of(row, cpu).at_most for row in rows)
        found = meshsweep.choose(mesh, rate=1000, cpu=(name, clock), **how).first
        assert of(found, cpu).at_most * 2000 <= clock
        with pytest.raises(meshsweep.BuildError, match="rate 500Hz instead of 1000Hz"):
            meshsweep.choose(mesh, rate=1000, cpu=(name, clock / 2), **how)
    with pytest.raises(meshsweep.BuildError, match=r"which needs flash .* instead of 10"):
        meshsweep.choose(mesh, flash=10, **how)


def test_curves_are_measured_and_chosen(fixtures):
    file = fixtures / "fence.csv"
    points = np.random.default_rng(4).uniform(-20, 120, (200, 3)).astype(np.float32)
    points[:, 2] = 0
    curve, fence = (
        meshsweep.trade(file, at=points, closed=closed).rows for closed in (False, True)
    )
    signed = [row for row in fence if row.budget.startswith("signed")]
    assert signed and not any(row.budget.startswith("signed") for row in curve)
    assert any(row.budget.startswith("within") and row.error is None for row in curve)
    model = meshsweep.build(file, vertex_bits=32)
    near = model.closest_point(points)
    exact = next(row for row in curve if row.budget == "exact" and row.flash == len(bytes(model)))
    widths = near.upper.astype(np.float64) - near.lower
    assert exact.error == pytest.approx(widths.max(), rel=1e-6)
    flash = max(row.flash for row in curve) - 1
    choice = meshsweep.choose(file, flash=flash, at=points)
    meeting = [row for row in curve if row.error is not None and row.flash <= flash]
    assert 0 < len(meeting) and choice.first.error == min(row.error for row in meeting)
    assert len(bytes(choice.model)) <= flash and choice.model.serves == ["curve"]
    sides = meshsweep.choose(file, ram=4096, at=points, closed=True)
    found = sides.model.signed_distance(points[:, :2])
    assert sides.first.budget.startswith("signed")
    assert sides.first.undecided == min(row.undecided for row in signed)
    assert np.sum(found.side == 0) <= sides.first.undecided


def test_limits_that_are_none_are_refused():
    for options, words in [
        ({}, "one of flash, ram, error and rate"),
        ({"flash": 0}, "above 0"),
        ({"flash": -1}, "flash: -1"),
        ({"error": np.nan}, "error: nan"),
        ({"rate": 100}, "takes a processor"),
        ({"flash": 100, "cpu": "m4f"}, "a name and a clock"),
        ({"flash": 100, "cpu": ("m3", 1e6)}, "m4f, m7, m0"),
        ({"flash": 100, "for_": "tight"}, "closest, segment"),
    ]:
        with pytest.raises(meshsweep.MeshsweepError, match=words):
            meshsweep.choose(sphere(), **options)
