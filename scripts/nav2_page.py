"""Print `docs/reference/nav2-parameters.md`: `python scripts/nav2_page.py`.

`nav2_parameters.yaml` has the parameters of Nav2 by release. What becomes of each is found by reading a file with it.
"""

import importlib
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2_file import PARAMETERS

RELEASES = ("humble", "iron", "jazzy", "kilted", "lyrical")
HEAD = """\
# Nav2 parameters
`scripts/nav2_page.py` writes this page: it reads a file with each parameter. A component with the option `nav2` reads
the parameters of its node as ROS 2 does: by the name of the node, in a namespace or under `/**`, nested or dotted, with
merge keys. Plugins are found by the ids that the file lists (`controller_plugins`, `plugins`, …). Blocks that are not
listed, or are `enabled: false`, are not judged, nor is what a file says of an option that the configuration sets.
- *read*: it has the effect that it has in Nav2.
- *not used*: Nav2 has it, and it has no effect here. The notes of a study list it once as "not used here".
- *refused*: the file is refused with one line, as it is for a parameter that Nav2 does not have.

If a file has several controllers of a kind with different values, the option `controller_id` chooses one; if its
namespaces have different values, the option `namespace` does. `main` has the parameters of lyrical, and
`max_cost_threshold` of the rotation shim, which is not used. Of older releases the names `controller_plugin_ids`,
`controller_plugin_types`, `plugin_names`, `obstacle_range`, `raytrace_range` and `max_allowed_time_to_collision` are
read, too. Filters of costmaps (`keepout_filter`, `speed_filter`) are ignored, which a note says. Speeds and
accelerations are lowered to the limits of the robot: choose a `fleet` whose robots are as fast as those of the file.
"""


def page() -> str:
    """The page as Markdown."""
    parts = [HEAD]
    for block in yaml.safe_load((Path(__file__).parent / "nav2_parameters.yaml").read_text()):
        where = ".".join(filter(None, (block["node"], block.get("at"))))
        parts.append(f"\n## {block['title']}\nIn `{where}`:\n\n| parameter | {' | '.join(RELEASES)} |\n")
        parts.append("|---" * (len(RELEASES) + 1) + "|\n")
        rows = [
            (name, value, releases)
            for span, parameters in block["parameters"].items()
            for releases in (_releases(span),)
            for name, value in parameters.items()
        ]
        for name, value, releases in sorted(rows, key=lambda row: row[0]):
            fate = fate_of(block, name, value)
            cells = (fate if release in releases else "–" for release in RELEASES)
            parts.append(f"| `{name}` | {' | '.join(cells)} |\n")
        for name, value in block.get("refused", {}).items():
            shown = str(value).replace("'", "")
            parts.append(f"| `{name}: {shown}` |{f' {fate_of(block, name, value)} |' * len(RELEASES)}\n")
    return "".join(parts)


def fate_of(block: Mapping[str, Any], name: str, value: Any) -> str:
    """Tell whether a parameter in a block is read, not used or refused."""
    module, _, attribute = block["component"].partition(":")
    component = getattr(importlib.import_module(module), attribute)
    key = ".".join(filter(None, (block.get("at"), name)))
    parameters = {PARAMETERS: block["base"] | {key: value}}
    nodes: dict[str, Any] = {
        block["node"]: {block["node"]: parameters} if block["node"].endswith("_costmap") else parameters
    }
    if block["node"] != "amcl":
        nodes.setdefault("controller_server", {PARAMETERS: {"FollowPath": {"max_vel_x": 0.2}}})
    options = {"primary_controller": _other()} if attribute == "RotationShim" else {}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "nav2.yaml"
        file.write_text(yaml.safe_dump(nodes, sort_keys=False))
        try:
            notes = component(nav2=file, **options).notes()
        except InputError:
            return "refused"
    unused = [entry for note in notes if ": not used here: " in note for entry in note.split(": ")[-1].split(", ")]
    unused += ["filters"] if any("filters of costmaps are ignored" in note for note in notes) else []
    return "not used" if any(key == entry or key.startswith(f"{entry}.") for entry in unused) else "read"


def _other() -> Any:
    from mrpbench_controllers_pure_pursuit import PurePursuit

    return PurePursuit()


def _releases(span: str) -> tuple[str, ...]:
    first, last = (RELEASES.index(name) for name in span.split(".."))
    return RELEASES[first : last + 1]


if __name__ == "__main__":
    print(page(), end="")
