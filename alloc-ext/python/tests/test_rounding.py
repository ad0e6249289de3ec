"""What is proved is proved of the segment, ray or tool as it was given, in double precision."""

import functools
from fractions import Fraction

import meshsweep
import numpy as np
import pytest
from conftest import CORNERS, FACES
from meshsweep import Facing, Verdict

ASIDE = np.array([0.01, 0, 0])
BESIDE = np.array([[1e2, 0, 0], [0, 0, -1e2], [1e6, 1e6, 2e6]])
LOW, HIGH = np.array([4096.0, 0, 0]), np.array([4097.0, 1, 1])


@pytest.fixture(scope="module")
def part():
    """A box where single precision has steps of 0.0005."""
    return meshsweep.build((CORNERS + LOW, FACES), "segment,triboxes,winding", vertex_bits=32)


@pytest.fixture(scope="module")
def hull(tmp_path_factory):
    """The same box by its hull hierarchy, which deforms: at frame 1 it is larger."""
    file = tmp_path_factory.mktemp("frames") / "larger.obj"
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in (CORNERS * [1, 1, 2] + LOW).tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    file.write_text("\n".join(lines))
    return meshsweep.build((CORNERS + LOW, FACES), "hull,deform", frames=[file])


def enters(a, way, until=None):
    """Whether a segment or ray that begins outside meets the box: exact. `until` is its end."""
    first, last = Fraction(0), until
    for x, d, low, high in zip(a.tolist(), way, LOW.tolist(), HIGH.tolist(), strict=True):
        x, d = Fraction(x), Fraction(d)
        low, high = Fraction(low), Fraction(high)
        if d == 0:
            if not low <= x <= high:
                return False
            continue
        near, far = sorted([(low - x) / d, (high - x) / d])
        first, last = max(first, near), far if last is None else min(last, far)
    return first <= last


def hits(starts, ends):
    """Whether segments meet the box: exact."""
    rows = zip(starts.astype(np.float64), ends.astype(np.float64), strict=True)
    way = lambda a, b: [Fraction(y) - Fraction(x) for x, y in zip(a, b, strict=True)]
    return np.array([enters(a, way(a.tolist(), b.tolist()), Fraction(1)) for a, b in rows])


def grazing(count=300):
    """Segments that pass an edge of the box within the rounding, from above to below."""
    rng = np.random.default_rng(1)
    place = np.stack([np.full(count, HIGH[0]), rng.uniform(0.2, 0.8, count), np.ones(count)], 1)
    place[:, 0] += rng.normal(scale=1e-4, size=count)
    way = np.stack([rng.uniform(0.1, 0.5, count), np.zeros(count), -np.ones(count)], 1)
    return place - way * rng.uniform(1, 2, (count, 1)), place + way * rng.uniform(1, 3, (count, 1))


def test_a_segment_that_hits_is_not_called_clear_because_it_was_rounded(part, hull):
    a = np.array([4096.99941532546, 0.5858999871903519, 2.0062041501019077])
    b = np.array([4097.000736725505, 0.5858999871903519, -1.0])
    assert hits(a[None], b[None])
    for found in [part.first_hit(a, b), part.tribox_first_hit(a, b), part.first_contact(a, b)]:
        assert found.verdict == [Verdict.UNDECIDED] and 0 <= found.t_lower < 0.34
    starts, ends = grazing()
    is_hit = hits(starts, ends)
    assert 50 < sum(is_hit) < 250
    rounded = part.first_hit(starts.astype(np.float32), ends.astype(np.float32)).verdict
    assert (rounded[is_hit] == Verdict.NO).any()
    at_rest = functools.partial(hull.first_hit, frame=0.0)
    others = [hull.first_hit, at_rest]
    for ask in [part.first_hit, part.tribox_first_hit, part.first_contact, *others]:
        found = ask(starts, ends)
        assert (found.verdict[is_hit] != Verdict.NO).all()
        # One that passes at some distance is clear, and what is single precision is as before.
        aside = ask(starts + ASIDE, ends + ASIDE)
        assert (aside.verdict == Verdict.NO).mean() > 0.95
        same = starts.astype(np.float32), ends.astype(np.float32)
        as_double = [rows.astype(np.float64) for rows in same]
        assert ask(*same).tobytes() == ask(*as_double).tobytes()
    inside = part.first_hit(LOW + 0.4, HIGH - 0.3, facing=Facing.FRONT)
    assert inside.verdict == [Verdict.NO]
    # Beyond the domain of solids too.
    far = part.first_hit(starts + 1e7 * ASIDE, ends + 1e7 * ASIDE)
    assert (far.verdict != Verdict.YES).all()


@pytest.mark.parametrize("kind", ["part", "hull"])
def test_a_ray_that_hits_is_not_called_clear_because_it_was_rounded(kind, request):
    part = request.getfixturevalue(kind)
    starts, ends = grazing()
    ways = (ends - starts) * np.random.default_rng(2).uniform(1e-3, 1e3, (len(starts), 1))
    is_hit = np.array([enters(*row) for row in zip(starts, ways.tolist(), strict=True)])
    assert 50 < sum(is_hit) < 250
    rounded = part.first_hit_of_ray(starts.astype(np.float32), ways.astype(np.float32))
    assert (rounded.verdict[is_hit] == Verdict.NO).any()
    found = part.first_hit_of_ray(starts, ways)
    assert (found.verdict[is_hit] != Verdict.NO).all()
    aside = part.first_hit_of_ray(starts + ASIDE, ways)
    assert (aside.verdict == Verdict.NO).mean() > 0.95
    assert (part.first_hit_of_ray(starts, -ways).verdict == Verdict.NO).all()
    # From far away a ray that misses the box is clear, and one at the box is not.
    centre = 0.5 * (LOW + HIGH)
    far = centre + np.array([0.3, 0.9, 0.1]) * 1e7 + 1 / 3
    beside = part.first_hit_of_ray([far] * 3, [centre - far + aside for aside in BESIDE])
    assert (beside.verdict == Verdict.NO).all()
    assert part.first_hit_of_ray(far, centre - far).verdict != [Verdict.NO]
    # Rounding leaves little of such directions.
    tiny = part.first_hit_of_ray(starts, [[1.1e-45, 0, -1.1e-45]])
    assert (tiny.verdict == Verdict.UNDECIDED).all() and np.isinf(tiny.t_upper).all()


def test_the_rounding_of_a_carried_tool_is_in_the_answer(part):
    starts, ends = grazing(100)
    # The same ways, as a tool of one corner that is no number of single precision.
    tool = np.array([[1 / 3, -0.1, 0.7]])
    is_hit = hits(starts, ends)
    found = part.first_contact(starts - tool, ends - tool, tool=tool)
    assert (found.verdict[is_hit] != Verdict.NO).all()
    starts, ends = starts.astype(np.float32), ends.astype(np.float32)
    is_hit = hits(starts + tool, ends + tool)
    found = part.first_contact(starts, ends, tool=tool)
    assert (found.verdict[is_hit] != Verdict.NO).all()
