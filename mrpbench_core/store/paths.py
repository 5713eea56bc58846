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
    def partial(self) -> Path:
        """The unfinished recording."""
        return self.recording.with_name(f".{self.recording.name}.partial")
