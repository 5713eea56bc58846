"""A distribution with damaged metadata costs no other plugin, and is named."""

import pytest

from mrpbench_core.api import Planner
from mrpbench_core.cli.main import main
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins import installed
from mrpbench_core.plugins.registry import Registry

PLANNERS = "[mrpbench.planners]\nodd = acme_odd:Odd\n"
METADATA = "Metadata-Version: 2.1\nName: acme-odd\nVersion: 1.0\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The empty folder for the metadata of a distribution, on the path before all others."""
    found = tmp_path / "acme_odd-1.0.dist-info"
    found.mkdir()
    monkeypatch.syspath_prepend(str(tmp_path))
    yield found
    monkeypatch.undo()
    installed.refresh()


@pytest.mark.parametrize("content", [bytes(range(256)), PLANNERS.encode("utf-16"), None])
def test_entry_points_that_cannot_be_read_are_told_by_the_list(folder, content, capsys, caplog):
    file = folder / "entry_points.txt"
    file.symlink_to(file) if content is None else file.write_bytes(content)
    (folder / "METADATA").write_text(METADATA)
    installed.refresh()
    assert main(["plugins", "planner"]) == 0
    assert "example" in capsys.readouterr().out
    (line,) = caplog.messages
    assert line.startswith("acme_odd-1.0.dist-info has entry points that cannot be read: ")
    with pytest.raises(SystemExit):
        main(["--help"])
    assert "\n  publish " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("metadata", "problem"),
    [
        (bytes(range(256)), "has metadata that cannot be read: UnicodeDecodeError"),
        (None, "has metadata"),  # without a name, or that cannot be read: it depends on the version of the reader
        (b"", "has metadata"),
        (b"Metadata-Version: 2.1\nName: acme-odd\n", "has metadata without a name or a version"),
        (b"Metadata-Version: 2.1\nName: ../etc\nVersion: 1.0\n", "is not found by the name in its metadata"),
    ],
)
def test_plugins_of_damaged_distributions_are_refused_by_name(folder, metadata, problem, capsys):
    (folder / "entry_points.txt").write_text(PLANNERS)
    if metadata is not None:
        (folder / "METADATA").write_bytes(metadata)
    installed.refresh()
    with pytest.raises(InputError, match=r"planner 'odd' of .* ") as caught:
        Registry(Planner).get("odd")
    assert problem in str(caught.value)
    assert Registry(Planner).get("example").__name__ == "Example"
    assert main(["info"]) == 0
    assert "acme_odd-1.0.dist-info" in capsys.readouterr().out or b"Name: " in metadata
