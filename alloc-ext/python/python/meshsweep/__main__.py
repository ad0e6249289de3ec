"""`python -m meshsweep part.stl`: what the model of a part answers, and what it costs.

The part is a mesh, a blob, or a .csv of curves.
"""

import argparse
import sys
import time

import numpy as np

import meshsweep


def main() -> int:
    """Shows one part. Returns the exit code."""
    parser = argparse.ArgumentParser("python -m meshsweep", description=__doc__.split("\n")[0])
    parser.add_argument("part", help="a mesh, a blob (.msw), or curves (.csv)")
    try:
        show(parser.parse_args().part)
    except (meshsweep.MeshsweepError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


def show(file: str) -> None:
    """Opens or builds the part's model and asks it some questions."""
    part = opened(file)
    for note in part.report:
        print(note.text)
    print(f"{file}: {len(bytes(part)):,} bytes for {', '.join(part.serves)}")
    try:
        low, high = part.bounds
    except meshsweep.NotServedError as error:
        print(error)
        return
    middle, size = (low + high) / 2, high - low
    print(f"box {low} to {high}; closed: {part.is_closed}")

    above = np.array([middle[0], middle[1], high[2] + max(size)], np.float32)
    if {"closest", "curve", "hull", "sweep", "tight"} & set(part.serves):
        (near,) = part.closest_point(above)
        print(f"from {above} the surface is {near.lower:.7g} to {near.upper:.7g} away,")
        print(f"  at {near.point}")
    if "segment" in part.serves:
        below = above - np.array([0, 0, 3 * max(size)], np.float32)
        (hit,) = part.first_hit(above, below)
        words = {0: "clear, proved", 1: "a hit", 2: "undecided"}
        print(f"the segment down to {below}: {words[int(hit.verdict)]}, point {hit.point}")
    if "closest" in part.serves:
        rng = np.random.default_rng(0)
        points = rng.uniform(low - size / 4, high + size / 4, (100_000, 3)).astype(np.float32)
        before = time.perf_counter()
        found = part.closest_point(points)
        took = time.perf_counter() - before
        width = np.max(found.upper - found.lower)
        each = f"{took * 10:.2f} microseconds each"
        print(f"100,000 closest points: {each}; widest interval {width:.2g}")
        if part.has_sides:
            side = part.signed_distance(points).side
            share = np.mean(side == meshsweep.Side.INSIDE)
            print(f"inside: {share:.1%}; undecided: {np.mean(side == 0):.1%}")
    for hull in part.tight_hulls() if "tight" in part.serves else []:
        print(f"hull of {len(hull.triangles)} faces: at most {hull.slack:.4g} from the part")


def opened(file: str) -> meshsweep.Model:
    """The model of a blob, or that of a mesh or curves."""
    if file.lower().endswith(".msw"):
        return meshsweep.load(file)
    is_curve = file.lower().endswith(".csv")
    return meshsweep.build(file, "" if is_curve else "closest,segment,tight", progress=True)


if __name__ == "__main__":
    sys.exit(main())
