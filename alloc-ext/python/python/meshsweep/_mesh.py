"""The mesh of a caller, and progress as the caller wants it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import numbers
from ._meshsweep import BuildError


class Faces(Protocol):
    """An object with vertices and triangles, as `trimesh.Trimesh`."""

    @property
    def vertices(self) -> ArrayLike: ...
    @property
    def faces(self) -> ArrayLike: ...


Mesh = str | os.PathLike[str] | tuple[ArrayLike, ArrayLike] | Faces
OnProgress = Callable[[str, float], Any] | None
Progress = bool | OnProgress


def given(mesh: Any) -> str | tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """The file, or vertices and triangles, of whatever `build` takes."""
    if isinstance(mesh, (str, os.PathLike)):
        return os.fspath(mesh)
    if hasattr(mesh, "to_geometry") and not hasattr(mesh, "faces"):
        raise BuildError("a scene is no mesh: give scene.to_geometry()")
    pair = (mesh.vertices, mesh.faces) if hasattr(mesh, "faces") else mesh
    try:
        vertices, faces = pair
    except (TypeError, ValueError):
        text = "a mesh is a file, a pair of vertices and triangles, or has `vertices` and `faces`"
        raise BuildError(text) from None
    vertices = numbers(vertices, "vertices", BuildError)
    indices = numbers(faces, "triangles", BuildError)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise BuildError(f"vertices: shape (v, 3) is wanted, not {vertices.shape}")
    if indices.ndim != 2 or indices.shape[1] != 3:
        raise BuildError(f"triangles: shape (t, 3) is wanted, not {indices.shape}")
    if not np.issubdtype(indices.dtype, np.integer):
        raise BuildError(f"triangles: integers are wanted, not {indices.dtype}")
    if indices.size and (indices.min() < 0 or indices.max() > 0xFFFFFFFF):
        raise BuildError("triangles: a vertex number is negative or beyond 32 bits")
    vertices = np.require(vertices, np.float64, ["C", "A"])
    return vertices, np.require(indices, np.uint32, ["C", "A"])


def files(names: Iterable[str | os.PathLike[str]], what: str) -> list[str]:
    """Names of files."""
    if isinstance(names, (str, os.PathLike)):
        raise BuildError(f"{what}: a list of files is wanted, as [{os.fspath(names)!r}]")
    try:
        return [os.fsdecode(name) for name in names]
    except TypeError:
        raise BuildError(f"{what}: a list of files is wanted, not {names!r}") from None


class Bar:
    """Progress as a bar, or as the caller wants it."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._bar: Any = None

    def __enter__(self) -> OnProgress:
        if self._progress is not True:
            return self._progress or None
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
        except ImportError:
            return None
        self._bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}")
        return self._show

    def _show(self, stage: str, fraction: float) -> None:
        self._bar.set_description_str(stage, refresh=False)
        self._bar.update(fraction - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
