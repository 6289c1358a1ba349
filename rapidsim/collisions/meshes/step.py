"""STEP files: triangles that OpenCASCADE finds on their surfaces (`rapidsim[step]`).

It is written for files of CAD programs, and damaged ones may crash it or keep it busy indefinitely.
So it works in a process of its own, whose time and memory are limited; its answer is a glTF file.
"""

from __future__ import annotations

import subprocess
import sys

from rapidsim.collisions.meshes.gltf import read_gltf
from rapidsim.collisions.meshes.triangles import Faces
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.frames.transform import Array

TOLERANCE_MM = 0.1
"""Largest distance [mm] of a triangle from the surface that it approximates."""
_MOST_S = 60
_MOST_BYTES = 4_000_000_000
_CONVERSION = f"""
import os, sys
answer = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)
if sys.platform == "linux":
    import resource
    resource.setrlimit(resource.RLIMIT_AS, ({_MOST_BYTES}, {_MOST_BYTES}))
import cascadio
answer.write(cascadio.load(sys.stdin.buffer.read(), "step", {TOLERANCE_MM}, use_parallel=False))
"""
"""The program of the process: messages of the library must not mix with its answer."""


def read_step(name: str, data: bytes) -> tuple[Array, Faces]:
    """Return vertices (k, 3) [m] and faces (f, 3) of all solids and surfaces.

    Raises:
        InputError: If cascadio is not installed, or the data are not STEP, damaged, or too large.
    """
    require("cascadio", f"reading {name}")
    try:
        ended = subprocess.run(
            [sys.executable, "-P", "-c", _CONVERSION],
            input=data,
            capture_output=True,
            timeout=_MOST_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise InputError(
            f"{name} is not converted within {_MOST_S} s", "export it as STL, or with less detail"
        ) from None
    if ended.returncode or not ended.stdout:
        raise InputError(f"{name} is not a readable STEP file")
    return read_gltf(name, ended.stdout, lambda _: b"")
