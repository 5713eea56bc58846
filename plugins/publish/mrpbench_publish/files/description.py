"""The description of published data: RO-Crate 1.2 with the profile Process Run Crate 0.5; Citation File Format 1.2.0.

Everything but title, text, authors, licence and date follows from the other files, so that a reader can check it.
"""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from datetime import date
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.invocation import dumps
from mrpbench_publish.files.layout import PAYLOAD

SPDX = "https://spdx.org/licenses/"
_CRATE = "https://w3id.org/ro/crate/1.2"
_PROFILE = "https://w3id.org/ro/wfrun/process/0.5"
_AUTHOR = re.compile(
    r"(?P<name>[^<>]*[^<>\s])(?:\s*<(?:https://orcid\.org/)?(?P<orcid>\d{4}-\d{4}-\d{4}-\d{3}[\dX])>)?"
)
_FORMATS = {name: f"application/{name}" for name in ("yaml", "jsonl", "json", "zip")}


@attrs.frozen(kw_only=True)
class Author:
    """A person, or a group without ORCID."""

    name: str
    orcid: str | None = None

    @classmethod
    def read(cls, text: str) -> "Author":
        """Read `Name` or `Name <ORCID>`.

        Raises:
            InputError: it is neither.
        """
        match = _AUTHOR.fullmatch(text.strip())
        if match is None:
            raise InputError(f"--author {text}: expected a name", hint='e.g. "Ada Lovelace <0000-0002-1825-0097>"')
        return cls(name=" ".join(match["name"].split()), orcid=match["orcid"])

    @property
    def _id(self) -> str:
        return f"https://orcid.org/{self.orcid}" if self.orcid else f"#{self.name}"

    def entity(self) -> dict[str, Any]:
        """Return the entity of a crate."""
        return {"@id": self._id, "@type": "Person", "name": self.name}


@attrs.frozen(kw_only=True)
class Description:
    """What the publisher says about the data."""

    title: str
    text: str
    authors: tuple[Author, ...]
    license: str
    """SPDX identifier."""
    published: str
    """Date, `YYYY-MM-DD`."""

    def citation(self, version: str) -> bytes:
        """Return `CITATION.cff`."""
        authors = [
            {"name": author.name} | ({"orcid": f"https://orcid.org/{author.orcid}"} if author.orcid else {})
            for author in self.authors
        ]
        return dumps(
            {
                "cff-version": "1.2.0",
                "message": "If you use these data, please cite them as below.",
                "type": "dataset",
                "title": self.title,
                "abstract": self.text,
                "authors": authors,
                "license": self.license,
                "date-released": self.published,
                "version": version,
            }
        ).encode()

    def crate(self, payload: Iterable[str], invocations: Mapping[str, Mapping[str, Any]], version: str) -> bytes:
        """Return `ro-crate-metadata.json`.

        Args:
            payload: names of all files of the payload.
            invocations: the document of each invocation.
            version: of the bundle's software, mrpbench.
        """
        files = sorted(name.removeprefix(PAYLOAD) for name in payload)
        folders = {
            f"results/{part}/": [name for name in files if name.startswith(f"results/{part}/")]
            for part in ("instances", "recordings")
        }
        listed = [name for name in files if not any(map(name.startswith, folders)) and name != "ro-crate-metadata.json"]
        parts = [_file(name) for name in listed]
        for folder, names in folders.items():
            if names:
                part = folder.split("/")[1]
                what = "recordings of runs" if part == "recordings" else "files of instances"
                parts.append({"@id": folder, "@type": "Dataset", "name": part, "description": f"{len(names)} {what}"})
        software = _software(invocations, version)
        actions = [
            _action(name, document, self.authors, [part["@id"] for part in parts])
            for name, document in sorted(invocations.items())
        ]
        root = {
            "@id": "./",
            "@type": "Dataset",
            "conformsTo": {"@id": _PROFILE},
            "name": self.title,
            "description": self.text,
            "author": [{"@id": author.entity()["@id"]} for author in self.authors],
            "license": {"@id": f"{SPDX}{self.license}"},
            "datePublished": self.published,
            "creativeWorkStatus": "published",
            "hasPart": [{"@id": part["@id"]} for part in parts],
            "mentions": [{"@id": action["@id"]} for action in actions],
        }
        descriptor = {
            "@id": "ro-crate-metadata.json",
            "@type": "CreativeWork",
            "conformsTo": {"@id": _CRATE},
            "about": {"@id": "./"},
        }
        profile = {"@id": _PROFILE, "@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"}
        terms = {"@id": f"{SPDX}{self.license}", "@type": "CreativeWork", "name": self.license}
        people = [author.entity() for author in self.authors]
        graph = [descriptor, root, profile, terms, *people, *parts, *software, *actions]
        context = f"{_CRATE}/context"
        return (json.dumps({"@context": context, "@graph": graph}, indent=1, ensure_ascii=False) + "\n").encode()


def read_description(text: bytes) -> Description:
    """Return what a crate says about its publisher; the result gives the same crate again if nothing was changed.

    Raises:
        ValueError: it is not a crate that `Description.crate` writes.
    """
    try:
        graph = {entity["@id"]: entity for entity in json.loads(text)["@graph"]}
        root = graph["./"]
        people = [graph[author["@id"]] for author in root["author"]]
        description = Description(
            title=root["name"],
            text=root["description"],
            authors=tuple(
                Author(
                    name=person["name"],
                    orcid=person["@id"].removeprefix("https://orcid.org/") if person["@id"][0] != "#" else None,
                )
                for person in people
            ),
            license=root["license"]["@id"].removeprefix(SPDX),
            published=root["datePublished"],
        )
        date.fromisoformat(description.published)
    except (KeyError, TypeError, AttributeError, IndexError, RecursionError) as error:
        raise ValueError(f"{type(error).__name__} {error}") from None
    if not all(
        isinstance(word, str)
        for word in (description.title, description.text, *(author.name for author in description.authors))
    ):
        raise ValueError("title, text or names are not text")
    return description


def _file(name: str) -> dict[str, Any]:
    form = _FORMATS.get(name.rpartition(".")[2])
    return {"@id": name, "@type": "File", "name": name} | ({"encodingFormat": form} if form else {})


def _software(invocations: Mapping[str, Mapping[str, Any]], version: str) -> list[dict[str, Any]]:
    used = {pair for document in invocations.values() for pair in _versions(document)} | {("mrpbench-core", version)}
    return [
        {"@id": _of(name, number), "@type": "SoftwareApplication", "name": name, "softwareVersion": number}
        for name, number in sorted(used)
    ]


def _versions(document: Mapping[str, Any]) -> list[tuple[str, str]]:
    versions = document.get("versions")
    return sorted((str(name), str(number)) for name, number in versions.items()) if isinstance(versions, dict) else []


def _of(name: str, version: str) -> str:
    return f"#{name}-{version}"


def _action(name: str, document: Mapping[str, Any], authors: Sequence[Author], parts: Sequence[str]) -> dict[str, Any]:
    """The invocation as an action that created its records."""
    records = f"results/runs/{name}.jsonl"
    return {
        "@id": f"#{name}",
        "@type": "CreateAction",
        "name": f"mrpbench run, {name}",
        "startTime": str(document.get("started")),
        "agent": {"@id": authors[0].entity()["@id"]},
        "instrument": [{"@id": _of(*pair)} for pair in _versions(document)],
        "object": [{"@id": part} for part in (f"results/invocations/{name}.yaml", "study.yaml") if part in parts],
        "result": [{"@id": records}] if records in parts else [],
    }
