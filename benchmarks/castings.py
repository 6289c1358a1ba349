"""Looking for contacts among bodies with as many triangles as CAD exports have.

    python benchmarks/castings.py [--bodies 20] [--triangles 2000 10000 50000] [--rounds 5 20]
    python benchmarks/castings.py --touching [--triangles 2000] [--rounds 1]
    python benchmarks/castings.py --pairs 1000 [--triangles 50000]

The first runs a cell of two arms and a positioner among rings with a rippled surface, each a closed
mesh that is not convex: one in each gripper, one on the table, the others close to the arms. It
prints the processor time beyond the same run without bodies, per simulated second, each time in a
new process, and that of python-fcl for the nearest pair at every step of 16 ms: for a first run,
and for a later one, which finds the hulls of the bodies in the user's store. NumPy has one thread,
as in the command line. In the second the rings are so close that the arms hit many in every move.
The third compares distances and contacts of such a ring and a box, and of two rings, in random
poses with those of python-fcl, with the processor time of both.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import fcl
import numpy as np
from collision_truths import model, random_poses

import rapidsim
from rapidsim.collisions import link_shapes, outer_hull, shape
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import FARTHEST_M
from rapidsim.collisions.meshes.triangles import Triangles
from rapidsim.collisions.nearest_parts import CLOSE_M
from rapidsim.collisions.scene import STEP_S, Scene
from rapidsim.jobs.cache.number_store import NumberStore
from rapidsim.jobs.cache.result_store import ResultStore
from rapidsim.simulation.options import RunOptions

RADIUS_M, THICK_M, RIPPLE_M = 0.2, 0.05, 0.006
CLEAR_MM, TOUCHING_MM = 1050.0, 450.0
"""Distances of the standing rings from the middle of the cell."""
FAR_M = 0.3
"""Distance up to which pairs are compared."""
TOUCHING_M = 1e-5
"""Nearer to touching than this both answers are right."""
_INSTANTS = 200
"""Number of instants at which python-fcl is measured."""
_STATION = """
[[robot]]
name = "left"
model = "irb1600-6-1.2"
start = [0, 0, 0, 0, 30, 0]
[[robot]]
name = "right"
model = "irb1600-6-1.2"
start = [0, 0, 0, 0, 30, 0]
base = { position = [2300, 0, 0], quaternion = [0, 0, 0, 1] }
[[task]]
name = "T_LEFT"
robot = "left"
[[task]]
name = "T_RIGHT"
robot = "right"
modules = ["Right.mod"]
[[external_axis]]
name = "STN1"
axis = "b"
kind = "rotational"
limits = [-400, 400]
speed = 90
acceleration = 180
carries = "wobj"
frame = { position = [1150, 0, 300] }
"""
_OBJECT = """
[[object]]
name = "ring {name}"
mesh = "ring.stl"
unit = "m"
pose = {{ position = {position}, quaternion = {quaternion} }}
parent = "{parent}"
robot = "T_{side}"
"""
_MODULE = """MODULE {side}
  CONST robtarget p:=[[{x},0,750],[0,0,1,0],[0,0,0,0],[9E9,{at},9E9,9E9,9E9,9E9]];
  PROC main()
    VAR robtarget q;
    ConfL\\Off;
    FOR round FROM 1 TO {rounds} DO
      FOR i FROM 1 TO 12 DO
        q:=Offs(p,-100*Cos(30*i),350*Sin(30*i),150*Cos(60*i));
        {turn}
        MoveL q,v500,z10,tool0;
      ENDFOR
    ENDFOR
  ENDPROC
ENDMODULE
"""


def ring(triangles: int) -> Triangles:
    """Return a ring with ripples of about so many triangles: closed, but not convex."""
    around = max(6, round((triangles * 1.25) ** 0.5))
    across = max(5, round(triangles / 2 / around))
    u = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)[:, None]
    v = np.linspace(0.0, 2.0 * np.pi, across, endpoint=False)[None]
    thick = THICK_M + RIPPLE_M * np.sin(9.0 * u) * np.cos(3.0 * v)
    out = RADIUS_M + thick * np.cos(v)
    points = np.stack([out * np.cos(u), out * np.sin(u), thick * np.sin(v)], axis=-1)
    i, j = np.arange(around)[:, None], np.arange(across)[None]
    then, up = (i + 1) % around, (j + 1) % across
    a, b, c, d = (x * across + y for x, y in ((i, j), (then, j), (then, up), (i, up)))
    faces = [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    return Triangles(points.reshape(-1, 3), np.concatenate(faces), closed=True)


def write_stl(path: Path, mesh: Triangles) -> None:
    """Write a binary STL file."""
    rows = np.zeros(
        len(mesh.faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")]
    )
    rows["corners"] = mesh.vertices[mesh.faces]
    path.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())


def station(bodies: int, aside_mm: float = CLEAR_MM) -> str:
    """Return the station file of the cell with some rings."""
    texts = [_STATION, "[collisions]\n"]
    flat, upright = [1, 0, 0, 0], [0.7071067811865476, 0.7071067811865476, 0, 0]
    for number in range(bodies):
        side = ("LEFT", "RIGHT")[number % 2]
        parent, position, turned = "world", [0.0, 0.0, 0.0], flat
        if number < 2:
            parent, position = "tool", [0.0, 0.0, 200.0]
        elif number == 2:
            parent = "unit:STN1"
        else:
            row, column = divmod(number - 3, max(1, (bodies - 3 + 1) // 2))
            x, y = 250.0 + 1800.0 * column / max(1, (bodies - 3) // 2), (-aside_mm, aside_mm)[row]
            position, turned = [round(x), y, 600.0], upright
        texts.append(
            _OBJECT.format(
                name=number, position=position, quaternion=turned, parent=parent, side=side
            )
        )
    return "\n".join(texts)


def cell_cost(bodies: int, triangles: int, rounds: int, aside_mm: float) -> None:
    """Print what bodies cost in a run of the cell."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        write_stl(folder / "ring.stl", ring(triangles))
        for side, x, at, turn in (
            ("Left", 640, "0", "q.extax.eax_b:=20*i;"),
            ("Right", 1660, "9E9", ""),
        ):
            text = _MODULE.format(side=side, x=x, at=at, turn=turn, rounds=rounds)
            (folder / f"{side}.mod").write_text(text, encoding="utf-8")
        options = RunOptions(hulls=NumberStore(ResultStore(folder / "kept")))
        spent = []
        # The first run loads modules, too.
        for tables in (_STATION, _STATION, station(bodies, aside_mm), station(bodies, aside_mm)):
            (folder / "rapidsim.toml").write_text(tables, encoding="utf-8")
            # Each run is as in a process of its own.
            outer_hull._around.cache_clear()
            link_shapes._from_urdf.cache_clear()
            started = time.process_time()
            run = rapidsim.simulate([folder / "Left.mod"], options=options)
            spent.append(time.process_time() - started)
        found = run.collisions
        assert found is not None, run
        cold, warm = ((one - spent[1]) / run.time_s for one in spent[2:])
        theirs = _by_fcl(found.scene, run.time_s)
        print(
            f"{bodies} bodies of {triangles} triangles, {found.pair_count} pairs, "
            f"{len(found.report.contacts)} contacts, {run.time_s:.1f} s: {1e3 * cold:.1f} ms of "
            f"processor more a simulated second, {1e3 * warm:.1f} ms with hulls in the store; "
            f"python-fcl {1e3 * theirs:.0f} ms, {theirs / cold:.1f} and {theirs / warm:.1f} times "
            "as long",
            flush=True,
        )


def _by_fcl(scene: Scene, end_s: float) -> float:
    """Return what python-fcl costs [s] per simulated second: its models, and distances.

    At each instant that of the pair that bounds say is nearest, then those of pairs whose bounds
    are below the least so far. Bounds and poses are not counted.
    """
    bodies = scene.shapes()
    started = time.process_time()
    shapes = {id(one.shape): one.shape for one in scene.bodies}
    models = {key: model(one) for key, one in shapes.items()}
    made = time.process_time() - started
    objects = [fcl.CollisionObject(models[id(one.shape)]) for one in scene.bodies]
    pairs = [pair for pair in scene.pairs if not pair.touch_only]
    first, second = (np.array([getattr(one, end) for one in pairs]) for end in ("first", "second"))
    poses, spent = scene.poses(np.linspace(0.0, end_s, _INSTANTS)), 0.0
    for k in range(_INSTANTS):
        near = bodies.bounds.gaps(first, second, poses.seen(first, second, np.full(len(pairs), k)))
        for one, *place in zip(objects, poses.rotation[k], poses.translation[k], strict=True):
            one.setTransform(fcl.Transform(*place))
        least = FARTHEST_M
        started = time.process_time()
        for pair in np.argsort(near).tolist():
            if near[pair] >= least:
                break
            ends = objects[first[pair]], objects[second[pair]]
            least = min(least, fcl.distance(*ends, fcl.DistanceRequest(), fcl.DistanceResult()))
        spent += time.process_time() - started
    return made / end_s + spent / _INSTANTS / STEP_S


@dataclass(frozen=True)
class Comparison:
    """Gaps of two bodies in random poses, as found and as python-fcl has them."""

    touching: int
    """Number of poses in which they touch."""
    differing: int
    """Number of poses in which one says that they touch, and the other not."""
    error_m: float
    error: float
    """Largest error of a distance up to `FAR_M`, and as a share."""
    too_high_m: float
    """How far a lower bound is above the distance at most."""
    ours_s: float
    theirs_s: float
    """Processor time."""


def compared(
    count: int, triangles: int, *, two_rings: bool, close_m: float = 0.0, seed: int = 1
) -> Comparison:
    """Compare a ring with a box, or with another ring, in random poses."""
    surface, size = ring(triangles), np.array([0.3, 0.1, 0.1])
    corners = surface.vertices[surface.faces]
    body = shape.Shape((), surface.vertices, surface.faces, triangles=corners, solid=surface)
    bodies = Bodies([body, body if two_rings else shape.box(size)])
    poses = random_poses(np.random.default_rng(seed), count, 0.5)
    row = np.zeros(count, dtype=np.int64)
    started = time.process_time()
    gaps = bodies.gaps(row, row + 1, poses, np.full(count, FAR_M), max(CLOSE_M, close_m))
    ours = time.process_time() - started
    others = [_fcl_mesh(surface), _fcl_mesh(surface) if two_rings else fcl.Box(*size)]
    objects = [fcl.CollisionObject(one, fcl.Transform()) for one in others]
    theirs, apart, touches = 0.0, np.zeros(count), np.zeros(count, dtype=np.bool_)
    for k in range(count):
        objects[0].setTransform(fcl.Transform(poses.rotation[k], poses.translation[k]))
        started = time.process_time()
        apart[k] = fcl.distance(*objects, fcl.DistanceRequest(), fcl.DistanceResult())
        theirs += time.process_time() - started
        touches[k] = fcl.collide(*objects, fcl.CollisionRequest(), fcl.CollisionResult()) > 0
    found, touching = gaps.distances_found, gaps.distances_found < 0.0
    differ = (touching != touches) & ((apart > TOUCHING_M) | touches)
    near = ~touches & ~touching & (apart < FAR_M)
    error = np.abs(found - apart)[near]
    return Comparison(
        int(touches.sum()),
        int(differ.sum()),
        float(error.max(initial=0.0)),
        float((error / apart[near]).max(initial=0.0)),
        float((gaps.least - apart)[~touches].max(initial=0.0)),
        ours,
        theirs,
    )


def pairs(count: int, triangles: int) -> None:
    """Print comparisons."""
    for two_rings in (False, True):
        found = compared(count, triangles, two_rings=two_rings)
        print(
            f"{'two rings' if two_rings else 'ring and box'}: {count} poses, {found.touching} "
            f"touching, {found.differing} differ; distances differ by at most "
            f"{1e3 * found.error_m:.3f} mm, {100.0 * found.error:.2f} %; "
            f"{1e3 * found.ours_s / count:.2f} ms a pose, "
            f"python-fcl {1e3 * found.theirs_s / count:.2f} ms"
        )


def _fcl_mesh(surface: Triangles) -> fcl.BVHModel:
    model = fcl.BVHModel()
    model.beginModel(len(surface.vertices), len(surface.faces))
    model.addSubModel(surface.vertices, surface.faces)
    model.endModel()
    return model


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bodies", type=int, default=20)
    parser.add_argument("--triangles", type=int, nargs="*", default=[2000, 10_000, 50_000])
    parser.add_argument("--rounds", type=int, nargs="*", default=[5, 20])
    parser.add_argument("--pairs", type=int, default=0)
    parser.add_argument("--touching", action="store_true")
    asked = parser.parse_args()
    cells = [(triangles, rounds) for rounds in asked.rounds for triangles in asked.triangles]
    if asked.pairs:
        for triangles in asked.triangles:
            pairs(asked.pairs, triangles)
    elif len(cells) == 1:
        cell_cost(asked.bodies, *cells[0], TOUCHING_MM if asked.touching else CLEAR_MM)
    else:
        for triangles, rounds in cells:
            options = f"--bodies {asked.bodies} --triangles {triangles} --rounds {rounds}"
            options += " --touching" if asked.touching else ""
            subprocess.run([sys.executable, __file__, *options.split()], check=True)


if __name__ == "__main__":
    main()
