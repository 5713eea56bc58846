"""Finds the axes of a study: the options in which its configurations differ."""

from collections.abc import Sequence
from typing import Any

from mrpbench_core.config.settings import EXECUTION, NOT_IDENTIFYING
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean, suggest
from mrpbench_core.store.results import flatten

SAMPLES = ("seed", "repeat")
"""Options that distinguish the samples of one configuration."""
NO_AXES = (*NOT_IDENTIFYING, *SAMPLES)
NAMES = ("plugin", "robot")
"""Main options of a block, which are shown by their value alone."""

Axes = dict[str, Any]
"""Values by dotted option; an option that a configuration does not have is missing."""


def find_axes(configs: Sequence[dict[str, Any]], by: Sequence[str] | None = None) -> list[Axes]:
    """Return the options in which each configuration differs from the others.

    Args:
        configs: as records keep them; those of recorded bags lack options that are unknown.
        by: options, or blocks of options, that count; None = all that vary.

    Raises:
        InputError: an option in `by` is in no configuration.
    """
    flat = [_flat(config) for config in (_labelled(configs) if by is None else configs)]
    if by is not None:
        known = {part for entry in flat for key in entry for part in _with_blocks(key)}
        for name in by:
            if name not in known:
                full = next((key for key in sorted(known) if key.endswith(f".{name}")), name)
                hint = did_you_mean(full, sorted(known)) or suggest(name, _varying(flat), "options that vary:")
                raise InputError(f"--by: no run has the option {name!r}", hint=hint)
    varying = [key for key in _varying(flat) if by is None or is_below(key, by)]
    keys = _without_implied(varying, flat)
    return _without_shared([{key: entry[key] for key in keys if key in entry} for entry in flat])


def name_axes(axes: Axes) -> str:
    """Describe axes briefly: `ecbs w=1.2 robots=9`."""
    words = []
    for key, value in axes.items():
        last = key.rpartition(".")[2]
        words.append(word(value) if last in NAMES else f"{last}={word(value)}")
    return " ".join(words)


def factors(axes: Axes) -> dict[str, Axes]:
    """Group axes by their block, so that a planner and its options are one choice."""
    factors: dict[str, Axes] = {}
    for key, value in axes.items():
        factors.setdefault(key.partition(".")[0], {})[key] = value
    return factors


def word(value: Any) -> str:
    """Write a value briefly; a block as its plugin and options."""
    if value is None:
        return "none"
    if isinstance(value, dict):
        options = ",".join(f"{key}={word(item)}" for key, item in value.items() if key not in NAMES)
        return f"{_name(value)}[{options}]" if options else _name(value)
    if isinstance(value, list | tuple):
        return "[" + ",".join(map(word, value)) + "]"
    return str(value)


def _labelled(configs: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Name each block by its option `label` alone, unless blocks that differ have the same label."""
    blocks: dict[tuple[str, str], set[str]] = {}
    for config in configs:
        for key, block in config.items():
            if label := _label(block):
                blocks.setdefault((key, label), set()).add(repr(block))
    clear = {name for name, labels in blocks.items() if len(labels) == 1}
    return [
        {key: {"plugin": _label(block)} if (key, _label(block)) in clear else block for key, block in config.items()}
        for config in configs
    ]


def _label(block: Any) -> str:
    """The label of a block, or an empty text."""
    label = block.get("label") if isinstance(block, dict) else None
    return label if isinstance(label, str) else ""


def _flat(config: dict[str, Any]) -> Axes:
    """Options by dotted key; `plugin` is "none" for a missing stage, unless it is missing because another stage is."""
    missing = (key for key, value in config.items() if value in (None, "none") and key not in EXECUTION)
    blocks = {key: {"plugin": "none"} for key in missing}
    return {key: value for key, value in flatten(config | blocks).items() if not is_below(key, NO_AXES)}


def is_below(key: str, names: Sequence[str]) -> bool:
    """Tell whether an option is one of these, or belongs to one."""
    return any(key == name or key.startswith(f"{name}.") for name in names)


def _with_blocks(key: str) -> list[str]:
    parts = key.split(".")
    return [".".join(parts[: count + 1]) for count in range(len(parts))]


def _varying(flat: Sequence[Axes]) -> list[str]:
    """Options that differ between the configurations that have them."""
    first: dict[str, str] = {}
    varying: dict[str, None] = {}
    for entry in flat:
        for key, value in entry.items():
            if first.setdefault(key, repr(value)) != repr(value):
                varying[key] = None
    return list(varying)


def _without_shared(entries: list[Axes]) -> list[Axes]:
    """Leave out of the blocks in lists, such as `crowds`, the options that all blocks of a name share."""
    shown: dict[tuple[str, str, str], set[str]] = {}
    for key, block in ((key, block) for entry in entries for key, value in entry.items() for block in _blocks(value)):
        for option in block:
            shown.setdefault((key, _name(block), option), set()).add(repr(block[option]))

    def differing(key: str, block: dict[str, Any]) -> dict[str, Any]:
        return {
            option: value
            for option, value in block.items()
            if option in NAMES or len(shown[key, _name(block), option]) > 1
        }

    return [
        {key: [differing(key, block) for block in _blocks(value)] or value for key, value in entry.items()}
        for entry in entries
    ]


def _blocks(value: Any) -> list[dict[str, Any]]:
    """The blocks of a list of blocks; none of anything else."""
    is_list = isinstance(value, list | tuple) and all(isinstance(block, dict) for block in value)
    return list(value) if is_list else []


def _name(block: dict[str, Any]) -> str:
    return str(block.get("plugin", block.get("robot", "")))


def _without_implied(varying: Sequence[str], flat: Sequence[Axes]) -> list[str]:
    """Leave out options that follow from the plugin that their block names, such as its defaults, or from a path."""
    keys = []
    for key in varying:
        plugins = [f"{block}.plugin" for block in _with_blocks(key)[:-1]]
        if key.endswith(".sha256"):  # of a file, which its path names
            plugins = [f"{key.removesuffix('.sha256')}.path"]
        plugins = [name for name in plugins if name in varying and name != key]
        values: dict[str, set[str]] = {}
        for entry in flat:
            if key in entry:
                values.setdefault(repr([entry.get(name) for name in plugins]), set()).add(repr(entry[key]))
        if not plugins or any(len(options) > 1 for options in values.values()):
            keys.append(key)
    return keys
