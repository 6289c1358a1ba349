"""Meanings of the codes of refusals."""

from __future__ import annotations

from types import MappingProxyType
from typing import Final

from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources import codes
from rapidsim.server.resources.codes import BAD_PARAMETER, refused
from rapidsim.server.resources.context import RequestContext

_NAMES: Final = MappingProxyType(
    {
        codes.NOT_HELD[1]: "SYS_CTRL_E_MASTER_REJECT",
        codes.NOT_ALLOWED[1]: "SYS_CTRL_E_UAS_REJECT",
        codes.LATER_NO_SYMBOL[1]: "SYS_CTRL_E_NO_SUCH_SYMBOL",
    }
)
"""The names that are public; others are shown as hexadecimal codes."""
_DESCRIPTIONS: Final = MappingProxyType(
    {
        codes.NOT_FOUND[1]: "The resource was not found.",
        codes.NO_SIGNAL[1]: "There is no such signal.",
        codes.BAD_PARAMETER[1]: "A parameter of the request is missing or wrong.",
        codes.BAD_STATE[1]: "The operation is not allowed in this state.",
        codes.HELD_BY_ANOTHER[1]: "The requested resource is held by someone else.",
        codes.NOT_HELD[1]: "The user does not have the required mastership.",
        codes.NOT_ALLOWED[1]: "The user is not allowed access.",
        codes.READ_ONLY[1]: "The operation was rejected.",
        codes.LATER_NO_SYMBOL[1]: "There is no such symbol or module.",
        codes.LATER_NO_MODULE[1]: "The name of a module is missing or wrong.",
        codes.LATER_NO_FILE[1]: "The path does not exist.",
        codes.LATER_NO_VOLUME[1]: "There is no such disk.",
        codes.NO_FILE_TO_LOAD[1]: "The file cannot be loaded.",
    }
)


def return_codes(context: RequestContext, request: Request) -> Answer:
    """The meaning of a code, or of all that this controller returns.

    Raises:
        RefusedRequest: If the code is none of them.
    """
    del context
    if "code" not in request.query:
        return Answer(resources=tuple(_item("err-desc-li", code) for code in _DESCRIPTIONS))
    text = request.query["code"]
    for code in _DESCRIPTIONS:
        if text == str(code):
            return Answer((_item("err-desc", code),))
    raise refused(BAD_PARAMETER, f"the code {text} is not known")


def _item(kind: str, code: int) -> Item:
    fields = {
        "name": _NAMES.get(code, f"{code & 0xFFFFFFFF:X}"),
        "code": str(code),
        "severity": "Error",
        "description": _DESCRIPTIONS[code],
    }
    return Item(kind, str(code), fields)
