"""Configuration at a path: system parameters of a controller, and a station file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from pathlib import Path

from rapidsim.backinfo import listed_products
from rapidsim.files import decode, input_bytes
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.language.equipment import Configured
from rapidsim.module_files import configuration_below, opened
from rapidsim.station.backup.backup import configured_in
from rapidsim.station.backup.cfg_file import read_configuration, text_in
from rapidsim.station.station import find_station
from rapidsim.station.toml_reader import Table, read_toml
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class CellConfiguration:
    """Configuration of the cell of a program."""

    parameters: Configured = field(default_factory=dict)
    """System parameters; empty if there is no configuration of a controller."""
    products: tuple[str, ...] = ()
    """RobotWare and its options, as a backup lists them."""
    station: Table = field(default_factory=dict)
    """Table of the station file; empty if there is no such file."""

    @property
    def is_empty(self) -> bool:
        """Whether there are neither parameters nor a station file."""
        return not self.parameters and not self.station


def is_configuration_file(path: str) -> bool:
    """Whether a path is a station file or a file of system parameters, and no program."""
    return Path(path).suffix.lower() in (".toml", ".cfg")


def cell_configuration(request: RunRequest) -> CellConfiguration:
    """Return the configuration near the path of a request.

    Raises:
        InputError: If a file cannot be read.
    """
    path = request.paths[0]
    if path.lower().endswith(".toml"):
        return CellConfiguration(station=read_toml(Path(path)))
    file = Path(request.station) if request.station is not None else find_station(request.paths)
    station: Mapping[str, object] = {} if file is None else read_toml(file)
    if path.lower().endswith(".cfg"):
        parameters = read_configuration(decode(input_bytes(Path(path)))[0])
        return CellConfiguration({Path(path).stem.upper(): parameters}, (), {})
    place = Path(path) if path == "-" else opened(path)
    below = configuration_below(place) if place.is_dir() else None
    if below is None:
        return CellConfiguration(station=station)
    products = listed_products(text_in(place, "BACKINFO", "backinfo.txt"))
    return CellConfiguration(configured_in(place, *below), products, station)
