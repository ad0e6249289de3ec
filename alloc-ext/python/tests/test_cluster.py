"""Many processes give the bytes of one, also if a worker is killed, and memory stays flat."""

import contextlib
import importlib
import os
import resource
import signal
from pathlib import Path

import meshsweep
import numpy as np
import pytest

distributed = pytest.importorskip("dask.distributed")
EXAMPLES = Path(__file__).parents[1] / "examples"


@pytest.fixture
def cluster(monkeypatch):
    """The example, which workers import by the same name."""
    monkeypatch.syspath_prepend(EXAMPLES)
    monkeypatch.setenv("PYTHONPATH", str(EXAMPLES))
    return importlib.import_module("cluster")


@pytest.fixture
def client(cluster):
    workers = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with workers, distributed.Client(workers) as client:
        yield client


def bytes_of_workers(client):
    """The most memory that any worker ever held."""
    most = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return max(client.run(most).values())


def test_a_killed_worker_loses_nothing_and_memory_stays_flat(cluster, client, tmp_path, fixtures):
    rng = np.random.default_rng(1)
    points = rng.uniform(-20, 60, (400_000, 3)).astype(np.float32)
    np.save(tmp_path / "points.npy", points)
    blob = fixtures / "groove.msw"
    before = bytes_of_workers(client)
    (first, _) = client.run(os.getpid).values()

    def kill(done, of):
        if done < of // 2:
            with contextlib.suppress(ProcessLookupError):
                os.kill(first, signal.SIGKILL)

    files = [tmp_path / "points.npy", tmp_path / "answers.npy"]
    cluster.ask(client, blob, *files, chunk=2**14, tell=kill)
    assert first not in client.run(os.getpid).values()
    found = np.load(tmp_path / "answers.npy")
    wanted = meshsweep.load(blob).closest_point(points)
    assert found.tobytes() == wanted.tobytes() and cluster.CHUNK % 2**14 == 0
    # The points are 5 MB, the answers 13 MB.
    assert bytes_of_workers(client) - before < 60e6


def test_parts_are_built_as_in_one_process_and_refused_ones_are_named(
    cluster, client, tmp_path, fixtures
):
    (tmp_path / "broken.stl").write_text("no mesh")
    files = [fixtures / "bracket.stl", tmp_path / "broken.stl", fixtures / "groove.obj"]
    refused = cluster.build(client, files, tmp_path / "blobs", "closest")
    assert [Path(file).name for file, _ in refused] == ["broken.stl"]
    for file in [files[0], files[2]]:
        built = (tmp_path / "blobs" / file.with_suffix(".msw").name).read_bytes()
        assert built == bytes(meshsweep.build(file, "closest"))
