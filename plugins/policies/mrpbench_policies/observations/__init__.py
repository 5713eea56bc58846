"""The observations that policies get, by name."""

from mrpbench_policies.observations.cost_to_go import CostToGo
from mrpbench_policies.observations.observation import Field, Observation
from mrpbench_policies.observations.planes import Primal, Scrimp
from mrpbench_policies.observations.pogema import PogemaDefault, PogemaMapf, PogemaPomapf
from mrpbench_policies.observations.tokens import MapfGptTokens

OBSERVATIONS: dict[str, type[Observation]] = {
    "pogema": PogemaDefault,
    "pogema_pomapf": PogemaPomapf,
    "pogema_mapf": PogemaMapf,
    "mapf_gpt": MapfGptTokens,
    "primal": Primal,
    "scrimp": Scrimp,
    "cost_to_go": CostToGo,
}
"""The class of each."""

__all__ = [
    "OBSERVATIONS",
    "CostToGo",
    "Field",
    "MapfGptTokens",
    "Observation",
    "PogemaDefault",
    "PogemaMapf",
    "PogemaPomapf",
    "Primal",
    "Scrimp",
]
