"""Contacts and clearances along a motion, so that nothing slips through between two instants.

Between two instants a body is never farther from where it was than it turned and shifted, and from
the straight way between by no more than its acceleration lets it. So two gaps tell the least gap
between them; where that leaves a contact possible, or a gap that would be news, the instant in the
middle is looked at. What remains open after the shortest step is no contact.

Accelerations are those that the samples show, twofold, the largest of some neighbours.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import FARTHEST_M, Clearance, Contact, Found
from rapidsim.collisions.convex import Index
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import Poses, Scene
from rapidsim.collisions.shape import is_inside
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import dataclass

STEP_S = 0.016
SHORTEST_S = 4e-5
"""A contact begins within this of the instant given."""
_NEARER_M = 5e-4
_NEARER = 0.02
"""A clearance is given to this or that share of it."""
_BLOCK = 2000
"""Instants of a first look at once."""
_MOST_LOOKS = 400_000
"""Pairs and instants looked at in a block before it is given up."""
_BEST = 24
"""Stretches of each move that are looked at in one round, the nearest first."""
_DEPTHS = 30
"""Instants at which the depth of a contact is looked at."""
_SAFETY = 2.0
_NEIGHBOURS = 2

Mask = npt.NDArray[np.bool_]


def search(scene: Scene, end_s: float) -> Found:
    """Look along the whole motion.

    Args:
        scene: What moves.
        end_s: When [s] the run ends.
    """
    if not scene.pairs:
        return Found((), ())
    found = _Search(scene, scene.shapes())
    for times in _looks(scene, end_s):
        found.look(times)
    found.look_inside()
    return found.result()


def _looks(scene: Scene, end_s: float) -> list[Array]:
    """Instants (k,) of each block, evenly spaced; a block begins where the last one ends.

    Where all arms stand still a block is one long step.
    """
    busy = [stretch for arm in scene.arms for stretch in arm.busy]
    changes = [one.from_s for body in scene.bodies for one in body.carried[1:]]
    busy += [(max(0.0, at - STEP_S), min(at + STEP_S, end_s)) for at in changes]
    together: list[list[float]] = []
    for begin, end in sorted(busy):
        if together and begin <= together[-1][1] + STEP_S:
            together[-1][1] = max(together[-1][1], end)
        else:
            together.append([begin, end])
    blocks: list[Array] = []
    reached = 0.0
    for begin, end in together:
        end = min(end, end_s)
        if end <= begin:
            continue
        if begin > reached:
            blocks.append(np.array([reached, begin]))
        steps = max(2, int(np.ceil((end - begin) / STEP_S)))
        times = np.linspace(begin, end, steps + 1)
        blocks += [times[at : at + _BLOCK + 1] for at in range(0, steps, _BLOCK)]
        reached = end
    if end_s > reached or not blocks:
        blocks.append(np.array([reached, max(end_s, reached)]))
    return blocks


@dataclass(frozen=True, slots=True, eq=False)
class _Best:
    """The nearest of one move."""

    gap: float
    time_s: float
    pair: int
    point: Array

    @property
    def wanted(self) -> float:
        """A stretch that comes no nearer than this need not be looked at."""
        return self.gap - max(_NEARER_M, _NEARER * self.gap)


@dataclass(slots=True)
class _Touch:
    """The first contact of a pair in one move."""

    time_s: float
    point: Array


@dataclass(slots=True, eq=False)
class _Stretches:
    """Pairs between two instants."""

    pair: Index
    start: Index
    end: Index
    """Positions of the instants."""
    gap_start: Array
    gap_end: Array
    """No nearer than this at start and end."""
    seen_start: Mask
    seen_end: Mask
    """Whether the gap was measured as far as it matters."""
    bend: Array
    """Acceleration [m/s2] of one body seen from the other."""

    def rows(self, at: Index | Mask) -> _Stretches:
        """Some of them."""
        return _Stretches(*(getattr(self, name)[at] for name in self.__slots__))

    def and_also(self, other: _Stretches) -> _Stretches:
        """These and others."""
        return _Stretches(
            *(np.concatenate([getattr(self, n), getattr(other, n)]) for n in self.__slots__)
        )


class _Search:
    def __init__(self, scene: Scene, bodies: Bodies) -> None:
        self._scene, self._bodies = scene, bodies
        self._first: Index = np.array([pair.first for pair in scene.pairs])
        self._second: Index = np.array([pair.second for pair in scene.pairs])
        self._owner: Index = np.array([pair.owner for pair in scene.pairs])
        self._touch_only = np.array([pair.touch_only for pair in scene.pairs])
        self._best: dict[tuple[int, int], _Best] = {}
        # Of each robot and move: from which gap on a stretch is no news; and that gap itself.
        self._wanted = np.full((len(scene.arms), 1), FARTHEST_M)
        self._nearest = self._wanted.copy()
        self._touch: dict[tuple[int, int], _Touch] = {}
        self._decided = True

    def look(self, times: Array) -> None:
        """Look along one block of instants (k,)."""
        self._poses = self._scene.poses(times)
        more = int(self._poses.moves.max()) + 1 - self._wanted.shape[1]
        if more > 0:
            wider = ((0, 0), (0, more))
            self._wanted = np.pad(self._wanted, wider, constant_values=FARTHEST_M)
            self._nearest = np.pad(self._nearest, wider, constant_values=FARTHEST_M)
        open_ones = self._first_look()
        looks = 0
        while len(open_ones.pair):
            least = self._least(open_ones)
            touches, nearer = self._matters(open_ones, least)
            keep = touches | nearer
            open_ones, least, touches = open_ones.rows(keep), least[keep], touches[keep]
            if not len(open_ones.pair):
                break
            looks += len(open_ones.pair)
            if looks > _MOST_LOOKS:
                self._decided = False
                break
            now = touches | self._nearest_of_moves(open_ones, least)
            later = open_ones.rows(~now)
            open_ones = self._closer(open_ones.rows(now)).and_also(later)

    def look_inside(self) -> None:
        """See which bodies begin inside a hollow one, whose surface they need not touch."""
        poses = self._scene.poses(np.zeros(1))
        for number, pair in enumerate(self._scene.pairs):
            for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
                solid = self._scene.bodies[other].shape.solid
                if solid is None:
                    continue
                world = (
                    poses.rotation[0, one] @ self._bodies.centre[one] + poses.translation[0, one]
                )
                seen = (world - poses.translation[0, other]) @ poses.rotation[0, other]
                if is_inside(solid, seen):
                    move = int(poses.moves[0, pair.owner])
                    self._touch.setdefault((number, move), _Touch(0.0, world))

    def _first_look(self) -> _Stretches:
        """The stretches of a block in which spheres and boxes around the bodies leave questions."""
        poses, bodies = self._poses, self._bodies
        centre = np.einsum("tbij,bj->tbi", poses.rotation, bodies.centre) + poses.translation
        step = np.diff(poses.times)
        shift = np.linalg.norm(np.diff(centre, axis=0), axis=2)
        turn = _turned(poses.rotation[1:], poses.rotation[:-1])
        swing = turn * bodies.bound
        bend = self._bends(centre, step, shift, turn)
        first, second = self._first, self._second
        apart = np.linalg.norm(centre[:, first] - centre[:, second], axis=2)
        near = apart - bodies.bound[first] - bodies.bound[second]
        near = np.maximum(near, self._to_box(centre, first, second))
        near = np.maximum(near, self._to_box(centre, second, first))
        way = (shift + swing)[:, first] + (shift + swing)[:, second]
        slack = bend * (step[:, None] ** 2 / 8.0)
        least = 0.5 * (near[1:] + near[:-1] - way) - slack
        wanted = np.where(self._touch_only, -TOUCH_M, FARTHEST_M)
        at, pair = np.nonzero(least < wanted)
        unseen = np.zeros(len(at), dtype=np.bool_)
        return _Stretches(
            pair,
            at,
            at + 1,
            near[at, pair],
            near[at + 1, pair],
            unseen,
            unseen.copy(),
            bend[at, pair],
        )

    def _to_box(self, centre: Array, one: Index, boxed: Index) -> Array:
        """The gaps (t, p) between the sphere around one body and the box around another."""
        poses, bodies = self._poses, self._bodies
        apart = centre[:, one] - poses.translation[:, boxed]
        seen = np.einsum("tpji,tpj->tpi", poses.rotation[:, boxed], apart)
        outside = np.maximum(np.maximum(bodies.low[boxed] - seen, seen - bodies.high[boxed]), 0.0)
        gap: Array = np.linalg.norm(outside, axis=2) - bodies.bound[one]
        return gap

    def _bends(self, centre: Array, step: Array, shift: Array, turn: Array) -> Array:
        """How fast (t - 1, p) a body's way bends [m/s2], seen from the other body of its pair."""
        bodies, rotation = self._bodies, self._poses.rotation
        count = len(step)
        own = np.zeros((count, len(bodies.bound)))
        if count > 1:
            middle = (step[1:] * step[:-1])[:, None]
            pulled = np.linalg.norm(centre[2:] - 2.0 * centre[1:-1] + centre[:-2], axis=2) / middle
            twisted = rotation[2:] - 2.0 * rotation[1:-1] + rotation[:-2]
            twist = np.sqrt(0.5 * np.einsum("tbij,tbij->tb", twisted, twisted)) / middle
            each = np.zeros((count + 1, own.shape[1]))
            each[1:-1] = pulled + twist * bodies.bound
            wide = np.pad(each, ((_NEIGHBOURS, _NEIGHBOURS), (0, 0)), mode="edge")
            around = [wide[at : at + count] for at in range(2 * _NEIGHBOURS + 2)]
            own = _SAFETY * np.maximum.reduce(around) + 0.1 * each.max(axis=0)
        rate = np.maximum(step, 1e-9)[:, None]
        speed, turning = shift / rate, turn / rate
        a, b = self._first, self._second
        apart = np.linalg.norm(centre[:-1, a] - centre[:-1, b], axis=2) + bodies.bound[a]
        # Seen from a body that turns, others bend as well.
        apparent = turning[:, b] * (2.0 * (speed[:, a] + speed[:, b]) + turning[:, b] * apart)
        bend: Array = own[:, a] + own[:, b] + apparent
        return bend

    def _seen(self, pair: Index, at: Index) -> Transform:
        """second_from_first of pairs (k,) at instants (k,)."""
        poses, a, b = self._poses, self._first[pair], self._second[pair]
        back = np.swapaxes(poses.rotation[at, b], 1, 2)
        apart = poses.translation[at, a] - poses.translation[at, b]
        return Transform(back @ poses.rotation[at, a], np.einsum("kij,kj->ki", back, apart))

    def _ways(self, some: _Stretches) -> tuple[Array, Array]:
        """How far (k,) [m] points of one body move on the straight way, and may stray from it."""
        bodies = self._bodies
        start, end = self._seen(some.pair, some.start), self._seen(some.pair, some.end)
        a = self._first[some.pair]
        centre = bodies.centre[a]
        shift = np.linalg.norm(
            np.einsum("kij,kj->ki", end.rotation - start.rotation, centre)
            + end.translation
            - start.translation,
            axis=1,
        )
        turn = _turned(end.rotation, start.rotation)
        step = self._poses.times[some.end] - self._poses.times[some.start]
        return shift + turn * bodies.bound[a], some.bend * step**2 / 8.0

    def _least(self, some: _Stretches) -> Array:
        way, slack = self._ways(some)
        least: Array = 0.5 * (some.gap_start + some.gap_end - way) - slack
        return least

    def _matters(self, some: _Stretches, least: Array) -> tuple[Mask, Mask]:
        """Which stretches may hold a contact that is not known, and which the nearest of a move."""
        poses = self._poses
        touches = least < -TOUCH_M
        owner = self._owner[some.pair]
        move = poses.moves[some.end, owner]
        long = poses.times[some.end] - poses.times[some.start] > SHORTEST_S
        long |= ~(some.seen_start & some.seen_end)
        nearer = ~self._touch_only[some.pair] & (least < self._wanted[owner, move])
        for (pair, of_move), touch in self._touch.items():
            over = (some.pair == pair) & (move == of_move)
            over &= poses.times[some.start] >= touch.time_s
            touches &= ~over
            nearer &= ~over
        return touches & long, nearer & long

    def _nearest_of_moves(self, some: _Stretches, least: Array) -> Mask:
        """The stretches of each move that most likely hold its nearest place."""
        owner = self._owner[some.pair]
        move = self._poses.moves[some.end, owner]
        order = np.lexsort((least, move, owner))
        starts = np.flatnonzero(
            np.diff(owner[order], prepend=-1) | np.diff(move[order], prepend=-1)
        )
        rank = np.arange(len(order)) - np.repeat(starts, np.diff(starts, append=len(order)))
        chosen = np.zeros(len(order), dtype=np.bool_)
        chosen[order[rank < _BEST]] = True
        return chosen

    def _closer(self, some: _Stretches) -> _Stretches:
        """Measure the ends of some stretches; where that is done already, cut them in two."""
        done = some.seen_start & some.seen_end
        measured = self._measured(some.rows(~done)) if not done.all() else some.rows(~done)
        return measured.and_also(self._halves(some.rows(done))) if done.any() else measured

    def _measured(self, some: _Stretches) -> _Stretches:
        way, slack = self._ways(some)
        own = self._touch_only[some.pair]
        owner = self._owner[some.pair]
        move = self._poses.moves[some.end, owner]
        wanted = np.where(own, 0.0, self._nearest[owner, move])
        enough = wanted + way + 2.0 * slack + TOUCH_M
        todo = np.concatenate([~some.seen_start, ~some.seen_end])
        pair = np.concatenate([some.pair, some.pair])[todo]
        at = np.concatenate([some.start, some.end])[todo]
        limit = np.concatenate([enough, enough])[todo]
        key = pair * len(self._poses.times) + at
        distinct, firsts, back = np.unique(key, return_index=True, return_inverse=True)
        widest = np.zeros(len(distinct))
        np.maximum.at(widest, back, limit)
        pair, at = pair[firsts], at[firsts]
        gaps = self._bodies.gaps(
            self._first[pair], self._second[pair], self._seen(pair, at), widest
        )
        self._note(pair, at, gaps.found, gaps.point)
        known = np.where(np.isfinite(gaps.found), gaps.found, gaps.least)
        values = np.concatenate([some.gap_start, some.gap_end])
        values[todo] = known[back]
        half = len(some.pair)
        yes = np.ones(half, dtype=np.bool_)
        return _Stretches(
            some.pair,
            some.start,
            some.end,
            values[:half],
            values[half:],
            yes,
            yes.copy(),
            some.bend,
        )

    def _note(self, pair: Index, at: Index, gap: Array, point: Array) -> None:
        """Remember contacts and nearest places."""
        poses = self._poses
        owners = self._owner[pair]
        news = (gap < -TOUCH_M) | (gap < self._nearest[owners, poses.moves[at, owners]])
        # The nearest first, so that what comes before need not be remembered.
        for k in sorted(np.flatnonzero(news).tolist(), key=lambda k: float(gap[k])):
            p, t = int(pair[k]), int(at[k])
            owner = int(self._owner[p])
            move, time_s = int(poses.moves[t, owner]), float(poses.times[t])
            second = int(self._second[p])
            if gap[k] < -TOUCH_M:
                known = self._touch.get((p, move))
                if known is None or time_s < known.time_s:
                    place = poses.rotation[t, second] @ point[k] + poses.translation[t, second]
                    self._touch[p, move] = _Touch(time_s, place)
            if not self._touch_only[p] and gap[k] < self._nearest[owner, move]:
                place = poses.rotation[t, second] @ point[k] + poses.translation[t, second]
                best = _Best(max(float(gap[k]), 0.0), time_s, p, place)
                self._best[owner, move] = best
                self._nearest[owner, move], self._wanted[owner, move] = gap[k], best.wanted

    def _halves(self, some: _Stretches) -> _Stretches:
        times = self._poses.times
        middle = 0.5 * (times[some.start] + times[some.end])
        distinct, place = np.unique(middle, return_inverse=True)
        at = len(times) + place
        new = self._scene.poses(distinct)
        old = self._poses
        self._poses = Poses(
            np.concatenate([old.times, new.times]),
            np.concatenate([old.rotation, new.rotation]),
            np.concatenate([old.translation, new.translation]),
            np.concatenate([old.moves, new.moves]),
        )
        least = self._least(some)
        seen, unseen = np.ones(len(at), dtype=np.bool_), np.zeros(len(at), dtype=np.bool_)
        return _Stretches(
            some.pair, some.start, at, some.gap_start, least, seen, unseen, some.bend
        ).and_also(
            _Stretches(some.pair, at, some.end, least, some.gap_end, unseen, seen, some.bend)
        )

    def result(self) -> Found:
        """All contacts and clearances."""
        bodies, pairs = self._scene.bodies, self._scene.pairs
        contacts = []
        for (p, move), touch in sorted(
            self._touch.items(), key=lambda one: (one[1].time_s, one[0])
        ):
            contacts.append(
                Contact(
                    touch.time_s,
                    pairs[p].owner,
                    move,
                    bodies[pairs[p].first].label,
                    bodies[pairs[p].second].label,
                    touch.point,
                    self._depth(p, move),
                    (p, move - 1) in self._touch and self._ends_in_contact(p, move),
                )
            )
        clearances = tuple(
            Clearance(
                best.gap,
                best.time_s,
                owner,
                move,
                bodies[pairs[best.pair].first].label,
                bodies[pairs[best.pair].second].label,
                best.point,
            )
            for (owner, move), best in sorted(self._best.items())
        )
        return Found(tuple(contacts), clearances, self._decided)

    def _depth(self, pair: int, move: int) -> float:
        """How deep [m] a pair is in each other at most, from its contact in a move on."""
        owner, first, second = int(self._owner[pair]), self._first[pair], self._second[pair]
        begin = self._touch[pair, move].time_s
        deepest = 0.0
        # As far as the contact goes, in ever longer steps.
        times = begin + np.concatenate([[0.0], 0.002 * 1.25 ** np.arange(_DEPTHS)])
        poses = self._scene.poses(times)
        self._poses = poses
        seen = self._seen(np.full(len(times), pair), np.arange(len(times)))
        for k in range(len(times)):
            deep = self._bodies.depth(int(first), int(second), seen[k])
            if k and (deep <= TOUCH_M or poses.moves[k, owner] != move):
                break
            deepest = max(deepest, deep)
        return deepest

    def _ends_in_contact(self, pair: int, move: int) -> bool:
        """Whether a pair touches where a move begins."""
        first = self._touch[pair, move].time_s
        poses = self._scene.poses(np.array([first - 2.0 * SHORTEST_S]))
        owner = int(self._owner[pair])
        return bool(poses.moves[0, owner] != move)


def _turned(one: Array, other: Array) -> Array:
    """How far a point at distance 1 may be moved by turning from one rotation to another (...)."""
    apart = one - other
    moved: Array = np.sqrt(0.5 * np.einsum("...ij,...ij->...", apart, apart))
    return moved
