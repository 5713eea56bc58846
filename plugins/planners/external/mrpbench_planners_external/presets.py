"""The command lines of known programs, as the documentation of each shows its usage.

| preset | program | usage |
|---|---|---|
| `eecbs` | EECBS (Li, Ruml and Koenig, AAAI 2021) | https://github.com/Jiaoyang-Li/EECBS |
| `cbsh2_rtc` | CBSH2-RTC (Li et al., AIJ 2021) | https://github.com/Jiaoyang-Li/CBSH2-RTC |
| `mapf_lns2` | MAPF-LNS2 (Li et al., AAAI 2022) | https://github.com/Jiaoyang-Li/MAPF-LNS2 |
| `lacam` | LaCAM, LaCAM2 and LaCAM3 (Okumura, AAAI 2023, IJCAI 2023, AAMAS 2024) | https://github.com/Kei18/lacam3 |
"""

from collections.abc import Mapping
from typing import Literal

import attrs

PresetName = Literal["eecbs", "cbsh2_rtc", "mapf_lns2", "lacam"]
Output = Literal["agents", "steps", "schedule"]


@attrs.frozen
class Preset:
    """How a program is called, and how it writes paths."""

    arguments: str
    output: Output


PRESETS: Mapping[PresetName, Preset] = {
    "eecbs": Preset(
        "-m {map} -a {scen} -o statistics.csv --outputPaths={paths} -k {agents} -t {seconds} --suboptimality={w}",
        "agents",
    ),
    "cbsh2_rtc": Preset(
        "-m {map} -a {scen} -o statistics.csv --outputPaths={paths} -k {agents} -t {seconds}", "agents"
    ),
    "mapf_lns2": Preset("-m {map} -a {scen} -o statistics -k {agents} -t {seconds} --outputPaths={paths}", "agents"),
    "lacam": Preset("-i {scen} -m {map} -o {paths} -N {agents} -t {seconds} -s {seed}", "steps"),
}
GENERAL = Preset("-m {map} -a {scen} -o {paths} -k {agents} -t {seconds}", "agents")
"""Of a program without a preset."""
