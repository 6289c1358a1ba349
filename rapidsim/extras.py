"""Packages that not everybody needs, and which `pip install` brings them."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from types import MappingProxyType

from rapidsim.files import InputError

# `[project.optional-dependencies]` of pyproject.toml, by the name that is imported.
EXTRAS: Mapping[str, str] = MappingProxyType(
    {
        "rerun": "view",
        "yourdfpy": "urdf",
        "scipy": "solvers",
        "pyarrow": "parquet",
        "matplotlib": "plots",
        "numba": "fast",
        "aiohttp": "serve",
        "cryptography": "serve",
    }
)
"""The extra that brings a package."""


def is_installed(package: str) -> bool:
    """Whether a package is there; it is not imported."""
    return find_spec(package) is not None


def pip_install(package: str) -> str:
    """The command that brings a package, in the quotes that every shell understands."""
    return f'pip install "rapidsim[{EXTRAS[package]}]"'


def require(package: str, subject: str) -> None:
    """Refuse what needs a package that is not installed.

    Args:
        package: As it is imported.
        subject: Needs it.

    Raises:
        InputError: If it is not installed; the help is the command that brings it.
    """
    if not is_installed(package):
        raise InputError(f"{subject} needs {package}, which is not installed", pip_install(package))
