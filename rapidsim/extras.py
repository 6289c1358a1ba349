"""Optional packages, and the `pip install` command for each."""

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
        "mcp": "mcp",
        "pygls": "edit",
        "cascadio": "step",
    }
)
"""Extra that installs a package."""


def is_installed(package: str) -> bool:
    """Whether a package is installed; it is not imported."""
    return find_spec(package) is not None


def pip_install(package: str) -> str:
    """Command that installs a package, with quotes that work in every shell."""
    return f'pip install "rapidsim[{EXTRAS[package]}]"'


def require(package: str, subject: str) -> None:
    """Raise if a package is not installed.

    Args:
        package: Its import name.
        subject: The feature that needs it.

    Raises:
        InputError: If it is not installed; the help is the command that installs it.
    """
    if not is_installed(package):
        raise InputError(f"{subject} needs {package}, which is not installed", pip_install(package))
