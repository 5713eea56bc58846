"""Names the plugin and its distribution behind a failure of a run."""

import traceback

from mrpbench_core.api.component import Component
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.plugins.provenance import components_in, title


def broken(error: BrokenContractError, config: RunConfig | None) -> str:
    """The message of a broken contract, with the component that the configuration chose."""
    chosen = getattr(config, error.setting, None) if error.setting else None
    components = [chosen] if isinstance(chosen, Component) else list(chosen or ())
    return f"{error} ({' or '.join(map(title, components))})" if components else str(error)


def owner_of(error: BaseException, config: RunConfig) -> Component | None:
    """Return the component in whose code an exception was raised, as far as its package tells."""
    components = list(components_in(config))
    frames = traceback.walk_tb(error.__traceback__)
    for module in reversed([str(frame.f_globals.get("__name__", "")) for frame, _ in frames]):
        exact = next((component for component in components if type(component).__module__ == module), None)
        root = module.partition(".")[0]
        alike = (component for component in components if type(component).__module__.partition(".")[0] == root)
        owner = exact or (None if root == __name__.partition(".")[0] else next(alike, None))
        if owner is not None:
            return owner
    return None
