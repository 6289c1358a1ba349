"""The recipe of the image, the files of CI and compose: their rules, and their steps one by one.

The image itself is built if buildah is installed and RAPIDSIM_BASE names an image of Debian.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import yaml

from rapidsim.cli.commands.serve import serve

ROOT = Path(__file__).parents[2]
RECIPE, COMPOSE = ROOT / "Containerfile", ROOT / "containers" / "compose.yaml"
SERVICE, ACTION = ROOT / "containers" / "github.yml", ROOT / "action.yml"
INSTRUCTIONS = frozenset(
    {
        *("ARG", "FROM", "RUN", "COPY", "ENV", "USER", "WORKDIR", "VOLUME", "EXPOSE"),
        *("STOPSIGNAL", "HEALTHCHECK", "ENTRYPOINT", "CMD"),
    }
)
PINNED = re.compile(r"[\w./-]+:[\w.-]*\d[\w.-]*|[\w./-]+:bookworm-slim")
MOST_MB, BASE_MB, PYTHON_MB = 250, 78, 47
"""Size of the image, of its base, Debian's slim one, and of the Python of Debian in it."""


def steps() -> list[tuple[str, str]]:
    """The instructions of the recipe with their arguments, lines joined."""
    lines = [line for line in RECIPE.read_text().splitlines() if not line.startswith("#")]
    joined = "\n".join(lines).replace("\\\n", " ")
    found = (line.split(maxsplit=1) for line in joined.splitlines() if line.strip())
    return [(word, " ".join(rest.split())) for word, rest in found]


def last(instruction: str) -> str:
    return [rest for word, rest in steps() if word == instruction][-1]


def parsed(arguments: Sequence[str]) -> dict[str, Any]:
    """The options that `rapidsim serve` takes from a command line; it fails if one is wrong."""
    return dict(serve.make_context("serve", list(arguments)).params)


def entry() -> list[str]:
    """The options of the image's entry point."""
    program, command, *options = json.loads(last("ENTRYPOINT"))
    assert (program, command) == ("rapidsim", "serve")
    return list(options)


def test_the_recipe_keeps_the_rules_of_recipes() -> None:
    found = steps()
    words = [word for word, _ in found]
    assert set(words) <= INSTRUCTIONS
    assert PINNED.fullmatch(found[0][1].partition("=")[2]), "a base has a version"
    for word, rest in found:
        if "apt-get install" in rest:
            assert "apt-get update &&" in rest
            assert "--yes --no-install-recommends" in rest
        if "pip" in rest and " install " in rest and word == "RUN" and "apt-get" not in rest:
            assert "--no-cache-dir" in rest
        if word in ("ENTRYPOINT", "CMD"):
            assert isinstance(json.loads(rest), list), "no shell between signals and the server"
    # What remains has no rights, and no lists of packages.
    assert last("USER") == "1000"
    assert words.index("USER") < words.index("ENTRYPOINT")
    final = max(k for k, word in enumerate(words) if word == "FROM")
    kept = [rest for word, rest in found[:final] if word == "RUN" and "rm -rf /var/lib" in rest]
    assert len(kept) == 1
    assert not any("apt-get" in rest for _, rest in found[final:])
    assert last("VOLUME") == last("CMD").strip('[]"') == "/cell"


def test_the_entry_point_and_the_health_check_fit_the_server() -> None:
    options = parsed([*entry(), *json.loads(last("CMD"))])
    assert (options["host"], options["paths"]) == ("0.0.0.0", ("/cell",))
    assert last("EXPOSE") == "8080 8443"
    check = json.loads(last("HEALTHCHECK").partition("CMD")[2])
    assert check == ["test", "-s", options["ready_file"]]


def test_the_image_gets_what_the_package_is_made_of_and_nothing_else() -> None:
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    assert lines[0] == "*"
    admitted = {line[1:] for line in lines if line.startswith("!")}
    text = (ROOT / "pyproject.toml").read_text()
    needed = json.loads(re.findall(r"only-include = (\[.*\])", text)[0])
    assert admitted == {*needed, "pyproject.toml", "README.md", "LICENSE"}
    assert all((ROOT / one).exists() for one in admitted)


def test_the_compose_file_has_services_that_find_each_other() -> None:
    read = yaml.safe_load(COMPOSE.read_text())
    assert set(read) == {"services"}
    controller, driver = (read["services"][name] for name in ("controller", "driver"))
    known = {"build", "command", "volumes", "image", "depends_on"}
    assert set(controller) | set(driver) == known
    assert (COMPOSE.parent / controller["build"]["context"]).resolve() == ROOT
    assert (ROOT / controller["build"]["dockerfile"]) == RECIPE
    options = parsed([*entry(), *controller["command"]])
    assert options["allow_hosts"] == ("controller",)
    (sensor,) = options["sensors"]
    assert sensor == "ROB_1=driver:6511"
    assert driver["depends_on"] == {"controller": {"condition": "service_healthy"}}
    settings = dict(one.split(":=") for one in driver["command"] if ":=" in one)
    assert (settings["rws_ip"], settings["rws_port"]) == ("controller", "8080")
    # Only the folder of the cell, which cannot be written to.
    assert controller["volumes"] == ["./cell:/cell:ro"]


def test_the_service_and_the_action_are_safe_and_whole() -> None:
    job = yaml.safe_load(SERVICE.read_text())
    assert job["permissions"] == {"contents": "read"}
    (service,) = job["jobs"]["client"]["services"].values()
    assert service["image"] == "${{ vars.RAPIDSIM_IMAGE }}"
    assert all(one.startswith("127.0.0.1:") for one in service["ports"])
    action = yaml.safe_load(ACTION.read_text())
    assert set(action) == {"name", "description", "inputs", "runs"}
    assert all({"description", "default"} == set(one) for one in action["inputs"].values())
    assert action["runs"]["using"] == "composite"
    for step in (*job["jobs"]["client"]["steps"], *action["runs"]["steps"]):
        assert ("run" in step) != ("uses" in step)
        assert "${{" not in step.get("run", ""), "an expression there is executed by the shell"
        if "uses" in step:
            assert re.fullmatch(r"[\w/-]+@v\d+", step["uses"])
    texts = json.dumps(action["runs"])
    assert all(f"inputs.{name}" in texts for name in action["inputs"])


@contextmanager
def served(command: Sequence[str], ready: Path, **options: Any) -> Iterator[dict[str, Any]]:
    """Serve by a command until the block ends; its first line, once it is in the file."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, **options)
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert line
        until_s = time.monotonic() + 10.0
        while not ready.exists() and time.monotonic() < until_s:
            time.sleep(0.05)
        assert ready.read_text() == line
        yield json.loads(line)
    finally:
        process.terminate()
        process.wait(30)
        assert process.stdout is not None
        process.stdout.close()


def use(address: str) -> None:
    """Load a program as the job does, and start it with a client of PyPI."""
    port = address.rpartition(":")[2]
    script = yaml.safe_load(SERVICE.read_text())["jobs"]["client"]["steps"][1]["run"]
    folder = Path("cell")
    folder.mkdir()
    program = "MODULE job\nPROC main()\nWaitTime 60;\nENDPROC\nENDMODULE\n"
    (folder / "main.mod").write_text(program)
    subprocess.run(["bash", "-e", "-c", script.replace(":8080", f":{port}")], check=True)
    client = (
        "import sys; from abb_robot_client.rws import RWS; robot = RWS(sys.argv[1]);"
        "robot.resetpp(); robot.start('once'); print(robot.get_execution_state().ctrlexecstate)"
    )
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "client"], check=True)
    python = str(Path("client", "bin", "python"))
    install = ("-m", "pip", "--python", python, "install", "-q", "abb-robot-client")
    subprocess.run([sys.executable, *install], check=True)
    ran = (python, "-c", client, f"http://127.0.0.1:{port}")
    assert subprocess.run(ran, check=True, capture_output=True, text=True).stdout == "running\n"


@pytest.mark.packages
@pytest.mark.skipif(sys.platform == "win32", reason="the steps are those of Linux")
def test_the_steps_of_the_recipe_serve_a_client(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without an engine for containers: in a folder in place of /."""
    monkeypatch.chdir(tmp_path)
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    Path("src").mkdir()
    for one in (line[1:] for line in lines if line.startswith("!")):
        (shutil.copytree if (ROOT / one).is_dir() else shutil.copy)(ROOT / one, Path("src", one))
    for pattern in (line for line in lines[1:] if line[:1] not in ("!", "#")):
        for folder in Path("src").glob(pattern):
            shutil.rmtree(folder)
    (install,) = (rest for word, rest in steps() if word == "RUN" and "-m venv" in rest)
    install = install.replace("/opt/rapidsim", f"{tmp_path}/opt").replace("/src", f"{tmp_path}/src")
    subprocess.run(["sh", "-e", "-c", install.replace("python3", sys.executable, 1)], check=True)
    size = sum(one.stat().st_size for one in (tmp_path / "opt").rglob("*") if one.is_file())
    assert size / 1e6 < MOST_MB - BASE_MB - PYTHON_MB
    (tmp_path / "home").mkdir()
    (tmp_path / "empty").mkdir()
    ready = tmp_path / "home" / "ready.json"
    given = [one.replace("/home/rapidsim", str(ready.parent)) for one in entry()]
    command = [str(tmp_path / "opt/bin/rapidsim"), "serve", *given, str(tmp_path / "empty")]
    ports = ("--rws1-port", "0", "--rws2-port", "0")
    users = last("ENV").partition("RAPIDSIM_USERS=")[2]
    variables = {**os.environ, "RAPIDSIM_USERS": shlex.split(users)[0], "HOME": str(ready.parent)}
    with served([*command, *ports], ready, env=variables, cwd=ready.parent) as line:
        use(line["rws1"])
    assert not ready.exists()


@pytest.mark.packages
@pytest.mark.skipif(
    shutil.which("buildah") is None or "RAPIDSIM_BASE" not in os.environ,
    reason="needs buildah, and an image in RAPIDSIM_BASE",
)
def test_the_image_serves_a_client(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BUILDAH_ISOLATION", "chroot")

    def buildah(*arguments: str) -> str:
        command = ["buildah", *arguments]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    base = os.environ["RAPIDSIM_BASE"]
    mounts = []
    if (settings := Path("/etc/pip.conf")).exists():
        # Where packages come from is up to the computer.
        certificates = "/etc/ssl/certs"
        Path("pip.conf").write_text(settings.read_text().replace(certificates, "/run/certs"))
        mounts = [f"--volume={certificates}:/run/certs:ro"]
        mounts += [f"--volume={tmp_path}/pip.conf:/etc/pip.conf:ro"]
    build = ("build", "--network=host", "--format=docker", "--quiet", f"--build-arg=BASE={base}")
    image = buildah(*build, *mounts, "--file", str(RECIPE), str(ROOT))
    container = buildah("from", image)
    try:
        root = Path(buildah("mount", container))
        command = ["buildah", "run", "--network=host", container, "--", "rapidsim", "serve"]
        ports = ("--rws1-port", "0", "--rws2-port", "0")
        ready = root / "home/rapidsim/ready.json"
        with served([*command, *entry(), *ports, "/cell"], ready) as line:
            check = json.loads(last("HEALTHCHECK").partition("CMD")[2])
            buildah("run", container, "--", *check)
            use(line["rws1"])
    finally:
        buildah("rm", container)
