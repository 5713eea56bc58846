"""Reads one bag: its messages become one track per robot."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import attrs

from mrpbench_core.api.format import SOURCES, Observed, Track
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_exporters_rosbag2.messages import SECOND
from mrpbench_exporters_rosbag2.reading.collected import Collected, Patterns
from mrpbench_exporters_rosbag2.reading.mrpbench_topics import MrpbenchTopics
from mrpbench_exporters_rosbag2.reading.names import natural, robot_in, wanted, without_robot
from mrpbench_exporters_rosbag2.reading.series import Ordered, Span, longest_even_span
from mrpbench_exporters_rosbag2.reading.signals import Signals
from mrpbench_exporters_rosbag2.reading.stream import Stream
from mrpbench_exporters_rosbag2.reading.transforms import placed

if TYPE_CHECKING:
    from mrpbench_exporters_rosbag2.rosbag2 import Rosbag2

ESTIMATES = ("tf", "amcl_pose")
"""Sources of estimated poses, the best first."""
SHOWN = 12
"""Topics that a message lists."""


@attrs.frozen
class BagReader:
    """Reads a bag with the message definitions that it holds."""

    recipe: "Rosbag2"

    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Read the bag at `path`, a folder or a storage file."""
        with Stream(path) as stream:
            topics = stream.topics
            for alone in (False, True):
                patterns, bases = self._patterns(alone)
                collected, signals = Collected(), Signals(patterns=self._signals(alone))
                ours = MrpbenchTopics(topics, signals)
                takers = (patterns.takers(topics, collected), signals.takers(topics), ours.takers())
                takes = {
                    topic: [taker[topic] for taker in takers if topic in taker] for taker in takers for topic in taker
                }
                for topic, logged, message in stream.messages(takes):
                    for take in takes[topic]:
                        try:
                            take(logged, message)
                        except (ValueError, TypeError, AttributeError, LookupError, OverflowError) as error:
                            stream.complete = False
                            stream.notes.append(f"{topic}: a message is damaged and was not read ({one_line(error)})")
                span, notes = self._span(collected)
                best = self._best(collected, span, bases, robots, SOURCES)
                if best:
                    begin = ours.begin
                    if begin is None:
                        begin = min(int(placed.poses.stamps[0]) for placed in best)
                    tracks = tuple(placed.track(begin) for placed in best)
                    names = {track.robot for track in tracks}
                    clocks = {robot: series for (robot, _), series in collected.poses.items() if series.stamps}
                    anybody = next(series for series in collected.series if series.stamps)
                    believed = self._best(collected, span, bases, robots, ESTIMATES)
                    return Observed(
                        tracks=tracks,
                        estimates=tuple(placed.track(begin) for placed in believed),
                        signals=tuple(s for s in signals.placed(clocks, anybody, span, begin) if s.robot in names),
                        context=ours.context,
                        channels=ours.channels(),
                        complete=stream.complete,
                        notes=tuple(dict.fromkeys((*stream.notes, *ours.notes, *notes))),
                    )
            raise self._nothing(path, robots, topics, stream.notes)

    def _patterns(self, alone: bool) -> tuple[Patterns, tuple[str, ...]]:
        """The patterns of topics, and those of base frames; of a lone robot, or of robots that have names."""
        options = self.recipe
        sources = ("ground_truth", "amcl_pose", "odometry")
        by_source: dict[str, tuple[str, ...]] = {source: getattr(options, source) for source in sources}
        bases = options.base_frames
        if alone:
            by_source = {source: without_robot(patterns) for source, patterns in by_source.items()}
            bases = without_robot(bases)
        states, fleet = options.fleet_states, options.fleet
        return Patterns(by_source=by_source, tf=options.tf, fleet_states=states, fleet=fleet), bases

    def _signals(self, alone: bool) -> dict[str, tuple[str, ...]]:
        """The patterns of topics by channel."""
        by_channel = {
            "truth": self.recipe.ground_truth,
            "odometry": self.recipe.odometry,
            "command": self.recipe.command,
            "scan_ranges": self.recipe.scan,
        }
        return {channel: without_robot(patterns) if alone else patterns for channel, patterns in by_channel.items()}

    def _span(self, collected: Collected) -> tuple[Span, list[str]]:
        """Return the part of the bag that is used, and notes about it."""
        span = longest_even_span(collected.series)
        notes = [] if span.note is None else [span.note]
        if span.use_log:
            notes.append("a topic has no stamps, so log times were used for all")
        notes += [f"{one.topic}: {one.refused} poses are not finite" for one in collected.series if one.refused]
        return span, notes

    def _best(
        self,
        collected: Collected,
        span: Span,
        bases: tuple[str, ...],
        chosen: tuple[str, ...],
        order: tuple[str, ...],
    ) -> list["Placed"]:
        """Poses of every robot by the first source that it has."""
        robots = {robot for robot, _ in collected.poses}
        robots |= {robot for tree, child in collected.frames if (robot := self._robot(tree, child, bases)) is not None}
        best_of_robots = []
        for robot in sorted((robot for robot in robots if wanted(robot, chosen)), key=natural):
            for source in order:
                if (best := self._poses(collected, span, bases, robot, source)) is not None:
                    best_of_robots.append(Placed(robot, source, *best))
                    break
        return best_of_robots

    def _robot(self, tree: str, child: str, bases: tuple[str, ...]) -> str | None:
        if tree:
            return tree if robot_in(child, without_robot(bases)) is not None else None
        return robot_in(child, bases)

    def _poses(
        self, collected: Collected, span: Span, bases: tuple[str, ...], robot: str, source: str
    ) -> tuple[str, bool, Ordered] | None:
        """Topic, whether the poses are in `map`, and the poses of a robot by one source, or None."""
        if source != "tf":
            series = collected.poses.get((robot, source))
            poses = None if series is None else series.ordered(span.use_log, span.since, span.until)
            if series is None or poses is None:
                return None
            return series.topic, source != "odometry" or series.frame == self.recipe.map_frame, poses
        for tree in ("", robot):
            edges = dict(_edges(collected, span, tree))
            for frame in bases:
                base = (frame if not tree else without_robot((frame,))[0]).replace("{robot}", robot)
                poses = placed(edges, base, self.recipe.map_frame)
                if poses is not None:
                    return f"{f'/{tree}' if tree else ''}/tf: {self.recipe.map_frame} to {base}", True, poses
        return None

    def _nothing(self, path: Path, robots: tuple[str, ...], topics: dict[str, str], notes: list[str]) -> InputError:
        """Return the error that says why there is no track."""
        listed = [f"{topic} ({kind.replace('/msg/', '/')})" for topic, kind in sorted(topics.items())]
        more = f" and {len(listed) - SHOWN} more" if len(listed) > SHOWN else ""
        there = f"its topics are {', '.join(listed[:SHOWN])}{more}" if listed else "it holds no messages"
        names = f" that {' or '.join(robots)} names" if robots else ""
        damage = f" ({'; '.join(notes)})" if notes else ""
        return InputError(
            f"holds no pose of any robot{names}{damage}: {there}",
            file=path,
            hint="name topics by patterns, e.g. --option 'odometry=[/{robot}/odometry/filtered]'",
        )


def _edges(collected: Collected, span: Span, tree: str) -> Iterator[tuple[str, tuple[str, Ordered]]]:
    """Frames of a tree with their parents and poses."""
    for (owner, child), series in collected.static.items():
        if owner == tree and (poses := series.ordered(False, -(2**63), 2**63 - 1)) is not None:
            yield child, (series.frame, Ordered(poses.stamps[-1:], poses.rows[-1:]))
    for (owner, child), series in collected.frames.items():
        if owner == tree and (poses := series.ordered(span.use_log, span.since, span.until)) is not None:
            yield child, (series.frame, poses)


@attrs.frozen
class Placed:
    """Poses of a robot by one source."""

    robot: str
    source: str
    topic: str
    in_map: bool
    poses: Ordered

    def track(self, begin: int) -> Track:
        """Them with times since `begin`, nanoseconds."""
        return Track(
            robot=self.robot,
            source=self.source,
            topic=self.topic,
            placed=self.in_map,
            time=(self.poses.stamps - begin) / SECOND,
            pose=self.poses.rows[:, :3],
            height=self.poses.rows[:, 3],
            levels=self.poses.levels,
        )
