"""More points, or more parts, than one machine likes: dask asks, or builds, on many processes.

    python cluster.py part.msw points.npy answers.npy      # closest points of a scan, shape (n, 3)
    python cluster.py --build parts/*.stl --into blobs      # a blob and a report for each part

Points are read, and answers written, a chunk at a time through a file that all workers see. So a
worker holds a chunk and the model, whatever the number of points. A chunk is asked again if its
worker dies: the same rows give the same bytes in the same place, so nothing is lost or doubled.
Without an address of a scheduler the workers are processes of this machine.
"""

import argparse
from pathlib import Path

import meshsweep
import numpy as np
from dask.distributed import Client, LocalCluster, as_completed

# Whole batches of questions: then each record is that of one process, its work too.
CHUNK = 15 * 2**14


def ask_chunk(model, points, answers, begin, end):
    """Closest points of some rows, into their place."""
    rows = np.load(points, mmap_mode="r")[begin:end]
    found = model.closest_point(rows)
    out = np.load(answers, mmap_mode="r+")
    out[begin:end] = found
    out.flush()
    return end - begin


def ask(client, blob, points, answers, chunk=CHUNK, tell=None):
    """Closest points of all rows of `points`, an .npy file, into `answers`, another."""
    rows = np.load(points, mmap_mode="r")
    dtype = np.dtype((np.void, meshsweep.load(blob).closest_point(rows[:1]).dtype))
    np.lib.format.open_memmap(answers, "w+", dtype, (len(rows),)).flush()
    begins = range(0, len(rows), chunk)
    blob, *names = [str(Path(file).resolve()) for file in (blob, points, answers)]
    # A task: each worker gets the model once, and a lost one is loaded again.
    model = client.submit(meshsweep.load, blob)
    futures = [
        client.submit(ask_chunk, model, *names, begin, min(begin + chunk, len(rows)), pure=False)
        for begin in begins
    ]
    done = 0
    for future in as_completed(futures):
        done += future.result()
        future.release()
        if tell is not None:
            tell(done, len(rows))


def build_one(file, into, words):
    """A blob beside its report. A part that is refused gives the reason, and stops no other."""
    out = Path(into) / (Path(file).stem + ".msw")
    try:
        part = meshsweep.build(file, words)
    except meshsweep.BuildError as error:
        return file, str(error)
    part.save(out)
    out.with_suffix(".txt").write_text("".join(f"{note.text}\n" for note in part.report))
    return file, None


def build(client, files, into, words=""):
    """Blobs of many parts. Returns the refused ones, with the reasons."""
    Path(into).mkdir(parents=True, exist_ok=True)
    place = str(Path(into).resolve())
    futures = [client.submit(build_one, str(Path(f).resolve()), place, words) for f in files]
    return [refused for refused in client.gather(futures) if refused[1] is not None]


def main():
    """Runs the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="+", help="BLOB POINTS ANSWERS, or the parts to build")
    parser.add_argument("--build", action="store_true", help="build parts in place of asking")
    parser.add_argument("--into", default=".", help="folder of the blobs")
    parser.add_argument("--for", dest="words", default="", help="as that of meshsweep build")
    parser.add_argument("--scheduler", help="address of a scheduler that runs")
    args = parser.parse_args()
    with Client(args.scheduler or LocalCluster(threads_per_worker=1)) as client:
        if args.build:
            for file, reason in build(client, args.files, args.into, args.words):
                print(f"{file}: {reason}")
            return
        blob, points, answers = args.files
        ask(client, blob, points, answers, tell=lambda done, of: print(f"{done:,} of {of:,}"))


if __name__ == "__main__":
    main()
