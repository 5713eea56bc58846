"""Names the plugin and its distribution behind a failure of a run."""

import traceback
from collections.abc import Iterator

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.plugins.kinds import kind_of
from mrpbench_core.plugins.provenance import components_in, origin


def title(component: Component) -> str:
    """Kind, name and origin of a component, e.g. `planner 'cbs' of mrpbench-standard 0.1`."""
    found = origin(type(component))
    owner = f" of {found['distribution']} {found['version']}" if "distribution" in found else ""
    return f"{found['kind']} '{found['name']}'{owner}"


def with_origin(message: str, config: RunConfig) -> str:
    """Add which component is meant to a message such as `the localizer returned None instead of Estimate`."""
    for field in attrs.fields(RunConfig):
        component = getattr(config, field.name)
        if isinstance(component, Component):
            kind = kind_of(component.group).replace("_", " ")
            if message.startswith(f"the {kind} "):
                return f"{message} ({title(component)})"
    if message.startswith("a crowd "):
        return f"{message} ({' or '.join(map(title, config.crowds))})"
    return message


def owner_of(error: BaseException, config: RunConfig) -> Component | None:
    """Return the component in whose code an exception was raised, as far as its package tells."""
    components = list(components_in(config))
    for module in reversed(list(_modules(error))):
        exact = next((component for component in components if type(component).__module__ == module), None)
        root = module.partition(".")[0]
        alike = (component for component in components if type(component).__module__.partition(".")[0] == root)
        found = exact or (None if root == __name__.partition(".")[0] else next(alike, None))
        if found is not None:
            return found
    return None


def _modules(error: BaseException) -> Iterator[str]:
    for frame, _ in traceback.walk_tb(error.__traceback__):
        yield str(frame.f_globals.get("__name__", ""))
