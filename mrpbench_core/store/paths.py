"""The paths of the files of one run."""

from pathlib import Path

import attrs


@attrs.frozen(kw_only=True)
class RunPaths:
    """Files of one run. Writers use the name `.<name>.partial` and rename before the run's record is kept."""

    recording: Path
    """`recordings/<run_id>.zip`."""
    exports: Path
    """Folder `exports/<run_id>/`."""
    picture: Path | None = None
