"""Motion in outputs: letters per step (2023, 2024), or run lengths in segments (2026)."""

import re
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.model.common.arrays import Byte, Int32

FORWARD, CLOCKWISE, COUNTER_CLOCKWISE, WAIT, LATE = (ord(letter) for letter in "FRCWT")
"""Letters of actions. `LATE` stands for a step for which no answer came in time: the robot waits."""
_KNOWN = np.isin(np.arange(256), [FORWARD, CLOCKWISE, COUNTER_CLOCKWISE, WAIT, LATE])
_SEGMENT = re.compile(r"\[\((\d{1,9}),(\d{1,9}),(\d{1,9}),([0-3]),(\d{1,9})\):\(([^()\[\]]*)\)\]")
_RUN = re.compile(r"\s*([FRCWT]) (\d{1,9})\s*")


class Motion(NamedTuple):
    """What a robot does in each step or tick, and the ticks at which its segments begin."""

    letters: Byte
    """u1[T] ASCII letters."""
    begins: tuple[tuple[int, int], ...] = ()
    """For each segment: its first tick as the file says, and its number of ticks."""


def parse_steps(text: str) -> Motion:
    """Read `F,R,C,W`.

    Raises:
        ValueError: a letter is unknown.
    """
    letters = np.frombuffer(text.encode("ascii", "replace"), np.uint8)[::2] if text else np.zeros(0, np.uint8)
    if text and (len(text) % 2 == 0 or text.count(",") != len(text) // 2 or not _KNOWN[letters].all()):
        raise ValueError("should be letters F, R, C, W or T with commas between them")
    return Motion(letters)


def parse_segments(text: str, longest: int) -> Motion:
    """Read `[(tick,row,column,heading,counter):(F 6,W 2)]…` of at most `longest` ticks.

    Raises:
        ValueError: the text has another form.
    """
    place, total = 0, 0
    letters: list[NDArray[np.uint8]] = []
    begins: list[tuple[int, int]] = []
    while place < len(text):
        segment = _SEGMENT.match(text, place)
        if segment is None:
            raise ValueError(f"should be [(tick,row,column,heading,counter):(F 6,W 2)] at character {place + 1}")
        ticks = 0
        for part in segment[6].split(",") if segment[6].strip() else ():
            run = _RUN.fullmatch(part)
            if run is None:
                raise ValueError(f"{part!r} should be a letter F, R, C, W or T and a number of ticks")
            ticks += int(run[2])
            if total + ticks > longest:
                raise ValueError(f"has more than {longest} ticks, which is the makespan")
            letters.append(np.full(int(run[2]), ord(run[1]), np.uint8))
        begins.append((int(segment[1]), ticks))
        total += ticks
        place = segment.end()
    return Motion(np.concatenate(letters) if letters else np.zeros(0, np.uint8), tuple(begins))


def write_steps(letters: Byte) -> str:
    """Return u1[T] letters as `F,R,C,W`."""
    return ",".join(letters.tobytes().decode("ascii"))


def write_segments(letters: Byte, states: Int32, length: int) -> str:
    """Return letters u1[T] in segments of `length` ticks, the first from tick 0, as PlanViz needs them.

    Args:
        letters: u1[T].
        states: i4[ceil(T / length),4]: row, column, heading and counter at the beginning of each segment.
        length: ticks of a segment.
    """
    parts = []
    for index, begin in enumerate(range(0, len(letters), length)):
        row, column, heading, counter = states[index].tolist()
        part = letters[begin : begin + length]
        changes = np.flatnonzero(np.diff(part)) + 1
        bounds = [0, *changes.tolist(), len(part)]
        runs = ",".join(f"{chr(part[a])} {b - a}" for a, b in pairwise(bounds))
        parts.append(f"[({begin},{row},{column},{heading},{counter}):({runs})]")
    return "".join(parts)
