"""Patch layouts of triangle meshes along their ridges and valleys.

    import numpy as np, intarsia
    r = intarsia.layout(V, F, patches=60)   # V: (n, 3) positions, F: (m, 3) triangles
    r.labels                                # (m,) patch of every triangle
    r.curves.nodes, r.curves.edges          # the curves, as polyscope takes them
    r.patches["area"], r.report["hash"]

All calls let other threads run, can be interrupted with Ctrl-C and give the same bits with any number of threads.
Lengths are in the units of V. Arrays are not copied on the way in if they are C-ordered float64 and int32 or int64.
"""

from __future__ import annotations

import json
import warnings
from typing import Any, Callable, Iterable, Mapping, Optional, Union

import numpy as np

from . import _core
from .results import (ARC_KINDS, Curves, Distance, Evaluation, Features, Layout, Rebuilt)

__version__: str = _core.version
__all__ = ["ARC_KINDS", "Cancelled", "Curves", "Distance", "Evaluation", "Features", "IntarsiaWarning", "Layout",
           "Rebuilt", "RejectedMesh", "distance", "evaluate", "features", "layout", "method_options"]

ProgressFunction = Callable[[str, float], Optional[bool]]


class RejectedMesh(ValueError):
    """The arrays are well-formed, but no surface that the method can take. `element`: triangle or vertex, or -1."""

    element: int = -1


class Cancelled(Exception):
    """The progress function returned False."""


class IntarsiaWarning(UserWarning):
    """There is a layout, but not all that was asked for: a guarantee does not hold, or the time limit came first."""


_OK, _DEGRADED, _SHORTENED, _BAD, _REJECTED, _TOO_LARGE, _NO_MEMORY, _NO_TIME, _CANCELLED = range(9)


def _result(answer: tuple) -> dict:
    """The value, or what the status says as an exception."""
    status, value = answer
    code, message = status["code"], status["message"]
    if status["stage"]:
        message = status["stage"] + ": " + message
    if code == _OK:
        return value
    if code in (_DEGRADED, _SHORTENED):
        warnings.warn(message, IntarsiaWarning, stacklevel=3)
        return value
    if code == _BAD:
        raise ValueError(message)
    if code == _REJECTED:
        error = RejectedMesh(message)
        error.element = status["element"]
        raise error
    if code in (_TOO_LARGE, _NO_MEMORY):
        raise MemoryError(message)
    if code == _NO_TIME:
        raise TimeoutError(message)
    if code == _CANCELLED:
        raise Cancelled(message)
    raise RuntimeError(message)


def _positions(V: Any, name: str = "V") -> np.ndarray:
    array = np.asarray(V)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have shape (n, 3), not {array.shape}")
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name} must hold numbers, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def _triangles(F: Any, name: str = "F") -> np.ndarray:
    array = np.asarray(F)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have shape (m, 3), not {array.shape}: triangles only")
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name} must hold whole numbers, not {array.dtype}")
    wanted = np.int32 if array.dtype == np.int32 else np.int64
    return np.ascontiguousarray(array, dtype=wanted)


def _labels(values: Any, name: str) -> np.ndarray:
    array = np.asarray(values)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise ValueError(f"{name} must be one whole number per triangle")
    return np.ascontiguousarray(array, dtype=np.int32)


def _choice(value: str, choices: tuple, name: str) -> int:
    if value not in choices:
        raise ValueError(f"{name} must be one of {', '.join(choices)}, not {value!r}")
    return choices.index(value)


def _length(value: Union[None, str, float]) -> str:
    return "" if value is None else value if isinstance(value, str) else repr(float(value))


def _options(patches: Optional[int], min_feature: Union[None, str, float], mode: str, subdivide: str, threads: int,
             seed: int, max_memory: int, time_limit: float, strict: bool, options: Optional[Mapping[str, float]]) -> dict:
    return {
        "patches": int(patches or 0), "min_feature": _length(min_feature), "tolerance": "", "curves": [], "pins": [],
        "mode": _choice(mode, ("robust", "paper"), "mode"),
        "subdivide": _choice(subdivide, ("automatic", "faithful", "compact", "quality"), "subdivide"),
        "threads": int(threads), "seed": int(seed), "max_memory": int(max_memory), "time_limit": float(time_limit),
        "strict": bool(strict), "method": {str(k): float(v) for k, v in (options or {}).items()},
    }


def layout(V: Any, F: Any, patches: Optional[int] = None, *, tolerance: Union[None, str, float] = None,
           min_feature: Union[None, str, float] = None, curves: Iterable[Any] = (), pins: Any = None,
           mode: str = "robust", subdivide: str = "automatic", threads: int = 0, seed: int = 0, max_memory: int = 0,
           time_limit: float = 0, strict: bool = False, options: Optional[Mapping[str, float]] = None,
           progress: Optional[ProgressFunction] = None) -> Layout:
    """A patch layout of a triangle mesh.

    V            (n, 3) positions
    F            (m, 3) triangles: vertex numbers, counter-clockwise from outside. What is no oriented 2-manifold is
                 mended; `Layout.remarks` says what
    patches      wanted number of patches; None: automatic
    tolerance    instead of a number: as few patches as rebuild the surface from their borders so well (RMS), such as
                 "0.2%" (of the diagonal), 0.01 (units of V) or "0.1e" (mean edges)
    min_feature  smaller details get no patches: a length of the same forms
    curves       (p, 3) arrays of points on or near the surface: curves that become borders as they are
    pins         (m,) regions that stay patches as they are: a number per triangle, negative where it is free
    mode         "robust", or "paper": the letter of Cao, Yan, Wonka 2014
    subdivide    "automatic", "compact", "quality" (nearer to the surface, more winding) or "faithful" (the paper's)
    threads      that compute; 0: every allowed processor. Results do not depend on it
    seed         of the random seeds in paper mode
    max_memory   bytes; a mesh that would need more, by forecast, raises MemoryError at once
    time_limit   seconds; what only improves a layout is left out then (IntarsiaWarning, `Layout.shortened`)
    strict       refuse what would have to be mended
    options      options of the method by name, such as {"smooth.iterations": 20}; see method_options()
    progress     called with the name of the running stage and the fraction of the whole, in this thread, about ten
                 times a second; return False to cancel

    Raises ValueError for arguments that make no sense, RejectedMesh (a ValueError), MemoryError, TimeoutError if the
    time limit came before there was a layout, Cancelled, and whatever `progress` or a signal handler raises.
    """
    V, F = _positions(V), _triangles(F)
    given = _options(patches, min_feature, mode, subdivide, threads, seed, max_memory, time_limit, strict, options)
    given["tolerance"] = _length(tolerance)
    given["curves"] = [_positions(c, "curves").ravel().tolist() for c in curves]
    if pins is not None:
        given["pins"] = _labels(pins, "pins").tolist()
    return Layout(_result(_core.layout(V, F, given, progress)))


def features(V: Any, F: Any, *, min_feature: Union[None, str, float] = None, mode: str = "robust", threads: int = 0,
             max_memory: int = 0, time_limit: float = 0, strict: bool = False,
             options: Optional[Mapping[str, float]] = None, progress: Optional[ProgressFunction] = None) -> Features:
    """Scale, curvature and extremality of every vertex. Arguments and exceptions as in layout()."""
    V, F = _positions(V), _triangles(F)
    given = _options(None, min_feature, mode, "automatic", threads, 0, max_memory, time_limit, strict, options)
    return Features(**_result(_core.features(V, F, given, progress)))


def distance(VA: Any, FA: Any, VB: Any, FB: Any, *, samples: int = 1_000_000, keep_samples: bool = False,
             threads: int = 0, progress: Optional[ProgressFunction] = None) -> Distance:
    """How far two triangle meshes are apart, both ways: largest, mean and root mean square over the area.

    samples       on both together; every triangle gets at least one
    keep_samples  also return every sample on A (`sample_point`, `sample_distance`, `sample_triangle`)

    Raises as layout().
    """
    return Distance(**_result(_core.distance(_positions(VA, "VA"), _triangles(FA, "FA"), _positions(VB, "VB"),
                                             _triangles(FB, "FB"), int(samples), bool(keep_samples), int(threads),
                                             progress)))


def evaluate(V: Any, F: Any, layout: Any, *, samples: int = 1_000_000, triangulated: bool = True,
             transfinite: bool = True, filled: bool = True, smooth: bool = False, threads: int = 0,
             progress: Optional[ProgressFunction] = None) -> Evaluation:
    """How well curves alone describe the surface: it is rebuilt from them in three ways and compared with the mesh.

    layout   what layout() returned for this mesh, or (m,) labels of any kind: then connected pieces of equal labels are
             patches
    smooth   with labels: smooth their borders as layout() does

    Raises as layout(); ValueError also if mesh and layout do not fit together.
    """
    V, F = _positions(V), _triangles(F)
    given = {"samples": int(samples), "triangulated": bool(triangulated), "transfinite": bool(transfinite),
             "filled": bool(filled), "smooth": bool(smooth), "threads": int(threads)}
    if isinstance(layout, Layout):
        if smooth:
            raise ValueError("smooth is for labels: the curves of a layout are smooth")
        answer = _core.evaluate_layout(V, F, layout, given, progress)
    else:
        answer = _core.evaluate_labels(V, F, _labels(layout, "layout, if it is no Layout,"), given, progress)
    value = _result(answer)
    for name in ("triangulated", "transfinite", "filled"):
        value[name] = value[name] and Rebuilt(**value[name])
    value["report"] = json.loads(value["report"])
    return Evaluation(**value)


def method_options(mode: str = "robust") -> dict:
    """The options of the method: name -> {"value", "least", "most", "whole", "help"}."""
    keys = ("value", "least", "most", "whole", "help")
    return {o[0]: dict(zip(keys, o[1:])) for o in _core.method_options(_choice(mode, ("robust", "paper"), "mode"))}
