"""The document of an invocation: configuration, versions and machine, stored with its records."""

from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

import yaml

from mrpbench_core.files.output import replace_file
from mrpbench_core.files.yaml import plain_scalar


class _Dumper(yaml.SafeDumper):
    """Writes YAML 1.2: PyYAML leaves text such as `1e-3` bare, which is text only in YAML 1.1."""

    def ignore_aliases(self, data: Any) -> bool:  # noqa: ARG002 - repeated values are written out
        return True


def _text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    try:
        bare = plain_scalar(text) == text
    except ValueError:
        bare = False
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=None if bare else '"')


_Dumper.add_representer(str, _text)


def dumps(data: Any) -> str:
    """YAML that `mrpbench_core.files.yaml` reads back as it was."""
    return yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=120)


def write_document(file: Path, data: Mapping[str, Any]) -> str:
    """Write a YAML file at once, and return its SHA-256 when it is on disk."""
    content = dumps(data).encode()
    replace_file(file, content, sync=True)
    return sha256(content).hexdigest()
