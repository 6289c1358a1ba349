r"""System parameters: ReadCfgData and WriteCfgData.

The path of an instance is "/EIO/EIO_SIGNAL/doGrip" with its name or, with \ListNo,
"/EIO/EIO_SIGNAL/Device/d652" with an attribute and its value; repeated calls return the matching
instances one after the other. Instances come from the SYSPAR folder of the backup. Values that a
program writes can be read back, but change nothing else in the run, as on a controller before its
restart.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "ReadCfgData",
"WriteCfgData".
"""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.language.annotations import (
    ArgumentType,
    CfgDomain,
    ConfiguredValue,
    Num,
    String,
    Var,
)
from rapidsim.language.controller import Controller
from rapidsim.language.equipment import Equipment
from rapidsim.language.error_numbers import (
    ERR_CFG_ILLTYPE,
    ERR_CFG_NOTFND,
    ERR_CFG_OUTOFBOUNDS,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.language.types import BOOL, NUM, STRING, Type, resolved
from rapidsim.library.table import routine, table
from rapidsim.library.text import dnum_text, parsed_number
from rapidsim.values import value_class

END_OF_LIST = -1.0
"""The constant of that name."""
_SWITCHES = {"true": True, "false": False}


@value_class(frozen=True, slots=True)
class _Instance:
    domain: str
    of: str
    number: int
    attributes: Mapping[str, str]


def read_cfg_data(
    controller: Equipment,
    instance_path: String,
    attribute: String,
    cfg_data: Var[ConfiguredValue],
    *,
    list_no: Var[Num] | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Read an attribute of a system parameter."""
    found = _instance_at(controller, instance_path, list_no)
    text = _text(found, instance_path, attribute)
    cfg_data.value = _value(text, of, f"{instance_path}, {attribute}")


def write_cfg_data(
    controller: Equipment,
    instance_path: String,
    attribute: String,
    cfg_data: ConfiguredValue,
    *,
    list_no: Var[Num] | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Change an attribute of a system parameter to a value of the same kind."""
    found = _instance_at(controller, instance_path, list_no)
    _value(_text(found, instance_path, attribute), of, f"{instance_path}, {attribute}")
    match cfg_data:
        case bool():
            text = "true" if cfg_data else "false"
        case float():
            text = dnum_text(cfg_data)
        case _:
            text = cfg_data
    controller.configure(found.domain, found.of, found.number, attribute, text)


def save_cfg_data(
    controller: Controller, file_path: String, domain: CfgDomain, *, file: String | None = None
) -> None:
    """Save system parameters to a file; a run has no parameters to save."""
    del domain
    named = file_path if file is None else f"{file_path}/{file}"
    controller.fidelity.not_simulated("SaveCfgData", f"{named} is not written")


def _instance_at(controller: Equipment, path: str, list_no: Reference[float] | None) -> _Instance:
    """Instance that a path names; with a list number, the next of several matches."""
    parts = [part for part in path.split("/") if part]
    if len(parts) not in (3, 4):
        raise rapid_error(ERR_CFG_NOTFND, f"`{path}` is not a path such as /EIO/EIO_SIGNAL/doGrip")
    domain, of, *rest = parts
    key, wanted = ("name", rest[0]) if len(rest) == 1 else (rest[0].lower(), rest[1])
    instances = controller.instances(domain, of)
    if instances is None:
        raise rapid_error(
            ERR_CFG_NOTFND,
            f"the station has no system parameters /{domain}/{of}; a backup's SYSPAR has them",
        )
    fitting = [
        _Instance(domain, of, number, one)
        for number, one in enumerate(instances)
        if one.get(key, "").lower() == wanted.lower()
    ]
    if not fitting:
        raise rapid_error(ERR_CFG_NOTFND, f"no instance is {path}")
    if list_no is None:
        return fitting[0]
    number = int(list_no.value)
    if not 0 <= number < len(fitting):
        raise rapid_error(
            ERR_CFG_OUTOFBOUNDS, f"{path} has {len(fitting)} instances; number {number} is not one"
        )
    list_no.value = END_OF_LIST if number + 1 == len(fitting) else float(number + 1)
    return fitting[number]


def _text(instance: _Instance, path: str, attribute: str) -> str:
    text = instance.attributes.get(attribute.lower())
    if text is None:
        raise rapid_error(ERR_CFG_NOTFND, f"{path} says nothing of {attribute}")
    return text


def _value(text: str, of: Type, subject: str) -> object:
    """Value of a RAPID type that a text of the configuration represents."""
    wanted = resolved(of)
    value = (
        text
        if wanted == STRING
        else _SWITCHES.get(text.lower())
        if wanted == BOOL
        else parsed_number(text)
    )
    if value is None:
        raise rapid_error(ERR_CFG_ILLTYPE, f"{subject} is `{text}`, which is no {of.name}")
    return value


CONFIGURATION = table(
    routine("ReadCfgData", read_cfg_data, r"InstancePath Attribute CfgData \ListNo"),
    routine("WriteCfgData", write_cfg_data, r"InstancePath Attribute CfgData \ListNo"),
    routine(
        "SaveCfgData",
        save_cfg_data,
        r"FilePath \File Domain",
        treated_as="the file is not written",
    ),
)
