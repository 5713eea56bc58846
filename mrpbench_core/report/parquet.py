"""Writes runs to a Parquet file, one row per run."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import pip
from mrpbench_core.files.jsonl import line
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.report.reading.runs import each_once, read_runs
from mrpbench_core.store.results import Results, flatten

_AT_ONCE = 2000
"""Number of rows in a row group, which limits memory."""


def write_parquet(folders: Sequence[Results], file: Path) -> None:
    """Write all runs; options, metrics and timing are columns of dotted names. Lists are written as JSON.

    Raises:
        InputError: pyarrow is not installed, or the file cannot be written.
    """
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        raise InputError("--parquet needs pyarrow", hint=pip("parquet")) from None
    refuted = _refuted(folders)
    kinds: dict[str, set[type]] = {}
    for _, record in each_once(folders):
        for key, value in _row(record | refuted.get(record["run_id"], {})).items():
            kinds.setdefault(key, set()).add(type(value))
    schema = pa.schema([(key, _arrow(pa, types - {type(None)})) for key, types in kinds.items()])
    text = {field.name for field in schema if field.type == pa.string()}
    try:
        with pq.ParquetWriter(file, schema, compression="zstd") as writer:
            rows: list[dict[str, Any]] = []
            for _, record in each_once(folders):
                row = _row(record | refuted.get(record["run_id"], {}))
                rows.append({key: _text(value) if key in text else value for key, value in row.items()})
                if len(rows) == _AT_ONCE:
                    writer.write_table(pa.Table.from_pylist(rows, schema))
                    rows = []
            writer.write_table(pa.Table.from_pylist(rows, schema))
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from error


def _refuted(folders: Sequence[Results]) -> dict[str, dict[str, Any]]:
    """Return status and error of each run whose promise other runs refute."""
    runs = read_runs(folders, ())
    return {
        run_id: {"status": str(status), "error": {"stage": str(Stage.CHECKING), "message": message}}
        for run_id, status, message in zip(runs.run_id, runs.status, runs.message, strict=True)
        if status == RunStatus.PROMISE_BROKEN
    }


def _row(record: dict[str, Any]) -> dict[str, Any]:
    flat = flatten({key: value for key, value in record.items() if key != "provenance"})
    return {key: line({"": value})[4:-1] if isinstance(value, list | dict) else value for key, value in flat.items()}


def _arrow(pa: Any, kinds: set[type]) -> Any:
    """Return the type of a column: text if its values have several types."""
    if kinds <= {bool}:
        return pa.bool_() if kinds else pa.null()
    if kinds <= {int}:
        return pa.int64()
    return pa.float64() if kinds <= {int, float} else pa.string()


def _text(value: Any) -> str | None:
    return value if value is None or isinstance(value, str) else str(value)
