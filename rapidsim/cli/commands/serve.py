"""`rapidsim serve`: a controller that clients of Robot Web Services can talk to."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from math import inf
from pathlib import Path
from ssl import SSLContext
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import click

from rapidsim import __version__
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of, shared
from rapidsim.cli.options.job_options import assume_missing_option
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.terminal import echo, terminal_options
from rapidsim.cli.viewer import require_screen
from rapidsim.extras import require
from rapidsim.files import InputError, input_bytes
from rapidsim.jobs.inputs.run_request import DEFAULT_ENTRY, RunRequest
from rapidsim.output_files import whole_file
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.server.process import OpenDebugPort
    from rapidsim.server.settings import EngineSettings, ServerSettings

_MODES = {"auto": "AUTO", "manr": "MANR", "manf": "MANF"}


@value_class(frozen=True, slots=True)
class ServeOptions:
    """Options of a controller that stays on."""

    paths: tuple[str, ...] = argument("PATH...", nargs=-1, required=True)
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them."
    )
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    )
    task: str | None = option("--task", metavar="NAME", help="Only this task, of several.")
    io: str | None = option(
        "--io", metavar="FILE.toml", help="Signals and stimuli of inputs; adds to the station."
    )
    host: str = option(
        "--host",
        metavar="ADDRESS",
        default="127.0.0.1",
        show_default=True,
        help="The address to listen on.",
    )
    allow_hosts: tuple[str, ...] = option(
        "--allow-host",
        metavar="NAME",
        multiple=True,
        help="Another name under which clients address the server, as in a container's network.",
    )
    allow_origins: tuple[str, ...] = option(
        "--allow-origin",
        metavar="URL",
        multiple=True,
        help="Origin of a web page that may use the server, such as http://localhost:3000.",
    )
    robotware: str | None = option(
        "--robotware",
        type=click.Choice(["6", "7", "8"]),
        help="Serve only RobotWare 6 (Robot Web Services 1.0), 7 or 8 (2.0); default: both, with "
        "the version of the backup.",
    )
    rws1_port: str | None = option(
        "--rws1-port",
        metavar="N|off",
        help="The port of Robot Web Services 1.0 (RobotWare 6); 0 picks a free one, off disables "
        "it; default 8080.",
    )
    rws2_port: str | None = option(
        "--rws2-port",
        metavar="N|off",
        help="The port of Robot Web Services 2.0 (RobotWare 7 and 8), with TLS; default 8443.",
    )
    latency: str | None = option(
        "--latency",
        type=click.Choice(["irc5"]),
        help="Delay starts and loads of modules like this controller: irc5 by 10 and 13 s.",
    )
    speed: str = option(
        "--speed",
        metavar="F|max",
        default="1",
        show_default=True,
        help="Virtual seconds per second of real time; max is as fast as possible.",
    )
    assume_missing: bool = shared(assume_missing_option)
    lock_step: bool = option(
        "--lock-step",
        is_flag=True,
        help="Virtual time passes only with requests, so that runs repeat.",
    )
    request_time: float | None = option(
        "--request-time",
        metavar="SECONDS",
        type=POSITIVE,
        help="In lock-step, the virtual time before each request; default 0.05.",
    )
    sensors: tuple[str, ...] = option(
        "--egm",
        metavar="NAME=HOST:PORT",
        multiple=True,
        help="Address of the sensor behind a UDPUC device; overrides SIO.cfg.",
    )
    egm_any_port: bool = option(
        "--egm-any-port",
        is_flag=True,
        help="A sensor may answer from any port of its computer; otherwise the port of its first "
        "answer is kept.",
    )
    home: str | None = option(
        "--home", metavar="DIR", help="The folder for HOME:; default <program>.home."
    )
    ramdisk: str | None = option(
        "--ramdisk", metavar="DIR", help="The folder for RAMDISK:; default: one in HOME:."
    )
    opmode: str = option(
        "--opmode",
        type=click.Choice(list(_MODES)),
        default="auto",
        show_default=True,
        help="The operating mode at the start.",
    )
    motors: str = option(
        "--motors",
        type=click.Choice(["on", "off"]),
        default="on",
        show_default=True,
        help="The state of the motors at the start.",
    )
    users: tuple[str, ...] = option(
        "--user",
        metavar="NAME:PASSWORD",
        multiple=True,
        help="A login that replaces a controller's default users.",
    )
    user_file: str | None = option(
        "--user-file",
        metavar="FILE",
        help="Such logins, one per line; without any, those of the variable RAPIDSIM_USERS.",
    )
    max_sessions: int = option(
        "--max-sessions",
        metavar="N",
        type=click.IntRange(min=1),
        default=70,
        show_default=True,
        help="Maximum number of clients at a time.",
    )
    session_timeout: float = option(
        "--session-timeout",
        metavar="SECONDS",
        type=POSITIVE,
        default=300.0,
        show_default=True,
        help="End a session that has been idle this long.",
    )
    network_hosts: tuple[str, ...] = option(
        "--network-host",
        metavar="ADDRESS",
        multiple=True,
        help="Another host that the program's sockets may reach.",
    )
    journal: str | None = option(
        "--journal",
        metavar="FILE.jsonl",
        help="Write all requests and events; `rapidsim run --replay` runs it again.",
    )
    record: str | None = option(
        "--record",
        metavar="FILE.rrd",
        help="Record while the server runs; the file appears at the end.",
    )
    view: bool = option("--view", is_flag=True, help="Show the recording live.")
    ready_file: str | None = option(
        "--ready-file",
        metavar="FILE",
        help="Also write the first line to a file that exists while the server listens.",
    )
    faults_port: int | None = option(
        "--faults-port",
        metavar="N",
        type=click.IntRange(0, 65535),
        help="A port of this computer at which tests inject faults; 0 picks a free one.",
    )
    debug_port: int | None = option(
        "--debug",
        metavar="PORT",
        type=click.IntRange(0, 65535),
        help="A port of this computer at which `rapidsim dap` attaches; 0 picks a free one.",
    )


@click.command()
@options_of(ServeOptions)
@terminal_options
def serve(options: ServeOptions) -> int:
    """Serve a virtual controller to clients of Robot Web Services 1.0 and 2.0.

    PATH is as for `rapidsim run`. The first line on stdout gives the addresses as JSON. The server
    runs until Ctrl-C or SIGTERM.

    Exit codes: 0 ended on request, 1 the program has errors, 2 wrong usage or a port in use.
    """
    require("aiohttp", "rapidsim serve")
    ports = _ports(options)
    if ports[1] is not None:
        require("cryptography", "--rws2-port")
    from rapidsim.cli.tools.run_output import print_rejected_on_stderr
    from rapidsim.jobs.running.run_files import ProgramRejectedError
    from rapidsim.server.process import started
    from rapidsim.server.serve import Addresses
    from rapidsim.server.serve import serve as serve_engine

    _require_consistent(options, ports)
    request = RunRequest(
        paths=options.paths,
        robot=options.robot,
        station=options.station,
        task=options.task,
        io=options.io,
        entry=DEFAULT_ENTRY,
        may_be_empty=True,
        assume_missing=options.assume_missing,
        home=options.home,
        ramdisk=options.ramdisk,
    )
    engine_settings = _engine_settings(options)
    server_settings = _server_settings(options, ports)
    ready_file = None if options.ready_file is None else Path(options.ready_file)

    def ready(addresses: Addresses) -> None:
        line = {
            "ready": True,
            "rws1": addresses.rws1,
            "rws2": addresses.rws2,
            "egm": dict(engine.ready.sensors),
            "home": str(engine.ready.home),
            "ramdisk": str(engine.ready.ramdisk),
            "pid": os.getpid(),
            "version": __version__,
        }
        if addresses.faults is not None:
            line["faults"] = addresses.faults
        if engine.ready.debug is not None:
            line["debug"] = engine.ready.debug
        if ready_file is not None:
            with whole_file(ready_file) as part:
                part.write_text(json.dumps(line) + "\n", encoding="utf-8")
        echo(json.dumps(line))

    # A server that was killed has left its file, and to start takes seconds.
    with _removed(ready_file):
        try:
            engine = started(request, engine_settings, _debug_port(options.debug_port))
        except ProgramRejectedError as rejected:
            print_rejected_on_stderr(request, rejected.diagnostics)
            return ExitCode.FINDINGS
        ended = serve_engine(engine, server_settings, ready, lambda text: echo(text, err=True))
    if not ended:
        echo("error: the controller's process has ended; please report this", err=True)
    return ExitCode.CLEAN if ended else ExitCode.DEFECT


@contextmanager
def _removed(file: Path | None) -> Iterator[None]:
    """Remove a file before the body of the context, and what the body has written after it."""
    files = () if file is None else (file,)
    for one in files:
        with suppress(OSError):
            one.unlink()
    try:
        yield
    finally:
        for one in files:
            with suppress(OSError):
                one.unlink()


def _require_consistent(options: ServeOptions, ports: tuple[int | None, int | None]) -> None:
    from rapidsim.server.http.guard import is_loopback

    if "-" in options.paths:
        raise InputError("serve reads no program from standard input", "name a file or a folder")
    if ports == (None, None):
        raise InputError("--rws1-port off, --rws2-port off: no client could reach the controller")
    if options.view and options.record is None:
        raise InputError("--view: it shows what --record FILE.rrd writes")
    if options.view:
        require_screen()
    if options.record is not None:
        require("rerun", "--record")
    if options.request_time is not None and not options.lock_step:
        raise InputError("--request-time: it needs --lock-step")
    if not _logins(options) and not is_loopback(options.host):
        raise InputError(
            f"--host {options.host}: other computers reach it, and default passwords are known to "
            "all",
            "`--user NAME:PASSWORD` or `--user-file FILE` sets who may log in",
        )


def _engine_settings(options: ServeOptions) -> EngineSettings:
    from rapidsim.egm.devices import read_device
    from rapidsim.server.settings import EngineSettings
    from rapidsim.simulation.live.states import Motors, OperatingMode

    return EngineSettings(
        speed=_speed(options.speed),
        request_s=(options.request_time or 0.05) if options.lock_step else None,
        motors=Motors.ON if options.motors == "on" else Motors.OFF,
        mode=OperatingMode(_MODES[options.opmode]),
        robotware=None if options.robotware is None else int(options.robotware),
        hosts=frozenset(options.network_hosts),
        sensors=tuple(map(read_device, options.sensors)),
        any_sensor_port=options.egm_any_port,
        journal=None if options.journal is None else Path(options.journal),
        record=None if options.record is None else Path(options.record),
        view=options.view,
    )


def _server_settings(options: ServeOptions, ports: tuple[int | None, int | None]) -> ServerSettings:
    from rapidsim.server.settings import DEFAULT_USERS, LATENCIES, NO_LATENCIES, ServerSettings

    return ServerSettings(
        host=options.host,
        rws1_port=ports[0],
        rws2_port=ports[1],
        faults_port=options.faults_port,
        tls=None if ports[1] is None else _tls(),
        hosts=frozenset(name.lower() for name in options.allow_hosts),
        origins=frozenset(map(_origin, options.allow_origins)),
        users=_users(_logins(options)) or DEFAULT_USERS,
        latencies_s=LATENCIES[options.latency] if options.latency else NO_LATENCIES,
        most_sessions=options.max_sessions,
        # In lock-step nothing depends on the wall, sessions included.
        session_timeout_s=inf if options.lock_step else options.session_timeout,
    )


def _ports(options: ServeOptions) -> tuple[int | None, int | None]:
    """Return the ports of both generations; None for one that is not served.

    Raises:
        InputError: If a port is none, or of a generation that the version does not speak.
    """
    defaults = {"6": ("8080", "off"), "7": ("off", "8443"), "8": ("off", "8443")}
    first, second = defaults.get(options.robotware or "", ("8080", "8443"))
    for name, text, default in (
        ("--rws1-port", options.rws1_port, first),
        ("--rws2-port", options.rws2_port, second),
    ):
        if default == "off" and text not in (None, "off"):
            raise InputError(f"{name} {text}: RobotWare {options.robotware} does not support it")
    return (
        _port("--rws1-port", options.rws1_port or first),
        _port("--rws2-port", options.rws2_port or second),
    )


def _port(option: str, text: str) -> int | None:
    if text == "off":
        return None
    if not (text.isascii() and text.isdecimal() and len(text) < 6 and int(text) < 65536):
        raise InputError(f"{option}: `{text}` is neither a number from 0 to 65535 nor off")
    return int(text)


def _debug_port(port: int | None) -> OpenDebugPort | None:
    if port is None:
        return None
    from rapidsim.dap.debug_port import open_debug_port

    return partial(open_debug_port, port=port)


def _tls() -> SSLContext:
    """The server's key; imported late, as only TLS needs the package."""
    from rapidsim.server.http.certificate import default_folder, tls_context

    return tls_context(default_folder())


def _speed(text: str) -> float | None:
    if text == "max":
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < float("inf"):
        raise InputError(f"--speed: `{text}` is neither a positive number nor max")
    return speed


def _origin(url: str) -> str:
    """Return an origin as browsers send it.

    Raises:
        InputError: If the text is no scheme and host.
    """
    parts = urlsplit(url)
    if parts.scheme not in ("http", "https") or not parts.netloc or parts.path.strip("/"):
        raise InputError(f"--allow-origin: `{url}` is not an origin such as http://localhost:3000")
    return f"{parts.scheme}://{parts.netloc}".lower()


def _logins(options: ServeOptions) -> tuple[str, ...]:
    """Return all logins: of the command line, which others can see, and a file, or of a variable.

    Raises:
        InputError: If the file cannot be read.
    """
    text = "" if options.users else os.environ.get("RAPIDSIM_USERS", "")
    if options.user_file is not None:
        text = input_bytes(Path(options.user_file)).decode("utf-8", "replace")
    lines = (line.strip() for line in text.splitlines())
    return (*options.users, *(line for line in lines if line))


def _users(texts: tuple[str, ...]) -> dict[str, str]:
    for one in texts:
        if not one.partition(":")[0] or not one.partition(":")[2]:
            raise InputError("--user: NAME:PASSWORD is needed, both parts")
    return {name: password for name, _, password in (one.partition(":") for one in texts)}
