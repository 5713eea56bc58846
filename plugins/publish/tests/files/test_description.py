"""Descriptions: the library of RO-Crate reads them, and a reader can derive them again."""

import json

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_publish.files.description import Author, Description, read_description

from mrpbench_core.files.errors import InputError

PAYLOAD = [
    "data/ro-crate-metadata.json",
    "data/study.yaml",
    "data/results/runs/one.jsonl",
    "data/results/invocations/one.yaml",
    "data/results/recordings/ab.zip",
]
INVOCATIONS = {"one": {"started": "2026-11-22T10:00:00+00:00", "versions": {"numpy": "2.4", "mrpbench-core": "0.2"}}}
TEXT = st.text(st.characters(blacklist_categories=["Cs", "Cc"]), min_size=1, max_size=20)


def describe(title="A study", names=("Ada Lovelace",)):
    return Description(
        title=title,
        text="What it is.",
        authors=tuple(Author(name=name) for name in names),
        license="CC-BY-4.0",
        published="2026-11-22",
    )


@given(title=TEXT, names=st.lists(TEXT, min_size=1, max_size=3, unique=True))
def test_a_description_follows_from_its_own_text(title, names):
    description = describe(title, names)
    text = description.crate(PAYLOAD, INVOCATIONS, "0.2")
    assert read_description(text) == description
    assert read_description(text).crate(PAYLOAD, INVOCATIONS, "0.2") == text
    assert yaml.safe_load(description.citation("0.2"))["authors"][0] == {"name": names[0]}


def test_the_library_of_ro_crate_reads_it(tmp_path):
    rocrate = pytest.importorskip("rocrate.rocrate")
    for name in PAYLOAD:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / PAYLOAD[0]).write_bytes(describe().crate(PAYLOAD, INVOCATIONS, "0.2"))
    crate = rocrate.ROCrate(tmp_path / "data")
    assert crate.name == "A study"
    assert crate.root_dataset["license"]["name"] == "CC-BY-4.0"
    (action,) = crate.get_by_type("CreateAction")
    assert [tool["softwareVersion"] for tool in action["instrument"]] == ["0.2", "2.4"]
    assert [file.id for file in action["result"]] == ["results/runs/one.jsonl"]
    assert {entity.id for entity in crate.data_entities} == {
        "study.yaml",
        "results/runs/one.jsonl",
        "results/invocations/one.yaml",
        "results/recordings/",
    }


def test_authors_are_names_with_an_orcid_or_none():
    assert Author.read(" Ada  Lovelace <0000-0002-1825-0097> ") == Author(
        name="Ada Lovelace", orcid="0000-0002-1825-0097"
    )
    assert Author.read("The team") == Author(name="The team")
    for wrong in ("", "<0000-0002-1825-0097>", "Ada <x>"):
        with pytest.raises(InputError):
            Author.read(wrong)


@pytest.mark.parametrize("change", [{}, [], {"@graph": [{"@id": "./"}]}, {"@graph": 3}, {"@graph": [{"@id": []}]}])
def test_another_description_is_refused(change):
    with pytest.raises(ValueError, match=r"Error|Expecting"):
        read_description(json.dumps(change).encode())
