# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Calls the library beside this file, whose interface is python/native/Binding.h."""

import ctypes
import json
import os
import pathlib
import threading
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_DONE, _WRONG_VALUE, _OUT_OF_MEMORY, _STOPPED, _FAILED = range(5)
_ERRORS = {_WRONG_VALUE: ValueError, _OUT_OF_MEMORY: MemoryError, _FAILED: RuntimeError}

# Of progress and of asking for signals where the system does not wake this thread by itself.
_SECONDS_BETWEEN_LOOKS = 0.05


class _Array(ctypes.Structure):
    _fields_ = [
        ("values", ctypes.c_void_p),
        ("type", ctypes.c_char_p),
        ("dimension", ctypes.c_int64),
        ("size", ctypes.c_int64 * 3),
        ("spacing", ctypes.c_double * 3),
    ]


class _Control(ctypes.Structure):
    _fields_ = [("done", ctypes.c_double), ("stop", ctypes.c_int32)]


class _Outputs(ctypes.Structure):
    _names = ("labels", "thickness", "uncertainty", "importance", "vectors", "distance", "objects", "walls")
    _fields_ = [(name, ctypes.c_void_p) for name in _names]


class _Mesh(ctypes.Structure):
    _fields_ = [
        ("points", ctypes.c_void_p),
        ("thickness", ctypes.c_void_p),
        ("faces", ctypes.c_void_p),
        ("number_of_points", ctypes.c_int64),
        ("number_of_faces", ctypes.c_int64),
        ("corners_per_face", ctypes.c_int64),
    ]


def _load() -> ctypes.CDLL:
    folder = pathlib.Path(__file__).parent
    names = [folder / f"_medialvoxel.{ending}" for ending in ("so", "dylib", "dll")]
    path = next((name for name in names if name.exists()), None)
    if path is None:
        raise ImportError(f"{folder} has no library _medialvoxel; install the wheel medialvoxel, or build the project")
    library = ctypes.CDLL(os.fspath(path))
    pointer = ctypes.POINTER
    library.medialvoxel_run.argtypes = [
        pointer(_Array),
        pointer(ctypes.c_char_p),
        ctypes.c_int32,
        pointer(_Outputs),
        pointer(_Control),
    ]
    library.medialvoxel_run.restype = ctypes.c_void_p
    library.medialvoxel_status.argtypes = [ctypes.c_void_p]
    library.medialvoxel_status.restype = ctypes.c_int32
    library.medialvoxel_text.argtypes = [ctypes.c_void_p]
    library.medialvoxel_text.restype = ctypes.c_char_p
    library.medialvoxel_mesh.argtypes = [ctypes.c_void_p, pointer(_Mesh)]
    library.medialvoxel_mesh.restype = None
    library.medialvoxel_release.argtypes = [ctypes.c_void_p]
    library.medialvoxel_release.restype = None
    library.medialvoxel_version.restype = ctypes.c_char_p
    library.medialvoxel_layout.restype = ctypes.c_int64
    layout = 0
    for structure in (_Array, _Control, _Outputs, _Mesh):
        layout = layout << 8 | ctypes.sizeof(structure)
    if library.medialvoxel_layout() != layout:
        raise ImportError(f"{path} is of another version than this package; install the wheel medialvoxel again")
    return library


_library = _load()


def version() -> str:
    """The version of the library."""
    return _library.medialvoxel_version().decode()


def _take_mesh(result: int) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    mesh = _Mesh()
    _library.medialvoxel_mesh(result, mesh)

    def copy(address: int | None, dtype: type, shape: tuple[int, ...]) -> NDArray[Any]:
        array = np.empty(shape, dtype)
        if array.size and address:
            ctypes.memmove(array.ctypes.data, address, array.nbytes)
        return array

    return (
        copy(mesh.points, np.float64, (mesh.number_of_points, 3)),
        copy(mesh.faces, np.int64, (mesh.number_of_faces, mesh.corners_per_face)),
        copy(mesh.thickness, np.float32, (mesh.number_of_points,)),
    )


def _watch(finished: threading.Event, control: _Control, progress: Callable[[float], object] | None) -> None:
    """Waits for the work. An exception here, such as that of Ctrl-C, stops it first."""
    try:
        # Not Thread.join(), which takes a thread for ended when Ctrl-C interrupts it.
        while not finished.wait(_SECONDS_BETWEEN_LOOKS):
            if progress is not None:
                progress(min(control.done, 1.0))
        if progress is not None:
            progress(1.0)
    except BaseException:
        control.stop = 1
        finished.wait()
        raise


def run(
    array: NDArray[Any],
    spacing: Sequence[float],
    arguments: Sequence[str],
    outputs: dict[str, NDArray[Any] | None],
    progress: Callable[[float], object] | None,
) -> tuple[dict[str, Any], tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]:
    """Runs a command of the program on an array of 2 or 3 axes and of native numbers without gaps.

    The lock of the interpreter is free meanwhile. Returns numbers of the run, and the parts of the mesh."""
    described = _Array(
        array.ctypes.data,
        array.dtype.name.encode(),
        array.ndim,
        (ctypes.c_int64 * 3)(*(array.shape[::-1] + (1,))[:3]),
        (ctypes.c_double * 3)(*(tuple(spacing)[::-1] + (1.0,))[:3]),
    )
    words = [argument.encode() for argument in arguments]
    places = _Outputs(**{name: place.ctypes.data for name, place in outputs.items() if place is not None})
    control = _Control()
    results: list[int | None] = []
    finished = threading.Event()

    def work(*kept: Any) -> None:
        # The arrays are arguments so that they live as long as the work, also when an exception ends the caller first.
        try:
            results.append(
                _library.medialvoxel_run(described, (ctypes.c_char_p * len(words))(*words), len(words), places, control)
            )
        finally:
            finished.set()

    try:
        threading.Thread(target=work, args=(array, outputs), name="medialvoxel", daemon=True).start()
        _watch(finished, control, progress)
        result = results[0] if results else None
        if result is None:
            raise MemoryError("out of memory")
        text = _library.medialvoxel_text(result).decode()
        status = _library.medialvoxel_status(result)
        if status != _DONE:
            raise _ERRORS.get(status, RuntimeError)(text)
        return json.loads(text), _take_mesh(result)
    finally:
        if results and results[0] is not None:
            _library.medialvoxel_release(results[0])
