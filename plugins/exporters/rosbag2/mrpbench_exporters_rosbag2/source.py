"""What a recording says again and again on one topic: a template and the channels that fill it."""

from collections.abc import Callable, Iterator, Mapping

import attrs

from mrpbench_core.model.arrays import Float
from mrpbench_core.model.recording import Chunk
from mrpbench_exporters_rosbag2.messages import Topic, nanoseconds
from mrpbench_exporters_rosbag2.template import Template, hole

Rows = tuple[Float, Mapping[str, Float]]
"""Times f8[k] in simulated seconds and the values of each hole at them."""

POSE, TWIST = hole(7), hole(6)
"""Where poses (as of `messages.spatial`) and twists go in templates."""


@attrs.frozen
class Source:
    """Makes the messages of one topic."""

    topic: Topic
    template: Template
    rows: Callable[[Chunk], Rows | None]
    """None where a block lacks the channels."""

    def messages(self, block: Chunk, start: int) -> Iterator[tuple[int, bytes]]:
        """Stamp (nanoseconds) and bytes of each message of a block, in order of time."""
        found = self.rows(block)
        if found is None or not len(found[0]):
            return
        stamps = nanoseconds(found[0]) + start
        yield from zip(stamps.tolist(), self.template.fill(stamps, **found[1]), strict=True)
