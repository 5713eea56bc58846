"""The paths of the files of one run."""

from pathlib import Path

import attrs


@attrs.frozen(kw_only=True)
class RunPaths:
    """Files of one attempt of a run. Writers use the name `.<name>.partial` and rename before its record is kept."""

    recording: Path
    """`recordings/<run_id>.zip`; see `ResultsFolder.run`."""
    exports: Path
    """Folder `exports/<run_id>/`."""
    picture: Path | None = None

    @property
    def instances(self) -> Path:
        """Folder with the instance of the run."""
        return instances_of(self.recording)

    @property
    def partial(self) -> Path:
        """The unfinished recording."""
        return self.recording.with_name(f".{self.recording.name}.partial")


def instances_of(recording: Path) -> Path:
    """The folder of instances that belongs to a recording: beside `recordings/`, or beside a recording elsewhere."""
    folder = recording.absolute().parent
    return (folder.parent if folder.name == "recordings" else folder) / "instances"
