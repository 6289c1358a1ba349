r"""Systems of equations and factors of matrices, in double precision.

`A` is {m,n}; \A_m and \A_n select its first rows and columns.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "MatrixSolve",
"MatrixSolveQR", "MatrixSVD".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from rapidsim.language.annotations import Dnum, Num, ParameterMode, Switch
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_ARRAY_SIZE, rapid_error
from rapidsim.library.table import routine, table

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array

Rows = Annotated[list[list[Dnum]], ParameterMode.VAR]
Values = Annotated[list[Dnum], ParameterMode.VAR]


def matrix_solve(
    a: list[list[Dnum]],
    b: list[Dnum],
    x: Values,
    *,
    a_m: Num | None = None,
    a_n: Num | None = None,
) -> None:
    """Solve A x = b; with more equations than unknowns, with least squares of the residuals.

    Raises:
        RapidError: ERR_ARRAY_SIZE for sizes that do not fit, ERR_ARGVALERR without a unique
            solution.
    """
    import numpy as np

    matrix = _matrix(a, a_m, a_n)
    m, n = matrix.shape
    if m < n or len(b) < m or len(x) < n:
        raise rapid_error(
            ERR_ARRAY_SIZE, f"{m} equations, {n} unknowns, {len(b)} values in b, {len(x)} in x"
        )
    solution, _, rank, _ = np.linalg.lstsq(matrix, np.array(b[:m]), rcond=None)
    if rank < n:
        raise rapid_error(
            ERR_ARGVALERR, f"the {n} unknowns have no one solution: the matrix has rank {rank}"
        )
    x[:n] = [float(value) for value in solution]


def matrix_solve_qr(
    a: list[list[Dnum]],
    q: Rows,
    r: Rows,
    *,
    a_m: Num | None = None,
    a_n: Num | None = None,
) -> None:
    """A = Q R, Q orthogonal {m,m} and R {m,n} with zeros below its diagonal, which is positive."""
    import numpy as np

    orthogonal, upper = np.linalg.qr(_matrix(a, a_m, a_n), mode="complete")
    signs = np.ones(len(orthogonal))
    diagonal = np.diagonal(upper)
    signs[: len(diagonal)] = np.where(diagonal < 0.0, -1.0, 1.0)
    _fill(q, orthogonal * signs, "Q")
    _fill(r, signs[:, None] * upper, "R")


def matrix_svd(
    a: list[list[Dnum]],
    u: Rows,
    s: Values,
    v: Rows,
    *,
    a_m: Num | None = None,
    a_n: Num | None = None,
    econ: Switch = False,
) -> None:
    r"""A = U diag(S) V', the singular values from the largest down; with \Econ U is {m,n}."""
    import numpy as np

    left, values, right = np.linalg.svd(_matrix(a, a_m, a_n), full_matrices=not econ)
    if len(s) < len(values):
        raise rapid_error(ERR_ARRAY_SIZE, f"{len(values)} singular values, {len(s)} in S")
    _fill(u, left, "U")
    _fill(v, right.T, "V")
    s[: len(values)] = [float(value) for value in values]


def _matrix(a: list[list[float]], a_m: float | None, a_n: float | None) -> Array:
    """Selected rows and columns of a matrix, shape (m, n)."""
    import numpy as np

    rows, columns = len(a), len(a[0])
    m = rows if a_m is None else int(a_m)
    n = columns if a_n is None else int(a_n)
    if not (1 <= m <= rows and 1 <= n <= columns):
        raise rapid_error(ERR_ARRAY_SIZE, f"{m} x {n} of a matrix that is {rows} x {columns}")
    return np.array(a, dtype=np.float64)[:m, :n]


def _fill(target: list[list[float]], matrix: Array, name: str) -> None:
    """Copy a matrix into the first rows and columns of an array."""
    rows, columns = matrix.shape
    if len(target) < rows or len(target[0]) < columns:
        raise rapid_error(
            ERR_ARRAY_SIZE,
            f"{name} is {rows} x {columns}; the array is {len(target)} x {len(target[0])}",
        )
    for row, values in zip(target, matrix.tolist(), strict=False):
        row[:columns] = values


_SIZE = r"A \A_m \A_n"

MATRICES = table(
    routine("MatrixSolve", matrix_solve, f"{_SIZE} b x"),
    routine("MatrixSolveQR", matrix_solve_qr, f"{_SIZE} Q R"),
    routine("MatrixSVD", matrix_svd, rf"{_SIZE} U S V \Econ"),
)
