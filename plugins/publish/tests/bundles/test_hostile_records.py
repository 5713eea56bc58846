"""Records of strangers may hold anything of the types that a reader accepts: every check names it or passes."""

import copy
import json
from types import SimpleNamespace

import pytest
from mrpbench_publish.bundles.checks.bag import description_faults, file_faults
from mrpbench_publish.bundles.checks.code import code_faults
from mrpbench_publish.bundles.checks.records import (
    record_faults,
    scenario_faults,
    status_faults,
    timing_faults,
)
from mrpbench_publish.bundles.checks.repetition import repetition_faults, same_platform
from mrpbench_publish.bundles.checks.study import Asked, study_faults, uses_local_code
from mrpbench_publish.bundles.opened import open_bundle
from mrpbench_publish.files.archive import unpack

VALUES = (None, "x", "os:system", -1, 1e300, True, [], [[1]], {}, {"a": {"b": []}})


def paths(value, before=()):
    """Yield the place of every value in plain data."""
    yield before
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from paths(inner, (*before, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value[:2]):
            yield from paths(inner, (*before, index))


def replaced(value, path, by):
    """Return plain data with another value at a place."""
    found = copy.deepcopy(value)
    inner = found
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1]] = by
    return found


def checks(bundle, honest):
    """Run every check that reads records, without worker processes."""
    records = [stored for stored in bundle.records() if stored.counts]
    columns = {name: document["columns"] for name, document in bundle.documents.by_name.items()}
    point = SimpleNamespace(run_id=honest["run_id"], canonical=honest["config"], code=honest["provenance"])
    study = SimpleNamespace(runs=(point,), errors=(), columns={})
    asked = Asked(by_name={name: SimpleNamespace(study=study, files=()) for name in columns}, faults=())
    for stored in records:
        list(status_faults(stored, columns.get(stored.shard, {})))
        list(timing_faults(stored))
        same_platform(stored)
        uses_local_code(stored.record["config"])
    for found in (record_faults(bundle), scenario_faults(records)):
        list(found)
    list(study_faults(bundle, asked, records))
    list(code_faults(bundle, asked, records))
    list(repetition_faults([(stored, honest) for stored in records]))


def test_no_value_of_a_record_breaks_a_check(honest, tmp_path):
    unpack(honest / "tiny.zip", tmp_path)
    (top,) = (path for path in tmp_path.iterdir() if path.is_dir())
    shard = next((top / "data/results/runs").iterdir())
    record = json.loads(shard.read_text().splitlines()[0])
    shard.write_text(json.dumps(record) + "\n")
    interesting = [path for path in paths(record) if len(path) == 1 or (path and path[0] not in ("metrics", "run_id"))]
    bundle = open_bundle(top)
    assert len(bundle.results) == 1  # found once, at the place at which all others are written
    faults = {}
    for path in interesting:
        if path[0] == "config" and len(path) > 3:
            continue
        for value in VALUES:
            shard.write_text(json.dumps(replaced(record, path, value)) + "\n")
            try:
                checks(bundle, record)
            except Exception as error:  # noqa: BLE001 - any is a defect
                faults.setdefault(repr(error), (path, value))
    assert faults == {}


@pytest.mark.parametrize(
    "name", ["bag-info.txt", "data/ro-crate-metadata.json", "data/inputs.json", "data/CITATION.cff"]
)
@pytest.mark.parametrize(
    "content", [b"", b"\xff\xfe", b"[" * 100_000, b"{}", b'{"folder": "..", "absolute": {}}', b": :"]
)
def test_no_tag_file_breaks_a_check(honest, tmp_path, name, content):
    from mrpbench_core.files.errors import InputError

    unpack(honest / "tiny.zip", tmp_path)
    (top,) = (path for path in tmp_path.iterdir() if path.is_dir())
    (top / name).write_bytes(content)
    try:
        bundle = open_bundle(top)
    except InputError:
        return
    assert list(file_faults(bundle))
    assert name == "data/inputs.json" or list(description_faults(bundle))


def test_a_left_out_name_that_leads_elsewhere_is_not_copied(forger, tmp_path, outcomes):
    file = forger.top / "data" / "inputs.json"
    file.write_text(json.dumps({"folder": ".", "absolute": {}, "left_out": {"../../../../taken": "0" * 64}}))
    (tmp_path / "a" / "b" / "c" / "d").mkdir(parents=True)
    (tmp_path / "taken").write_text("x")
    checks = outcomes(forger.pack(), inputs=tmp_path / "a" / "b" / "c" / "d")
    assert checks["inputs"][0] == "not checked"
