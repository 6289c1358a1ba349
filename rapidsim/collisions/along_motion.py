"""Contacts and clearances along a motion, checked continuously between sampling instants.

The gaps at both ends of an interval and the distance travelled in between bound the smallest gap
within (`travel`). The first intervals are many steps long; where one leaves a contact possible, or
a gap smaller than any so far, its ends are measured, and then it is bisected. An interval that is
undecided after the shortest step counts as no contact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rapidsim.collisions.block_bounds import BlockBounds
from rapidsim.collisions.body_distance import Bodies, Gaps
from rapidsim.collisions.bounds_tree import first_of_each
from rapidsim.collisions.contact import FARTHEST_M, Clearance, CollisionReport, Contact
from rapidsim.collisions.convex import Index, Mask
from rapidsim.collisions.intervals import PairIntervals
from rapidsim.collisions.nearest_parts import CLOSE_M
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import SHORTEST_S, STEP_S, Scene
from rapidsim.collisions.shape import is_inside
from rapidsim.frames.transform import Array, Transform
from rapidsim.repeated_rows import divided
from rapidsim.values import value_class

_NEARER_M, _NEARER = 5e-4, 0.02
"""Tolerance of a clearance: the larger of a length [m] and a share of it."""
_OF_SURFACES = 2.5
"""Factor of the tolerance for surfaces of triangles, whose gaps cost more."""
_OF_TRAVEL, _OF_GAP = 0.1, 0.025
"""Tolerance of gaps of surfaces, as shares of the travel in an interval and of the gap."""
_BLOCK = 2000
"""Number of steps in a block, about: many short blocks cost more than a few long ones."""
_MOST_LOOKS = 400_000
"""Number of pairs times instants checked in a block before the search gives up."""
_ROUND, _BEST = 400, 24
"""Number of intervals checked in one round, nearest first, and the maximum of one move."""
_DEPTHS = 30
"""Number of instants at which the depth of a contact is measured."""
_MOST_DEPTHS = 500
"""Number of contacts, from the first of the run, whose depth is measured."""


def _always() -> bool:
    return True


def search(
    scene: Scene,
    end_s: float,
    bodies: Bodies | None = None,
    *,
    has_depths: bool = True,
    may_go_on: Callable[[], bool] = _always,
) -> CollisionReport:
    """Check the whole motion.

    Args:
        scene: Arms, bodies and pairs.
        end_s: End of the run [s].
        bodies: Bodies of the scene, to share them between several motions; None to build them.
        has_depths: Whether to measure the depths of contacts.
        may_go_on: Called before each block; returns whether to search it and those after it.
    """
    if not scene.pairs:
        return CollisionReport((), ())
    found = _Search(scene, bodies or scene.shapes())
    until_s = math.inf
    for times in _sample_times(scene, end_s):
        if not may_go_on():
            until_s = float(times[0])
            break
        found.check_block(times)
    if until_s:
        found.check_enclosed()
    return replace(found.result(_MOST_DEPTHS if has_depths else 0), until_s=until_s)


def _sample_times(scene: Scene, end_s: float) -> list[Array]:
    """Return the instants (k,) of each block; a block begins at the end of the previous one.

    While all arms rest a block is one long step. Each brief move has an instant of its own.
    """
    busy = [stretch for arm in scene.arms for stretch in arm.busy]
    changes = [one.from_s for body in scene.bodies for one in body.carried[1:]]
    busy += [(max(0.0, at - STEP_S), min(at + STEP_S, end_s)) for at in changes]
    brief = np.unique(np.concatenate([arm.brief_s for arm in scene.arms]))
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
        times = _stepped(begin, brief[(brief > begin) & (brief < end)], end)
        edges = np.linspace(0, len(times) - 1, max(1, round(len(times) / _BLOCK)) + 1).astype(int)
        blocks += [times[at : to + 1] for at, to in pairwise(edges.tolist())]
        reached = end
    if end_s > reached or not blocks:
        blocks.append(np.array([reached, max(end_s, reached)]))
    return blocks


def _stepped(begin: float, between: Array, end: float) -> Array:
    """Return instants [s] from begin to end, at most a step apart, including those in `between`."""
    edges = np.concatenate([[begin], between, [end]])
    steps = np.maximum(np.ceil(np.diff(edges) / STEP_S), 2 if len(edges) == 2 else 1).astype(
        np.int64
    )
    return divided(edges, steps)


@value_class(frozen=True, slots=True, eq=False)
class _Best:
    """Nearest approach in one move."""

    gap: float
    time_s: float
    pair: int
    point: Array


@value_class(slots=True)
class _Touch:
    """First contact of a pair in one move."""

    time_s: float
    point: Array


_Key = tuple[int, int]
"""Pair and move."""


class _Search:
    def __init__(self, scene: Scene, bodies: Bodies) -> None:
        self._scene, self._bodies = scene, bodies
        self._first: Index = np.array([pair.first for pair in scene.pairs])
        self._second: Index = np.array([pair.second for pair in scene.pairs])
        self._pair = self._first, self._second
        self._owner: Index = np.array([pair.owner for pair in scene.pairs])
        self._touch_only = np.array([pair.touch_only for pair in scene.pairs])
        self._from = np.array([pair.from_s for pair in scene.pairs])
        self._until = np.array([pair.until_s for pair in scene.pairs])
        self._best: dict[_Key, _Best] = {}
        # Per robot and move: the gap from which on an interval is irrelevant, and the smallest gap.
        self._wanted = np.full((len(scene.arms), 1), FARTHEST_M)
        self._nearest = self._wanted.copy()
        self._touch: dict[_Key, _Touch] = {}
        self._decided = True

    def check_block(self, times: Array) -> None:
        """Check one block of instants (k,)."""
        judged = np.flatnonzero((self._from < times[-1]) & (self._until > times[0]))
        self._block = BlockBounds(self._scene, self._bodies, times, judged)
        more = int(self._block.poses.moves.max()) + 1 - self._wanted.shape[1]
        if more > 0:
            wider = ((0, 0), (0, more))
            self._wanted = np.pad(self._wanted, wider, constant_values=FARTHEST_M)
            self._nearest = np.pad(self._nearest, wider, constant_values=FARTHEST_M)
        open_ones, looks = self._block.initial_intervals(), 0
        while True:
            least = self._block.least(open_ones)
            touches, nearer = self._matters(open_ones, least)
            keep = touches | nearer
            open_ones, least, touches = open_ones.rows(keep), least[keep], touches[keep]
            looks += len(open_ones.pair)
            if not len(open_ones.pair):
                return
            if looks > _MOST_LOOKS:
                self._decided = False
                return
            is_long = self._many_moves(open_ones) & ~touches
            halved = open_ones.seen | is_long
            now = touches | halved | self._nearest_of_moves(open_ones, least)
            parted = now & ~is_long & ~open_ones.has_plane & self._has_surfaces(open_ones.pair)
            halved, measured = now & halved & ~parted, now & ~halved & ~parted
            open_ones = open_ones.rows(~now).and_also(
                *self._parted(open_ones.rows(parted)),
                self._measured(open_ones.rows(measured)),
                *self._block.halves(open_ones.rows(halved), least[halved]),
            )

    def _parted(self, some: PairIntervals) -> tuple[PairIntervals, ...]:
        """Return what planes between surfaces leave open, halved and measured in the middle."""
        if not len(some.pair):
            return ()
        some = self._block.parted(some)
        touches, nearer = self._matters(some, self._block.least(some))
        some = some.rows(touches | nearer)
        least, halved = some.floor, (some.floor > -np.inf) & self._block.several(some)
        first, second = self._block.halves(some.rows(halved), least[halved])
        first = self._measured(first, start=False)
        second = replace(second, gap_start=first.gap_end, seen_start=first.seen_end)
        seen = ~halved & some.seen
        return (
            first,
            second,
            self._measured(some.rows(~halved & ~seen)),
            *self._block.halves(some.rows(seen), self._block.least(some.rows(seen))),
        )

    def check_enclosed(self) -> None:
        """Find bodies that start inside a hollow body, whose surface they need not touch."""
        poses, centre = self._scene.poses(np.zeros(1)), self._bodies.bounds.centre
        for number, pair in enumerate(self._scene.pairs):
            if pair.from_s > 0.0:
                continue
            for one, other in ((pair.first, pair.second), (pair.second, pair.first)):
                solid = self._scene.bodies[other].shape.solid
                if solid is None:
                    continue
                place = poses.seen(one, other).apply(centre[one])[0]
                away = float(np.linalg.norm(place - centre[other]))
                if away < self._bodies.bounds.bound[other] and is_inside(solid, place):
                    move = int(poses.moves[0, pair.owner])
                    world = poses.of(one).apply(centre[one])[0]
                    self._touch.setdefault((number, move), _Touch(0.0, world))

    def _moves(self, some: PairIntervals) -> tuple[Index, Index, Index]:
        """Return the robots that own intervals (k,), and the moves at their starts and ends."""
        owner, moves = self._owner[some.pair], self._block.poses.moves
        return owner, moves[some.start, owner], moves[some.end, owner]

    def _many_moves(self, some: PairIntervals) -> Mask:
        """Mask of intervals with several steps and moves."""
        _, before, after = self._moves(some)
        several: Mask = self._block.several(some) & (before != after)
        return several

    def _has_surfaces(self, pair: Index) -> Mask:
        return self._bodies.has_surfaces(self._first[pair], self._second[pair])

    def _matters(self, some: PairIntervals, least: Array) -> tuple[Mask, Mask]:
        """Masks of intervals that may contain a new contact, and a new nearest point of a move."""
        owner, before, after = self._moves(some)
        touches = least < -TOUCH_M
        long = (self._block.lasts(some) > SHORTEST_S) | ~some.seen
        of_moves = [
            np.where(
                self._block.travel.stirs(some.pair, owner, move), self._wanted[owner, move], -np.inf
            )
            for move in (before, after)
        ]
        wanted = np.maximum(*of_moves)
        wanted[self._many_moves(some)] = FARTHEST_M
        nearer = ~self._touch_only[some.pair] & (least < wanted)
        if self._touch:
            over = self._block.poses.times[some.start] >= self._touched(some.pair, after)
            touches &= ~over
            nearer &= ~over
        times, pair = self._block.poses.times, some.pair
        long &= (times[some.start] < self._until[pair]) & (times[some.end] > self._from[pair])
        return touches & long, nearer & long

    def _touched(self, pair: Index, move: Index) -> Array:
        """Return the times (k,) [s] of the first contact of pairs in a move; inf for none."""
        width = self._wanted.shape[1]
        keys = np.array([pair * width + move for pair, move in self._touch])
        order = np.argsort(keys)
        times = np.array([touch.time_s for touch in self._touch.values()])[order]
        at = np.minimum(np.searchsorted(keys, pair * width + move, sorter=order), len(keys) - 1)
        known = keys[order][at] == pair * width + move
        return np.where(known, times[at], np.inf)

    def _nearest_of_moves(self, some: PairIntervals, least: Array) -> Mask:
        """Mask of the intervals of each move that most likely contain its nearest point."""
        owner, _, move = self._moves(some)
        key = owner * self._wanted.shape[1] + move
        count = int(np.clip(_ROUND // max(1, len(np.unique(key))), 1, _BEST))
        return first_of_each(key, least, count)

    def _measured(self, some: PairIntervals, *, start: bool = True) -> PairIntervals:
        """Measure the ends of intervals, or only the later ones, as far as they are relevant."""
        if not len(some.pair):
            return some
        owner, *moves = self._moves(some)
        wanted = np.maximum(*(self._nearest[owner, move] for move in moves))
        wanted[(wanted < 0.0) | self._touch_only[some.pair]] = 0.0
        # The bound for a gap that is not measured must not leave the interval undecided.
        way = self._block.approach(some)
        enough = wanted + way * start + TOUCH_M
        before = ~some.seen_start if start else np.zeros_like(some.seen_start)
        todo = np.concatenate([before, ~some.seen_end])
        pair = np.concatenate([some.pair, some.pair])[todo]
        at = np.concatenate([some.start, some.end])[todo]
        limit = np.concatenate([enough, enough])[todo]
        key = pair * len(self._block.poses.times) + at
        distinct, firsts, back = np.unique(key, return_index=True, return_inverse=True)
        widest, longest = np.zeros((2, len(distinct)))
        np.maximum.at(widest, back, limit)
        np.maximum.at(longest, back, np.concatenate([way, way])[todo])
        pair, at = pair[firsts], at[firsts]
        gaps = self._gaps(pair, at, widest, longest * start)
        self._note(pair, at, gaps.distances_found, gaps.point)
        touching = np.isfinite(gaps.distances_found) & (gaps.distances_found <= 0.0)
        known = np.where(touching, gaps.distances_found, gaps.least)
        values = np.concatenate([some.gap_start, some.gap_end])
        values[todo] = known[back]
        begin, end = np.split(values, 2)
        yes = np.ones_like(some.seen_end)
        seen_start = some.seen_start | before
        return replace(some, gap_start=begin, gap_end=end, seen_start=seen_start, seen_end=yes)

    def _gaps(self, pair: Index, at: Index, enough: Array, travel: Array) -> Gaps:
        """Return the gaps of pairs (k,) at instants (k,).

        Gaps of surfaces of triangles cost far more the more accurate they are. An error of a small
        share of the travel in an interval hardly matters for the interval.
        """
        first, second = self._first[pair], self._second[pair]
        surfaces = self._has_surfaces(pair)
        close = np.where(surfaces, np.maximum(_OF_TRAVEL * travel, CLOSE_M), CLOSE_M)
        return self._bodies.gaps(first, second, self._block.seen(pair, at), enough, close, _OF_GAP)

    def _note(self, pair: Index, at: Index, gap: Array, point: Array) -> None:
        """Record contacts and nearest points."""
        poses, owner = self._block.poses, self._owner[pair]
        within = (poses.times[at] >= self._from[pair]) & (poses.times[at] <= self._until[pair])
        gap = np.where(within, gap, np.inf)
        move, times = poses.moves[at, owner], poses.times[at]
        touching = np.flatnonzero(gap < -TOUCH_M)
        for k in touching[_first_of(times[touching], pair[touching], move[touching])].tolist():
            known = self._touch.get((int(pair[k]), int(move[k])))
            if known is None or times[k] < known.time_s:
                place = poses.of(int(self._second[pair[k]]))[int(at[k])].apply(point[k])
                self._touch[int(pair[k]), int(move[k])] = _Touch(float(times[k]), place)
        nearer = ~self._touch_only[pair] & (gap < self._nearest[owner, move])
        surfaces = self._has_surfaces(pair)
        news = np.flatnonzero(nearer & self._block.travel.stirs(pair, owner, move))
        for k in news[_first_of(gap[news], owner[news], move[news])].tolist():
            place = poses.of(int(self._second[pair[k]]))[int(at[k])].apply(point[k])
            least = max(float(gap[k]), 0.0)
            best = _Best(least, float(times[k]), int(pair[k]), place)
            self._best[int(owner[k]), int(move[k])] = best
            self._nearest[owner[k], move[k]] = gap[k]
            tolerance = max(_NEARER_M, _NEARER * least) * (_OF_SURFACES if surfaces[k] else 1.0)
            self._wanted[owner[k], move[k]] = least - tolerance

    def result(self, most_depths: int) -> CollisionReport:
        """Return all contacts, the first with their depths, and clearances."""
        bodies, pairs = self._scene.bodies, self._scene.pairs
        touched = sorted(self._touch.items(), key=lambda one: (one[1].time_s, one[0]))
        depths = self._depths([key for key, _ in touched[:most_depths]])
        places = self._places(touched[:_MOST_DEPTHS])
        continued = self._continued()
        contacts = tuple(
            Contact(
                touch.time_s,
                pairs[p].owner,
                move,
                bodies[pairs[p].first].label,
                bodies[pairs[p].second].label,
                places.get((p, move), touch.point),
                depths.get((p, move)),
                (p, move) in continued,
            )
            for (p, move), touch in touched
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
        return CollisionReport(contacts, clearances, self._decided)

    def _places(self, touched: Sequence[tuple[_Key, _Touch]]) -> dict[_Key, Array]:
        """Return the nearest points (3,) of pairs just before they touch.

        Once they overlap, only corners of one body inside the other are known, not the contact
        point.
        """
        if not touched:
            return {}
        pair = np.array([key[0] for key, _ in touched])
        first, second = self._first[pair], self._second[pair]
        poses = self._scene.poses(
            np.array([touch.time_s for _, touch in touched]) - 2.0 * SHORTEST_S
        )
        at = np.arange(len(pair))
        seen = poses.seen(first, second, at)
        gaps = self._bodies.gaps(first, second, seen, np.full(len(pair), _NEARER_M))
        places = Transform(poses.rotation[at, second], poses.translation[at, second])
        world = np.einsum("kij,kj->ki", places.rotation, gaps.point) + places.translation
        apart = np.isfinite(gaps.distances_found)
        return {key: world[k] for k, (key, _) in enumerate(touched) if apart[k]}

    def _depths(self, touched: Sequence[_Key]) -> dict[_Key, float]:
        """Return the largest depths [m] of pairs from their contact on, within the move."""
        # Until the end of the contact, in increasing steps.
        later = np.concatenate([[0.0], 0.002 * 1.25 ** np.arange(_DEPTHS)])
        found: dict[_Key, float] = {}
        some = max(1, _BLOCK // len(later))
        for begin in range(0, len(touched), some):
            keys = touched[begin : begin + some]
            pair, move = np.array(keys).T[..., None]
            start = np.array([[self._touch[key].time_s] for key in keys])
            poses = self._scene.poses((start + later).reshape(-1))
            shape = (len(keys), len(later))
            at = np.arange(len(poses.times)).reshape(shape)
            same = poses.moves[at, self._owner[pair]] == move
            same &= poses.times[at] <= np.maximum(self._until[pair], start)
            same = np.logical_and.accumulate(same, axis=1)
            first, second = (np.broadcast_to(one[pair], shape) for one in self._pair)
            deep = np.zeros(shape)
            seen = poses.seen(first[same], second[same], at[same])
            deep[same] = self._bodies.depths(first[same], second[same], seen, exact=False)
            lasting = np.logical_and.accumulate((deep > TOUCH_M) | (at == at[:, :1]), axis=1)
            best = np.where(lasting, deep, 0.0).argmax(axis=1)
            rows = np.arange(len(keys)), best
            seen = poses.seen(first[rows], second[rows], at[rows])
            exact = self._bodies.depths(first[rows], second[rows], seen, exact=True)
            found |= dict(zip(keys, exact.tolist(), strict=True))
        return found

    def _continued(self) -> set[_Key]:
        """Return contacts of pairs that touched in the previous move and still do at the start."""
        keys = [(p, move) for p, move in self._touch if (p, move - 1) in self._touch]
        found = self._of_earlier_owners()
        if not keys:
            return found
        times = np.array([self._touch[key].time_s for key in keys]) - 2.0 * SHORTEST_S
        moves = self._scene.poses(times).moves
        return found | {
            (p, move) for row, (p, move) in enumerate(keys) if moves[row, self._owner[p]] != move
        }

    def _of_earlier_owners(self) -> set[_Key]:
        """Return contacts at the start of a pair's interval, of bodies that touched before it."""
        touched = {(self._bodies_of(p), self._until[p]) for p, _ in self._touch}
        return {
            (p, move)
            for (p, move), touch in self._touch.items()
            if touch.time_s <= self._from[p] + SHORTEST_S
            and any(
                bodies == self._bodies_of(p) and until_s <= self._from[p]
                for bodies, until_s in touched
            )
        }

    def _bodies_of(self, pair: int) -> frozenset[int]:
        return frozenset({int(self._first[pair]), int(self._second[pair])})


def _first_of(order: Array, *keys: Index) -> Index:
    """Return the indices of the rows that are first in `order` among rows with equal keys (k,)."""
    rows = np.lexsort((order, *keys))
    change = np.zeros(len(rows), dtype=np.bool_)
    for key in keys:
        change |= np.diff(key[rows], prepend=-1) != 0
    return rows[change]
