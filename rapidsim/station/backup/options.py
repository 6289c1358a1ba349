"""Options of a controller that bring RAPID of their own which the library does not have.

What their modules declare stands in no file of a backup, so a name of a program may be theirs.
The options that a controller has are the products in `BACKINFO/backinfo.txt`.

Source: Product specification Controller software IRC5 (3HAC050945), the options with RAPID
instructions and data; those that are not named here bring nothing, or what the library knows.
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
    "bullseye",
    "production manager",
)
"""Words of their names, folded."""


def unknown_options(products: Sequence[str]) -> tuple[str, ...]:
    """What stands for the modules of those options, in words.

    Args:
        products: The products of a backup as they are listed.
    """
    return tuple(
        f"modules of the option {product}"
        for product in products
        if any(word in product.lower() for word in _NOT_KNOWN)
    )
