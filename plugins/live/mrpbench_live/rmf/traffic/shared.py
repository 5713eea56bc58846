"""What the components of one run share: a run has a process of its own, so there is one `Traffic`."""

from mrpbench_core.api import InputError
from mrpbench_live.rmf.traffic.traffic import Traffic


class _Run:
    """What the components of one run share."""

    traffic: Traffic | None = None


def traffic_of(kind: str) -> Traffic:
    """Return what the components share, for one of a kind.

    Raises:
        InputError: the simulator of the run is another one.
    """
    if _Run.traffic is None:
        raise InputError(f"{kind}: `rmf` needs `simulator: rmf`, which has the robots")
    return _Run.traffic


def share(traffic: Traffic | None) -> None:
    """Begin or end sharing."""
    _Run.traffic = traffic
