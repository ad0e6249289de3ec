"""The bits are those of the boards: the hashes of `fixtures/answers.txt`."""

import meshsweep
import numpy as np
import pytest

MASK = (1 << 64) - 1


class Stream:
    """SplitMix64, and points in a box of twice the size, as the suite of the boards has them."""

    def __init__(self, kind: int) -> None:
        self.state = 0x6D65736873776570 ^ (kind << 56)

    def signed_unit(self) -> np.float32:
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        z ^= z >> 31
        unit = np.float32(z >> 40) * np.float32(2.0**-24)
        return np.float32(2.0) * unit - np.float32(1.0)

    def far(self, bounds: np.ndarray) -> list[np.float32]:
        half = np.float32(0.5) * bounds
        centre, size = half[0] + half[1], half[1] - half[0]
        two = np.float32(2.0)
        return [centre[k] + two * size[k] * self.signed_unit() for k in range(3)]


def fold(data: bytes) -> int:
    """FNV-1a."""
    state = 0xCBF29CE484222325
    for byte in data:
        state = ((state ^ byte) * 0x100000001B3) & MASK
    return state


def hash_of(answers: list[bytes]) -> str:
    """Sixteen blocks of 32 answers each."""
    assert len(answers) == 512
    blocks = [fold(b"".join(answers[at : at + 32])) for at in range(0, 512, 32)]
    return f"{fold(b''.join(block.to_bytes(8, 'little') for block in blocks)):016x}"


def committed(fixtures, name: str) -> str:
    lines = (fixtures / "answers.txt").read_text().splitlines()
    (line,) = [line for line in lines if line.startswith(name + " ")]
    return line.split()[-1]


def points(model: meshsweep.Model, kind: int) -> np.ndarray:
    stream = Stream(kind)
    bounds = np.array(model._facts["stored_bounds"], np.float32)  # those that the boards know
    stream.far(bounds)  # where the path of other kinds begins
    return np.array([stream.far(bounds) for _ in range(512)], np.float32)


def hash_of_closest(found: np.recarray) -> str:
    answers = [
        np.array([near.lower, near.upper, *near.point], "<f4").tobytes()
        + int(near.triangle).to_bytes(4, "little")
        + int(near.ended).to_bytes(4, "little")
        for near in found
    ]
    return hash_of(answers)


@pytest.mark.parametrize("blob", ["groove.msw", "bracket.msw"])
def test_closest_points_have_the_bits_of_the_boards(fixtures, blob):
    model = meshsweep.load(fixtures / blob)
    found = hash_of_closest(model.closest_point(points(model, 2)))
    assert found == committed(fixtures, f"{blob} closest_far")


def test_key_frames_have_the_bits_of_the_boards(fixtures):
    model, stream = meshsweep.load(fixtures / "bend.msw"), Stream(32)
    bounds = np.array(model._facts["stored_bounds"], np.float32)
    stream.far(bounds)
    asked = np.array([[abs(stream.signed_unit()), *stream.far(bounds)] for _ in range(512)])
    found = model.closest_point(asked[:, 1:], frame=asked[:, 0])
    assert hash_of_closest(found) == committed(fixtures, "bend.msw frame")


def test_fields_have_the_bits_of_the_boards(fixtures):
    model = meshsweep.load(fixtures / "field.msw")
    found = model.field_distance(points(model, 12))
    code = {1: 1, -1: 2, 0: 0}
    answers = [
        np.array([near.lower, near.upper], "<f4").tobytes()
        + code[int(near.side)].to_bytes(4, "little")
        for near in found
    ]
    assert hash_of(answers) == committed(fixtures, "field.msw signed")
