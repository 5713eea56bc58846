"""Gives changed inputs to readers of files: each must be read, or refused by an `InputError` of one line.

`make fuzz COUNT=1000000 READERS="records mcap"` runs it with Atheris (libFuzzer for Python), which keeps inputs that
reach new code in FOLDER/READER and begins with them the next time. Without Atheris, or with --plain, inputs are changed
at random. An input that fails is kept in FOLDER/failures/READER.
"""

import argparse
import hashlib
import importlib.util
import logging
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from readers import Reader

MEMORY = 6 * 2**30
"""Bytes of address space; a reader that takes more fails."""
INPUT_S = 20.0
"""CPU seconds after which an input counts as a failure."""
MEMORY_FILES = Path("/dev/shm")  # noqa: S108 - folders in it have random names
"""Folder for files in memory: readers that write bring what they write to disk, which takes milliseconds."""
TURN = 50_000
"""Inputs of a process with Atheris."""
LARGEST = 2**20
"""Bytes of an input that Atheris makes."""
INSTRUMENTED = (
    "mrpbench_core",
    "mrpbench_league",
    "mrpbench_exporters_rosbag2",
    "mrpbench_controllers_dwb",
    "mrpbench_localizers_amcl",
    "mrpbench_localizers_slam",
)


class Run:
    """Reads inputs, counts them and keeps those that fail: one for each place where an exception comes from."""

    def __init__(self, reader: "Reader", corpus: Path) -> None:
        self.reader = reader
        self.failures = corpus / "failures" / reader.name
        self.corpus = corpus / reader.name
        self.corpus.mkdir(parents=True, exist_ok=True)
        self.count = self.refused = 0
        self.known: set[str] = set()
        self.refusals: set[int] = set()
        self.began, self.seconds = time.process_time(), 0.0
        self.folder = tempfile.TemporaryDirectory(prefix="mrpbench-fuzz-")
        self._file = Path(self.folder.name) / reader.file

    def read(self, data: bytes, *, again: bool = False) -> None:
        """Let the reader read one input, which counts unless it is read `again`."""
        from mrpbench_core.files.errors import InputError, InputErrors

        self.count += not again
        self._file.write_bytes(data)
        began = time.monotonic()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.reader.read(self._file)
        except (InputError, InputErrors) as error:
            self.refused += self.count > 0 and not again
            self.refusals.add(hash(data))
            if isinstance(error, InputError) and "\n" in str(error):
                self._keep(data, f"more than one line: {error!r}", "lines")
        except Exception as error:  # noqa: BLE001 - which is what this looks for
            frame = traceback.extract_tb(error.__traceback__)[-1]
            self._keep(data, traceback.format_exc(), f"{type(error).__name__} {frame.filename}:{frame.lineno}")
        if not again and time.monotonic() - began > INPUT_S:  # CPU time, which says what it took, takes 1 ms to ask for
            began = time.process_time()
            self.read(data, again=True)
            if (seconds := time.process_time() - began) > INPUT_S:
                self._keep(data, f"took {seconds:.0f} s", "time")

    def _keep(self, data: bytes, what: str, place: str) -> None:
        if place in self.known:
            return
        self.known.add(place)
        self.failures.mkdir(parents=True, exist_ok=True)
        file = self.failures / hashlib.sha256(data).hexdigest()[:16]
        file.write_bytes(data)
        print(f"FAILED {self.reader.name}: {what}\n  the input is {file}", flush=True)

    def over(self, inputs: int, seconds: float) -> bool:
        """Whether as many inputs were read, or as much CPU time taken."""
        if self.count % 100 == 0 or self.count >= inputs:
            self.seconds = time.process_time() - self.began
        return self.count >= inputs or self.seconds >= seconds

    def end(self) -> int:
        """Print what was read; 1 if something failed."""
        self.folder.cleanup()
        print(
            f"{self.reader.name}: {self.count} inputs, {self.refused} refused, {len(self.known)} failures,"
            f" {time.process_time() - self.began:.1f} s of CPU",
            flush=True,
        )
        return 1 if self.known else 0


def read_at_random(run: Run, inputs: int, seconds: float, seed: int) -> int:
    """Read examples and what earlier runs kept, then changes of them."""
    rng = random.Random(seed)
    pool = [*run.reader.seeds(), *(file.read_bytes() for file in sorted(run.corpus.iterdir()))]
    for data in pool:
        run.read(data)
    while not run.over(inputs, seconds):
        data = rng.choice(pool)
        for _ in range(rng.choice((1, 1, 1, 2, 5))):
            data = run.reader.mutate(data, rng)
        run.read(data)
    return run.end()


def read_covering(run: Run, inputs: int, seconds: float, seed: int) -> None:
    """Read what Atheris makes; it ends the process. What earlier ones kept is read again, and does not count."""
    import atheris

    run.count = -len(list(run.corpus.iterdir()))
    begin = Path(run.folder.name) / "seeds"
    begin.mkdir()
    for number, data in enumerate(run.reader.seeds()):
        (begin / str(number)).write_bytes(data)
    rng = random.Random(seed)
    sound = {hash(data): data for data in run.reader.seeds()}

    def change(data: bytes, largest: int, _seed: int) -> bytes:
        """Mostly a change of an input that was not refused: what is changed in a broken zip is never reached."""
        if hash(data) not in run.refusals:
            sound[hash(data)] = data
        elif rng.random() < 0.9:
            data = rng.choice(list(sound.values()))
        changed = run.reader.mutate(data, rng) if rng.random() < 0.8 else atheris.Mutate(data, largest)
        return bytes(changed[:largest])

    def read(data: bytes) -> None:
        run.read(data)
        if run.over(inputs, seconds):
            os._exit(run.end())

    kept = run.failures.parent
    kept.mkdir(exist_ok=True)
    options = [f"-seed={seed}", f"-max_len={LARGEST}", "-rss_limit_mb=0", "-timeout=600", "-mutate_depth=1"]
    options += [f"-artifact_prefix={kept}/", "-report_slow_units=600"]
    atheris.Setup([sys.argv[0], *options, str(run.corpus), str(begin)], read, custom_mutator=change)
    atheris.Fuzz()


def in_turns(reader: str, given: argparse.Namespace) -> int:
    """Let child processes read with Atheris, which keeps the memory of each input that a mutator returned."""
    worst = 0
    for number, read in enumerate(range(0, given.inputs, TURN)):
        inputs = min(TURN, given.inputs - read)
        shares = {"inputs": inputs, "seconds": given.seconds * inputs / given.inputs, "seed": given.seed + number}
        options = [f"--{name}={value}" for name, value in {**shares, "corpus": given.corpus}.items()]
        done = subprocess.run([sys.executable, __file__, reader, "--turn", *options], check=False)
        worst = max(worst, abs(done.returncode))
    return worst


def main() -> int:
    """Read changed inputs with the readers that are named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("readers", nargs="*", metavar="READER", help="default: all")
    parser.add_argument("--inputs", type=int, default=20_000, help="for each reader (default: %(default)s)")
    parser.add_argument("--seconds", type=float, default=1e9, help="of CPU for each reader, at most")
    parser.add_argument(
        "--corpus", type=Path, default=Path("build/fuzz"), metavar="FOLDER", help="default: %(default)s"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--turn", action="store_true", help=argparse.SUPPRESS)  # for one reader
    parser.add_argument("--plain", action="store_true", help="change inputs at random, without regard to coverage")
    given = parser.parse_args()
    covering = not given.plain and importlib.util.find_spec("atheris") is not None
    if not covering and not given.plain:
        print("Atheris is not installed, so inputs are changed at random, without regard to coverage")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    logging.disable()
    if MEMORY_FILES.is_dir():
        tempfile.tempdir = str(MEMORY_FILES)
    if covering and given.turn:
        import atheris

        with atheris.instrument_imports(include=list(INSTRUMENTED)):
            from readers import READERS

            run = Run(READERS[given.readers[0]], given.corpus)
            for data in run.reader.seeds():
                run.read(data)  # which imports the rest
        read_covering(run, given.inputs, given.seconds, given.seed)
    from readers import READERS

    unknown = [name for name in given.readers if name not in READERS]
    if unknown:
        parser.error(f"no reader is named {', '.join(unknown)}; there are {', '.join(READERS)}")
    names = given.readers or list(READERS)
    if covering:
        return max(in_turns(name, given) for name in names)
    runs = (Run(READERS[name], given.corpus) for name in names)
    return max([read_at_random(run, given.inputs, given.seconds, given.seed) for run in runs])


if __name__ == "__main__":
    sys.exit(main())
