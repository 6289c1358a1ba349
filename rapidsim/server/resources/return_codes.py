"""Meanings of the codes of refusals."""

from __future__ import annotations

from types import MappingProxyType
from typing import Final

from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources import codes
from rapidsim.server.resources.codes import BAD_PARAMETER, refused
from rapidsim.server.resources.context import RequestContext

_MEANINGS: Final = MappingProxyType(
    {
        codes.NOT_FOUND[1]: ("FAIL", "The request failed; often there is no such resource."),
        codes.NO_SIGNAL[1]: ("UNRESOLVED_URL", "There is no such signal."),
        codes.BAD_PARAMETER[1]: ("INVALIDARG", "A parameter of the request is missing or wrong."),
        codes.BAD_STATE[1]: ("EXEC_STATE", "The execution state does not allow the operation."),
        codes.HELD_BY_ANOTHER[1]: ("RESOURCE_HELD", "Another client holds the resource."),
        codes.NOT_HELD[1]: ("MASTER_REJECT", "The client does not have the mastership it needs."),
        codes.NOT_ALLOWED[1]: ("UAS_REJECT", "The user is not allowed to do this."),
        codes.READ_ONLY[1]: ("REJECT", "Access to the resource is restricted."),
        codes.LATER_NO_SYMBOL[1]: ("NO_SUCH_SYMBOL", "There is no such symbol or module."),
        codes.LATER_NO_MODULE[1]: ("MOD_AMBNAME", "The name of a module is missing or wrong."),
        codes.LATER_NO_FILE[1]: ("DIR_NOT_EXIST", "The path does not exist."),
        codes.LATER_NO_VOLUME[1]: ("INVALID_PATH", "There is no such disk."),
        codes.NO_FILE_TO_LOAD[1]: ("FILE_NOT_FOUND", "The file cannot be loaded."),
    }
)
"""Name, without the prefix of all, and description of each code."""
_PREFIX: Final = "SYS_CTRL_E_"


def return_codes(context: RequestContext, request: Request) -> Answer:
    """The meaning of a code, or of all that this controller returns.

    Raises:
        RefusedRequest: If the code is none of them.
    """
    del context
    if "code" not in request.query:
        return Answer(resources=tuple(_item("err-desc-li", code) for code in _MEANINGS))
    text = request.query["code"]
    for code in _MEANINGS:
        if text == str(code):
            return Answer((_item("err-desc", code),))
    raise refused(BAD_PARAMETER, f"the code {text} is not known")


def _item(kind: str, code: int) -> Item:
    name, description = _MEANINGS[code]
    fields = {
        "name": f"{_PREFIX}{name}",
        "code": str(code),
        "severity": "Error",
        "description": description,
    }
    return Item(kind, str(code), fields)
