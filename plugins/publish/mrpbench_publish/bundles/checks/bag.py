"""Checks files, hashes and description of a bundle."""

from collections.abc import Iterator

from mrpbench_core.store.invocation import dumps
from mrpbench_core.store.run_files import digest
from mrpbench_publish.bundles.opened import Opened
from mrpbench_publish.bundles.publish import FORMAT
from mrpbench_publish.bundles.sample import drawn
from mrpbench_publish.bundles.verdict import Fault
from mrpbench_publish.files.bag import bag_faults
from mrpbench_publish.files.description import read_description
from mrpbench_publish.files.layout import ALLOWED, CITATION, CRATE, PAYLOAD, STUDY


def file_faults(bundle: Opened) -> Iterator[Fault | str]:
    """Yield what is wrong with the bag: hashes, missing and further files."""
    yield from bag_faults(bundle.top)
    for file in _payload(bundle):
        if not ALLOWED.fullmatch(file):
            yield file, "does not belong to a bundle"
    if (said := bundle.info.get("Mrpbench-Bundle-Format")) != FORMAT:
        yield f"is a bundle of format {said}, this version reads {FORMAT}"


def description_faults(bundle: Opened) -> Iterator[Fault | str]:
    """Yield where the description differs from the one that follows from the files."""
    documents = bundle.documents.by_name
    software, _, version = bundle.info.get("Bag-Software-Agent", "").partition(" ")
    crate = bundle.top / CRATE
    if not crate.is_file() or not documents:
        yield CRATE, "is missing"
        return
    try:
        text = crate.read_bytes()
        description = read_description(text)
    except ValueError as error:
        yield CRATE, f"is not a description that mrpbench writes: {error}"
        return
    if text != description.crate(_payload(bundle), documents, version) or software != "mrpbench":
        yield CRATE, "does not describe these files, versions and invocations"
    citation = bundle.top / CITATION
    if not citation.is_file() or citation.read_bytes() != description.citation(version):
        yield CITATION, "does not say what the description says"
    if bundle.info.get("External-Description") != " ".join(description.title.split()):
        yield "bag-info.txt", "has another title than the description"
    study = bundle.top / STUDY
    if not study.is_file() or study.read_bytes() != dumps(documents[max(documents)]["study"]).encode():
        yield STUDY, "is not the configuration of the newest invocation"


def reference_faults(bundle: Opened) -> Iterator[Fault | str]:
    """Yield where records and the files that they name do not belong together."""
    yield from bundle.documents.faults
    folder = bundle.results.folder
    documents = {name: digest(folder.invocation(name)) for name in bundle.documents.by_name}
    named: dict[str, str] = {}
    for stored in bundle.records():
        wanted = f"{documents.get(stored.shard)}  invocations/{stored.shard}.yaml"
        if wanted not in stored.files:
            yield stored.run_id, "names another invocation, or another content of its document"
        if stored.counts and stored.recording is not None:
            named[bundle.results.paths(stored.run_id).recording.name] = stored.recording
    there = {file.name: file for file in (folder.path / "recordings").glob("*")}
    for name, file in there.items():
        if name not in named:
            yield name, "is a recording that no record names"
        elif digest(file) != named[name]:
            yield name, "is not the recording whose SHA-256 its record has"
    for file in (folder.path / "instances").glob("*"):
        if digest(file) != file.stem:
            yield file.name, "is not the instance whose SHA-256 is its name"
    yield from _sample_faults(bundle, set(there), set(named))


def _sample_faults(bundle: Opened, there: set[str], named: set[str]) -> Iterator[Fault | str]:
    """Recordings that were chosen by hand: the share is drawn by the run ids."""
    try:
        share = float(bundle.info.get("Mrpbench-Recordings", ""))
    except ValueError:
        share = -1.0
    if not 0 <= share <= 1:
        yield "bag-info.txt does not say which share of the recordings is here"
        return
    ids = {stored.run_id for stored in bundle.records() if stored.counts and stored.recording is not None}
    chosen = {bundle.results.paths(run_id).recording.name for run_id in drawn(ids, share)} & named
    if further := sorted((there & named) - chosen):
        yield further[0], "is not one of the recordings that the share draws"
    if missing := sorted(chosen - there):
        yield f"{len(missing)} of the {len(chosen)} recordings that the share draws are missing (first {missing[0]})"


def _payload(bundle: Opened) -> list[str]:
    files = (bundle.top / PAYLOAD).rglob("*")
    return sorted(str(file.relative_to(bundle.top)) for file in files if file.is_file())
