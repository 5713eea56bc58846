"""What is not published, and why."""

import json
from pathlib import Path

import pytest
from mrpbench_publish.bundles.sample import drawn

from mrpbench_core import run
from mrpbench_core.files.errors import InputError, InputErrors


def refused(bundle, folder, **options):
    with pytest.raises((InputError, InputErrors)) as error:
        bundle(folder / "results", folder / "out.zip", inputs=folder, **options)
    assert not (folder / "out.zip").exists()
    return str(error.value)


def edit(folder, change):
    shard = next((folder / "results" / "runs").iterdir())
    records = [json.loads(line) for line in shard.read_text().splitlines()]
    change(records)
    shard.write_text("".join(json.dumps(record) + "\n" for record in records))


def test_an_unfinished_study(copied, bundle):
    edit(copied, lambda records: records.pop())
    assert "1 run of 4 of the study have no record" in refused(bundle, copied)


def test_runs_of_another_study(copied, bundle):
    edit(copied, lambda records: records.append(records[0] | {"run_id": "0123"}))
    assert "do not follow from the studies" in refused(bundle, copied)


def test_mixed_versions(copied, bundle):
    edit(copied, lambda records: records[0]["provenance"]["versions"].update(numpy="0.1"))
    assert "the records have several versions: numpy 0.1 and" in refused(bundle, copied)


def test_a_run_in_two_folders(copied, bundle):
    with pytest.raises(InputError, match="is also in"):
        bundle([copied / "results", Path(str(copied / "results"))], copied / "out.zip", inputs=copied)


def test_a_recording_that_was_edited(copied, bundle):
    file = next((copied / "results" / "recordings").iterdir())
    file.write_bytes(file.read_bytes() + b"more")
    assert "differs from the recording of the run" in refused(bundle, copied)


def test_a_recording_that_is_gone_unless_none_is_asked_for(copied, bundle):
    next((copied / "results" / "recordings").iterdir()).unlink()
    assert "is no longer there" in refused(bundle, copied)
    bundle(copied / "results", copied / "out.zip", inputs=copied, recordings=0.0)


def test_a_map_that_is_gone(copied, bundle):
    (copied / "maps" / "tiny.map").unlink()
    assert "tiny.map" in refused(bundle, copied)


def test_another_folder_of_the_configuration(copied, bundle):
    (copied / "other").mkdir()
    (copied / "maps").rename(copied / "other" / "maps")
    with pytest.raises(InputErrors, match=r"no such file|tiny.map"):
        bundle(copied / "results", copied / "out.zip", inputs=copied)


def test_invocations_without_document(copied, bundle):
    next((copied / "results" / "invocations").iterdir()).unlink()
    assert "its invocation has no document" in refused(bundle, copied)


def test_a_local_plugin_that_changed(study, bundle):
    run(study, out="out")
    file = Path("odd.py")
    file.write_text(file.read_text() + "# changed\n")
    with pytest.raises(InputError, match="has changed since run"):
        bundle(Path("out"), Path("out.zip"))


def test_a_share_is_drawn_by_ids_alone():
    ids = [f"{number:x}" for number in range(100)]
    assert drawn(ids, 0.1) == drawn(reversed(ids), 0.1)
    assert len(drawn(ids, 0.101)) == 11
    assert set(drawn(ids, 0.1)) < set(drawn(ids, 0.3))
    assert drawn(ids, 0.1, "1") != drawn(ids, 0.1, "2")
    assert drawn(ids, 0.0) == []


def test_an_input_that_is_left_out_is_given_by_the_verifier(copied, bundle, outcomes, judged):
    written = bundle(copied / "results", copied / "out.zip", inputs=copied, left_out=("*.map",))
    assert written.notes == ("maps/tiny.map is left out; `mrpbench verify --inputs DIR` takes it from DIR",)
    checks = outcomes(copied / "out.zip")
    assert checks["study"] == ("not checked", "the bundle leaves out 1 input (maps/tiny.map); --inputs DIR gives them")
    assert checks["records"][0] == "passed"
    assert judged(copied / "out.zip", inputs=copied, rerun=0.5) == {}
    assert outcomes(copied / "out.zip", inputs=copied)["scenarios"][0] == "passed"
    (copied / "maps" / "tiny.map").write_text("type octile\nheight 1\nwidth 3\nmap\n...\n")
    with pytest.raises(InputError, match=r"tiny\.map: is not the file that the bundle leaves out"):
        judged(copied / "out.zip", inputs=copied)


def test_a_pattern_that_matches_no_input(copied, bundle):
    assert "--leave-out *.scen matches no input (inputs: maps/tiny.map)" in refused(
        bundle, copied, left_out=("*.scen",)
    )
