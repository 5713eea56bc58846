"""The invocations and records of a results folder, as `publish` and `verify` read them."""

from collections.abc import Mapping
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load as load_yaml
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.results import Results
from mrpbench_core.store.shards import read_shard
from mrpbench_publish.bundles.expected import Invocation, relocated


@attrs.frozen(kw_only=True)
class Documents:
    """The documents of the invocations in a results folder."""

    by_name: Mapping[str, Mapping[str, Any]]
    faults: tuple[str, ...]
    """Which of them cannot be used, and why."""

    def invocations(self, results: Results, names: Mapping[str, str]) -> dict[str, Invocation]:
        """Return what each invocation was asked to do.

        Args:
            results: the records of the folder, which say how the study is called.
            names: relative names of the files that configurations give in full.
        """
        called = {shard: _study_name(results, shard) for shard in self.by_name}
        known = next(filter(None, called.values()), "study")
        return {
            shard: Invocation(
                study=relocated(document["study"], names),
                overrides=tuple(_relocated(text, names) for text in document.get("overrides") or ()),
                name=called[shard] or known,
            )
            for shard, document in self.by_name.items()
        }


def read_documents(folder: ResultsFolder) -> Documents:
    """Read the documents of all invocations of a folder."""
    documents: dict[str, Mapping[str, Any]] = {}
    faults = []
    for file in sorted((folder.path / "invocations").glob("*.yaml")):
        try:
            data = load_yaml(file).data
        except InputError as error:
            faults.append(f"{file.name}: {error.message}")
            continue
        if fault := _fault(data, file.stem):
            faults.append(f"{file.name}: {fault}")
        else:
            documents[file.stem] = data
    faults += [
        f"{shard.name}: its invocation has no document, so it is unknown what was asked for"
        for shard in folder.shards()
        if shard.stem not in documents
    ]
    return Documents(by_name=documents, faults=tuple(faults))


def _fault(data: Any, name: str) -> str | None:
    if not isinstance(data, dict) or data.get("invocation") != name:
        return "is not the document of this invocation"
    if "analysis" in data:
        return "measures a recording of others (mrpbench analyze), which no study describes"
    if not isinstance(data.get("study"), dict) or not isinstance(data.get("versions"), dict):
        return "has no study, or no versions"
    overrides = data.get("overrides") or []
    if not isinstance(overrides, list) or not all(isinstance(text, str) for text in overrides):
        return "has overrides that are no texts"
    return None if isinstance(data.get("columns"), dict) else "declares no columns"


def _study_name(results: Results, shard: str) -> str | None:
    """The name of the study in the first record of an invocation."""
    for _, record in read_shard(results.folder.shard(shard)):
        name = record["config"].get("name")
        return name if isinstance(name, str) else None
    return None


def _relocated(text: str, names: Mapping[str, str]) -> str:
    for full in sorted(names, key=len, reverse=True):
        text = text.replace(full, names[full])
    return text
