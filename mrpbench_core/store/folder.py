"""The layout of a results folder.

```
study.yaml                    configuration of the latest invocation
invocations/<id>.yaml         configuration, versions, machine and metric columns of each
runs/<id>.jsonl               records, one file per invocation
recordings/<run_id>.zip       exports/<run_id>/      logs/<run_id>.txt
instances/<sha256>            worlds, roadmaps and scenarios of the recordings
```
The files of attempt k above 1 are `recordings/<run_id>-<k>.zip` and `exports/<run_id>-<k>/`, so that the files of an
attempt stay until the record of the next one is on disk.

Merging two folders is copying the files of one into the other.
"""

import secrets
from datetime import UTC, datetime
from pathlib import Path

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.links import followed
from mrpbench_core.files.printing import file_name
from mrpbench_core.files.removal import remove_tree
from mrpbench_core.store.paths import RunPaths

_ATTEMPTS = 100
"""Earlier attempts whose files are looked for."""
PARTS = ("invocations", "runs", "instances", "recordings", "exports", "logs")


@attrs.frozen
class ResultsFolder:
    """Paths inside a results folder, all absolute."""

    path: Path = attrs.field(converter=followed)

    @property
    def study(self) -> Path:
        """Configuration of the latest invocation."""
        return self.path / "study.yaml"

    def invocation(self, invocation: str) -> Path:
        """The study, the versions and the machine of each invocation."""
        return self.path / "invocations" / f"{invocation}.yaml"

    def shard(self, invocation: str) -> Path:
        """The records of an invocation."""
        return self.path / "runs" / f"{invocation}.jsonl"

    def shards(self) -> list[Path]:
        """All files of records, oldest first."""
        return sorted((self.path / "runs").glob("*.jsonl"))

    def run(self, run_id: str, attempt: int = 1) -> RunPaths:
        """Files of an attempt of a run."""
        name = file_name(run_id) if attempt == 1 else f"{file_name(run_id)}-{attempt}"
        return RunPaths(recording=self.path / "recordings" / f"{name}.zip", exports=self.path / "exports" / name)

    def log(self, run_id: str) -> Path:
        """The log file of a run, with the output of its plugins."""
        return self.path / "logs" / f"{file_name(run_id)}.txt"

    @property
    def instances(self) -> Path:
        """The instances of the runs; see `mrpbench_core.store.instances`."""
        return self.path / "instances"

    def replay(self, *run_ids: str) -> Path:
        """The page with the replay of a run, or of several side by side."""
        return self.path / f"replay-{'-'.join(file_name(run_id[:12]) for run_id in run_ids)}.html"

    def create(self) -> None:
        """Make the folder and its parts.

        Raises:
            InputError: it cannot be made, or it holds something else.
        """
        try:
            if self.path.is_dir() and not (self.path / "runs").is_dir() and any(self.path.iterdir()):
                raise InputError(
                    "is not empty and is not a results folder", file=self.path, hint="choose another --out"
                )
            for part in PARTS:
                (self.path / part).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"cannot be made: {error.strerror}", file=error.filename or self.path) from error

    def forget(self, run_id: str, attempt: int) -> None:
        """Remove the recording and the exports of an attempt, finished or not.

        Raises:
            OSError: something else is in their place, such as a folder where a file should be.
        """
        paths = self.run(run_id, attempt)
        paths.partial.unlink(missing_ok=True)
        paths.recording.unlink(missing_ok=True)
        if paths.exports.exists():
            remove_tree(paths.exports)

    def sweep(self) -> None:
        """Remove unfinished files of an invocation that was killed; only under the lock.

        Raises:
            OSError: one cannot be removed.
        """
        unfinished = [
            *self.path.glob(".*.partial"),
            *self.path.glob("invocations/.*.partial"),
            *self.path.glob("instances/.*.partial"),
        ]
        for part in ("recordings", "exports"):
            unfinished += (self.path / part).rglob(".*.partial")
        for partial in unfinished:
            if partial.is_dir() and not partial.is_symlink():
                remove_tree(partial)
            else:
                partial.unlink(missing_ok=True)

    def forget_before(self, run_id: str, attempt: int) -> None:
        """Remove the files of the attempts before one whose record is on disk.

        Raises:
            OSError: one cannot be removed.
        """
        for earlier in range(max(1, attempt - _ATTEMPTS), attempt):
            self.forget(run_id, earlier)


def new_invocation() -> str:
    """A name that sorts by time and that no other invocation has, on any machine."""
    return f"{datetime.now(UTC):%Y%m%dT%H%M%S.%fZ}-{secrets.token_hex(4)}"
