"""Changes between two configurations: system parameters, options, station files.

Instances of a type are matched by name, those without a name by their attributes. Their order, the
layout of a file and the notation of numbers are not changes.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from rapidsim.applications.diff.cell_configuration import CellConfiguration
from rapidsim.applications.diff.changes import ConfigurationChange
from rapidsim.applications.diff.station_changes import station_changes
from rapidsim.controller.cell.description import mapped_bits
from rapidsim.language.equipment import Configured
from rapidsim.values import value_class

_Attributes = Mapping[str, str]

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_QUATERNION = re.compile(r"(.*)_u([0-3])")
_UNITS = (
    (re.compile(r"base_frame_pos_[xyz]|.*mass_centre_[xyz]"), "mm", 1e3),
    (re.compile(r"(cal|calib|com)_offset|gravity_(alpha|beta)"), "deg", math.degrees(1.0)),
    (re.compile(r".*inertia_[xyz]"), "kgm2", 1.0),
    (re.compile(r"(.*_)?mass"), "kg", 1.0),
    (re.compile(r"speed_absolute_max"), "rad/s", 1.0),
    (re.compile(r"filt(er)?(active|passive)"), "ms", 1.0),
)
"""Units of attributes, and factors on the numbers of a file."""
_BOUNDS = re.compile(r"(upper|lower)_(joint|check_point)_bound.*")
_MAPS = ("devicemap", "unitmap")
_SLIDING = ("TRACK", "EXT_LIN", "FREE_LIN")
_SAME_TURN_DEG = 1e-6
_MOST_COMPARED = 1_000_000
"""Number of pairs of unnamed instances above which they count as new and removed."""


def configuration_changes(
    old: CellConfiguration, new: CellConfiguration
) -> tuple[ConfigurationChange, ...]:
    """Return all changes between the parts that both sides have."""
    changes: list[ConfigurationChange] = []
    if old.parameters and new.parameters:
        changes += _parameter_changes(old.parameters, new.parameters)
        changes += _product_changes(old.products, new.products)
    return (*changes, *station_changes(old.station, new.station))


def _parameter_changes(old: Configured, new: Configured) -> Iterator[ConfigurationChange]:
    for domain in sorted({*old, *new}):
        a, b = old.get(domain, {}), new.get(domain, {})
        sliding = _sliding_arms(a) | _sliding_arms(b)
        for kind in dict.fromkeys((*a, *b)):
            before = [_instance(kind, one, sliding) for one in a.get(kind, ())]
            after = [_instance(kind, one, sliding) for one in b.get(kind, ())]
            yield from _type_changes(domain, kind, before, after)


@value_class(frozen=True, slots=True)
class _Value:
    """Value of an attribute."""

    text: str
    unit: str
    key: object
    """Equal for equivalent values."""


@value_class(frozen=True, slots=True)
class _Instance:
    name: str | None
    values: Mapping[str, _Value]
    """By folded attribute."""
    written: Mapping[str, str]
    """Attributes as they are written, by folded attribute."""

    @property
    def content(self) -> object:
        """Equal for equivalent instances, in any order of attributes."""
        return frozenset((attribute, value.key) for attribute, value in self.values.items())

    @property
    def text(self) -> str:
        """All attributes except the name."""
        parts = (
            f"{self.written[key]} {value.text}{_unit(value.unit)}"
            for key, value in self.values.items()
            if key != "name"
        )
        return ", ".join(parts) or "no attributes"


def _unit(unit: str) -> str:
    return f" {unit}" if unit else ""


def _instance(kind: str, attributes: _Attributes, sliding: set[str]) -> _Instance:
    name = attributes.get("name")
    slides = kind == "ARM" and (name or "").lower() in sliding
    values: dict[str, _Value] = {}
    written: dict[str, str] = {}
    quaternions: dict[str, list[float]] = {}
    for attribute, text in attributes.items():
        key = attribute.lower()
        turned = _QUATERNION.fullmatch(key)
        if turned is not None and _NUMBER.fullmatch(text):
            parts = quaternions.setdefault(turned[1], [0.0] * 4)
            parts[int(turned[2])] = float(text)
            written.setdefault(turned[1], attribute[: -len("_u0")])
        else:
            values[key] = _value(key, text, slides=slides)
            written[key] = attribute
    for key, parts in quaternions.items():
        text = f"[{','.join(f'{one:.9g}' for one in parts)}]"
        values[key] = _Value(text, "", tuple(parts))
    return _Instance(name, values, written)


def _value(key: str, text: str, *, slides: bool) -> _Value:
    if key in _MAPS and (bits := mapped_bits(text)):
        return _Value(text, "", bits)
    if not _NUMBER.fullmatch(text):
        return _Value(text, "", text.lower())
    number, unit, factor = float(text), "", 1.0
    if _BOUNDS.fullmatch(key):
        unit, factor = ("mm", 1e3) if slides else ("deg", math.degrees(1.0))
    for pattern, one, scale in _UNITS:
        if pattern.fullmatch(key):
            unit, factor = one, scale
    return _Value(f"{number * factor:.9g}", unit, number)


def _sliding_arms(motion: Mapping[str, Sequence[_Attributes]]) -> set[str]:
    """Return the folded names of the ARM instances of prismatic axes."""
    types = {
        one.get("name")
        for one in motion.get("SINGLE_TYPE", ())
        if one.get("mechanics", "").upper() in _SLIDING
    }
    joints = {
        one.get("use_joint")
        for one in motion.get("SINGLE", ())
        if one.get("use_single_type") in types
    }
    arms = (one.get("use_arm") for one in motion.get("JOINT", ()) if one.get("name") in joints)
    return {arm.lower() for arm in arms if arm}


def _type_changes(
    domain: str, kind: str, old: Sequence[_Instance], new: Sequence[_Instance]
) -> Iterator[ConfigurationChange]:
    """Yield the changes of the instances of one type."""
    gone, come = _unequal(old, new), _unequal(new, old)
    pairs = list(_pairs(gone, come))
    for before, after in pairs:
        yield from _attribute_changes(domain, kind, before, after)
    changed = {id(one) for pair in pairs for one in pair}
    for one in gone:
        if id(one) not in changed:
            yield ConfigurationChange(domain, kind, _name(one), "", one.text, None)
    for one in come:
        if id(one) not in changed:
            yield ConfigurationChange(domain, kind, _name(one), "", None, one.text)


def _unequal(
    instances: Sequence[_Instance], other_instances: Sequence[_Instance]
) -> list[_Instance]:
    """Return the instances without an equal one among others, each of which matches only once."""
    waiting = Counter(one.content for one in other_instances)
    left: list[_Instance] = []
    for one in instances:
        if waiting[one.content]:
            waiting[one.content] -= 1
        else:
            left.append(one)
    return left


def _means_same(a: _Value | None, b: _Value | None) -> bool:
    if a is None or b is None:
        return a is b
    if isinstance(a.key, tuple) and isinstance(b.key, tuple) and _is_quaternion(a.key, b.key):
        return _turn_deg(a.key, b.key) < _SAME_TURN_DEG
    return a.key == b.key


def _is_quaternion(*keys: tuple[object, ...]) -> bool:
    return all(len(key) == 4 and all(isinstance(x, float) for x in key) for key in keys)


def _turn_deg(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    lengths = math.hypot(*a) * math.hypot(*b)
    if lengths == 0.0:
        return 0.0 if a == b else 180.0
    # By the sine of half the angle, which is exact for small ones.
    sign = 1.0 if sum(x * y for x, y in zip(a, b, strict=True)) >= 0.0 else -1.0
    a_length, b_length = math.hypot(*a), math.hypot(*b)
    apart = math.hypot(*(x / a_length - sign * y / b_length for x, y in zip(a, b, strict=True)))
    return math.degrees(4.0 * math.asin(min(1.0, apart / 2.0)))


def _pairs(
    removed: Sequence[_Instance], added: Sequence[_Instance]
) -> Iterator[tuple[_Instance, _Instance]]:
    """Yield pairs of an instance before and after: with equal names, else with most in common."""
    named: dict[str, list[_Instance]] = {}
    for one in reversed(added):
        if one.name is not None:
            named.setdefault(one.name.lower(), []).append(one)
    left: list[_Instance] = []
    taken: set[int] = set()
    for one in removed:
        twins = [] if one.name is None else named.get(one.name.lower(), [])
        if twins:
            taken.add(id(twins[-1]))
            yield one, twins.pop()
        else:
            left.append(one)
    waiting = [one for one in added if id(one) not in taken]
    if len(left) * len(waiting) > _MOST_COMPARED:
        return
    for one in left:
        scores = [_in_common(one, other) for other in waiting]
        if scores and max(scores) > 0.0:
            yield one, waiting.pop(scores.index(max(scores)))


def _in_common(a: _Instance, b: _Instance) -> float:
    """Return the share that two instances of other names have in common; 0 if they do not match."""
    equal = sum(
        _means_same(value, b.values.get(key)) for key, value in a.values.items() if key != "name"
    )
    most = max(len(a.values.keys() - {"name"}), len(b.values.keys() - {"name"}), 1)
    if a.name is not None or b.name is not None:
        # Renamed, if nothing else differs.
        return float(equal == most)
    return equal / most if 2 * equal >= most else 0.0


def _attribute_changes(
    domain: str, kind: str, old: _Instance, new: _Instance
) -> Iterator[ConfigurationChange]:
    for key in dict.fromkeys((*old.values, *new.values)):
        a, b = old.values.get(key), new.values.get(key)
        if _means_same(a, b):
            continue
        keys = [one.key for one in (a, b) if one is not None and isinstance(one.key, tuple)]
        turned = len(keys) == 2 and _is_quaternion(*keys)
        note = f"turned by {_turn_deg(*keys):.3f} deg" if turned else ""
        written = new.written.get(key) or old.written[key]
        unit = (a or b).unit  # type: ignore[union-attr]
        yield ConfigurationChange(
            domain,
            kind,
            _name(old),
            written,
            None if a is None else a.text,
            None if b is None else b.text,
            unit,
            note,
        )


def _name(instance: _Instance) -> str:
    """Return the name, or values that distinguish the instance from others."""
    if instance.name is not None:
        return instance.name
    return " ".join(value.text for value in list(instance.values.values())[:2])


def _product_changes(old: Sequence[str], new: Sequence[str]) -> Iterator[ConfigurationChange]:
    """Yield changes of the RobotWare version, and new and removed options."""
    before, after = map(_products, (old, new))
    for key in dict.fromkeys((*before, *after)):
        a, b = before.get(key), after.get(key)
        if a != b:
            yield ConfigurationChange("BACKINFO", "product", key, "", a, b)


def _products(listed: Sequence[str]) -> Mapping[str, str]:
    """Return the products by a name without the version."""
    found: dict[str, str] = {}
    for one in listed:
        version = re.fullmatch(r"(RobotWare)[^\d]*(\d[\d.+]*)", one, re.IGNORECASE)
        found[version[1] if version else one] = version[2] if version else "installed"
    return found
