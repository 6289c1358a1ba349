"""Controller options with RAPID routines that the library does not have.

No file of a backup contains the declarations of their modules, so an unknown name may be declared
there. A controller's options are the products in `BACKINFO/backinfo.txt`.

Sources: a public backup with 642-2 Palletizing PowerPac, whose programs use PM_ data and types
that no file of it declares; and the RAPID syntax file for Vim of KnoP, which lists the instructions
of the other options here in separate groups, none of them in the library. The wording of products
in a backup is confirmed for 812-1 Production Manager only. All other options of 15 public backups,
some 45 from 602-1 to 1341-1, add no name that their programs use and the library lacks.
"""

from __future__ import annotations

from collections.abc import Sequence

_NOT_KNOWN = (
    "pickmaster",
    "palletizing powerpac",
    "force control",
    "assembly fc",
    "machining fc",
    "dispense",
    "discrete application",
    "paint",
    "bullseye",
    "production manager",
)
"""Words of the options' names, folded."""


def unknown_options(products: Sequence[str]) -> tuple[str, ...]:
    """Return a description for each of those options, in place of the names of its modules.

    Args:
        products: The products of a backup as listed.
    """
    return tuple(
        f"modules of the option {product}"
        for product in products
        if any(word in product.lower() for word in _NOT_KNOWN)
    )
