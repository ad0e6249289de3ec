"""`python -m meshsweep part.stl`: what the model of a part answers, and what it costs."""

import sys
import time

import numpy as np

import meshsweep


def main() -> int:
    """Shows one part. Returns the exit code."""
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print("usage: python -m meshsweep MESH", file=sys.stderr)
        return 2
    try:
        show(sys.argv[1])
    except (meshsweep.MeshsweepError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


def show(file: str) -> None:
    """Builds the part's model and asks it some questions."""
    part = meshsweep.build(file, "closest,segment,tight", progress=True)
    for note in part.report:
        print(note.text)
    low, high = part.bounds
    middle, size = (low + high) / 2, high - low
    print(f"{file}: {len(bytes(part)):,} bytes for {', '.join(part.serves)}")
    print(f"box {low} to {high}; closed: {part.is_closed}")

    above = np.array([middle[0], middle[1], high[2] + size[2]], np.float32)
    (near,) = part.closest_point(above)
    print(f"from {above} the surface is {near.lower:.7g} to {near.upper:.7g} away,")
    print(f"  at {near.point}, on triangle {near.triangle}")

    below = above - np.array([0, 0, 3 * size[2]], np.float32)
    (hit,) = part.first_hit(above, below)
    words = {0: "clear, proved", 1: "a hit", 2: "undecided"}
    print(f"the segment down to {below}: {words[int(hit.verdict)]}, point {hit.point}")

    rng = np.random.default_rng(0)
    points = rng.uniform(low - size / 4, high + size / 4, (100_000, 3)).astype(np.float32)
    before = time.perf_counter()
    found = part.closest_point(points)
    took = time.perf_counter() - before
    width = np.max(found.upper - found.lower)
    print(f"100,000 closest points: {took * 10:.2f} microseconds each; widest interval {width:.2g}")
    if part.has_sides:
        side = part.signed_distance(points).side
        share = np.mean(side == meshsweep.Side.INSIDE)
        print(f"inside: {share:.1%}; undecided: {np.mean(side == 0):.1%}")
    for hull in part.tight_hulls():
        print(f"hull of {len(hull.triangles)} faces: at most {hull.slack:.4g} from the part")


if __name__ == "__main__":
    sys.exit(main())
