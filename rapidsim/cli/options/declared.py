"""The options of a command, declared once, as the fields of a value that the command receives.

    @value_class(frozen=True, slots=True)
    class ViewOptions:
        file: str = argument("FILE.rrd")
        export: str | None = option("--export", metavar="DIR", help="Write a page instead.")

    @options_of(ViewOptions)
    def view(options: ViewOptions) -> int: ...

Fields are in the order of the help page. Defaults are click's: a field itself has none.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import field, fields
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Command = Callable[..., int]
Kind = TypeVar("Kind", bound="DataclassInstance")

_DECORATOR = "decorator"


def option(*names: str, **settings: Any) -> Any:
    """Declare a field that is an option, with the arguments of `click.option`."""
    return _declared(lambda name: click.option(*names, name, **settings))


def argument(metavar: str | None = None, **settings: Any) -> Any:
    """Declare a field that is an argument, with the settings of `click.argument`."""
    return _declared(lambda name: click.argument(name, metavar=metavar, **settings))


def shared(decorator: Callable[[Any], Any]) -> Any:
    """Declare a field by an option that several commands have, which has the field's name."""
    return _declared(lambda _: decorator)


def options_of(kind: type[Any], parameter: str = "options") -> Callable[[Command], Command]:
    """Add the options of a value class to a command, which receives a value of it."""

    def decorate(command: Command) -> Command:
        @functools.wraps(command)
        def with_options(*arguments: object, **values: object) -> int:
            return command(*arguments, **{parameter: collect(kind, values)}, **values)

        return attach(kind)(with_options)

    return decorate


def attach(kind: type[Any]) -> Callable[[Command], Command]:
    """Add the options of a value class to a command, each as a separate parameter."""

    def decorate(command: Command) -> Command:
        # The help page lists decorators from the last applied to the first.
        for declared in reversed(fields(kind)):
            command = declared.metadata[_DECORATOR](declared.name)(command)
        return command

    return decorate


def collect(kind: type[Kind], values: dict[str, Any]) -> Kind:
    """Remove the options of a value class from the parameters of a command; return its value."""
    return kind(**{declared.name: values.pop(declared.name) for declared in fields(kind)})


def _declared(decorator_of: Callable[[str], Callable[[Any], Any]]) -> Any:
    return field(metadata={_DECORATOR: decorator_of})
