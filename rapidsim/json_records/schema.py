"""JSON Schemas of records. Only what generates schemas imports this: it reads source text."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Iterable
from enum import Enum
from typing import Any, Literal, get_args, get_origin

from rapidsim.json_records.declarations import (
    RecordField,
    alternatives,
    is_record,
    item_type,
    marks_of,
    record_fields,
    value_type,
)

Schema = dict[str, Any]
_NAMES = {bool: "boolean", int: "integer", float: "number", str: "string"}


class SchemaWriter:
    """Schemas of records; those of nested records are collected as definitions."""

    def __init__(self) -> None:
        """Begin without definitions."""
        self.definitions: dict[str, Schema] = {}

    def object_of(self, record: Any) -> Schema:
        """Return the schema of a record."""
        properties: dict[str, Schema] = {}
        required: list[str] = []
        is_open = self._add(record, properties, required)
        schema: Schema = {"type": "object", "properties": properties, "required": required}
        return schema | ({"additionalProperties": True} if is_open else {})

    def _add(self, record: Any, properties: dict[str, Schema], required: list[str]) -> bool:
        """Add the keys of a record; returns whether others are possible."""
        descriptions = field_descriptions(record)
        is_open = False
        for field in record_fields(record):
            (type_, *_), may_be_none = alternatives(marks_of(field.type)[0])
            if not field.is_inline:
                properties[field.key] = self._property(field, descriptions.get(field.name))
                required += [] if field.is_optional else [field.key]
            elif is_record(type_):
                is_open |= self._add(type_, properties, [] if may_be_none else required)
            else:
                is_open = True
        return is_open

    def _property(self, field: RecordField, description: str | None) -> Schema:
        schema = self._of(field.type, may_be_none=not field.is_optional)
        return schema | ({"description": description} if description else {})

    def _of(self, declared: Any, *, may_be_none: bool = True) -> Schema:
        type_, marks = marks_of(declared)
        types, has_none = alternatives(type_)
        schemas = [self._single(declared if marks and not has_none else one) for one in types]
        if len(schemas) > 1:
            schema: Schema = {"type": [one["type"] for one in schemas]}
        else:
            (schema,) = schemas
        if not has_none or not may_be_none or not schema:
            return schema
        if "$ref" in schema:
            return {"anyOf": [schema, {"type": "null"}]}
        names = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        values = {"enum": [*schema["enum"], None]} if "enum" in schema else {}
        return {**schema, "type": [*names, "null"], **values}

    def _single(self, declared: Any) -> Schema:
        type_, marks = marks_of(declared)
        for mark in marks:
            if isinstance(mark, type) and issubclass(mark, Enum):
                return _text(one.value for one in mark)
        if type_ in _NAMES:
            return {"type": _NAMES[type_]}
        if get_origin(type_) is Literal:
            return _text(get_args(type_))
        if (item := item_type(type_)) is not None:
            return {"type": "array", "items": self._of(item)}
        if (of_values := value_type(type_)) is not None:
            return {"type": "object", "additionalProperties": self._of(of_values) or True}
        if isinstance(type_, type) and issubclass(type_, Enum):
            return _text(one.value for one in type_)
        return self._reference(type_) if is_record(type_) else {}

    def _reference(self, record: Any) -> Schema:
        name = record.__name__
        if name not in self.definitions:
            self.definitions[name] = {}
            self.definitions[name] = {"description": _words(record.__doc__ or "")}
            self.definitions[name] |= self.object_of(record)
        return {"$ref": f"#/$defs/{name}"}


def field_descriptions(record: Any) -> dict[str, str]:
    """Return the docstrings below the fields of a record and its base classes."""
    found: dict[str, str] = {}
    for one in reversed(record.__mro__[:-1]):
        (tree,) = ast.parse(textwrap.dedent(inspect.getsource(one))).body
        assert isinstance(tree, ast.ClassDef)
        for field, text in zip(tree.body, tree.body[1:], strict=False):
            if not (isinstance(field, ast.AnnAssign) and isinstance(text, ast.Expr)):
                continue
            if isinstance(field.target, ast.Name) and isinstance(text.value, ast.Constant):
                found[field.target.id] = _words(str(text.value.value))
    return found


def _words(text: str) -> str:
    return " ".join(text.split())


def _text(values: Iterable[str]) -> Schema:
    return {"type": "string", "enum": list(values)}
