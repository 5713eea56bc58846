"""Options with the names and defaults of Nav2, which a Nav2 parameter file may set."""

from collections.abc import Callable
from typing import Any, Literal, get_args, get_origin

import attrs

from mrpbench_core.api.component import bounded
from mrpbench_core.api.described import DescribedOption, option_type, validator_of
from mrpbench_core.files.nav2 import OF_EVERY_NODE, Nav2Block
from mrpbench_core.files.nav2_file import Nav2File

PLUGINS = {
    "controller": "FollowPath",
    "goal_checker": "goal_checker",
    "progress_checker": "progress_checker",
    "path_handler": "PathHandler",
}
"""The kinds of plugins of Nav2's controller server, each with the id of the one that it has by default."""
_OF_SERVER = (
    *("controller_frequency", "min_x_velocity_threshold", "min_y_velocity_threshold", "min_theta_velocity_threshold"),
    *("speed_limit_topic", "odom_topic", "odom_duration", "enable_stamped_cmd_vel", "publish_zero_velocity"),
    *("use_realtime_priority", "costmap_update_timeout", "transform_tolerance"),
)
"""Parameters of Nav2's controller server that have no effect here."""


def parameter(default: Any, *, help: str, unit: str | None = None, validator: Callable[..., Any] | None = None) -> Any:
    """Declare an option, typed `... | None`, that is None unless the configuration sets it.

    If it is None, `resolve_options` takes the value from the Nav2 parameter file, or else `default`.
    """
    shown = (
        "" if default is None else f" (default {default:g})" if isinstance(default, float) else f" (default {default})"
    )
    return attrs.field(
        default=None,
        validator=attrs.validators.optional(bounded(unit, validator)),
        metadata={"help": help + shown, "unit": unit, "nav2": default},
    )


def as_parameter(described: DescribedOption, *, unset: bool = False) -> tuple[Any, Any]:
    """Return the type and the field of an option that a library describes; with `unset` it has no default."""
    field = parameter(
        None if unset else described.default,
        help=described.help,
        unit=described.unit or None,
        validator=validator_of(described),
    )
    return option_type(described) | None, field


def resolve_options(options: Any, block: Nav2Block | None = None, of: type[Any] | None = None) -> dict[str, Any]:
    """Return the values of all options declared with `parameter` in an attrs instance, by name.

    Args:
        options: the instance.
        block: parameters of a Nav2 file.
        of: base class of `options` whose options are returned; by default all.

    Raises:
        InputError: a value in the file has the wrong type, or the validator of the option refuses it.
    """
    values = {}
    for field in attrs.fields(of or type(options)):
        if "nav2" in field.metadata:
            value = read_option(options, field.name, block)
            values[field.name] = field.metadata["nav2"] if value is None else value
    return values


def read_option(options: Any, name: str, block: Nav2Block | None, key: str | None = None) -> Any:
    """Return an option of an attrs instance as it is set, or else as a block has it, by `key` if it differs; or None.

    What a block says of an option that is set is not judged.

    Raises:
        InputError: the value in the block has the wrong type, or the validator of the option refuses it.
    """
    option = getattr(options, name)
    if block is None:
        return option
    if option is not None:
        block.ignore(key or name)
        return option
    field = getattr(attrs.fields(type(options)), name)
    value = block.take(key or name, _nav2_type(field.type))
    check_parameter(field, value, block, key or name)
    return value


def _nav2_type(declared: Any) -> type:
    """Return the type that an option declared as `... | None` has in a file."""
    kind = next(kind for kind in get_args(declared) if kind is not type(None))
    origin = get_origin(kind)
    return str if origin is Literal else origin or kind


def check_parameter(field: Any, value: Any, block: Nav2Block, name: str) -> None:
    """Raise an InputError if the validator of an attrs field refuses the value of the parameter `name`."""
    if field.validator is None or value is None:
        return
    try:
        field.validator(None, field, value)
    except ValueError as error:
        raise block.error(str(error.args[0]), name) from None


def controller_server(file: Nav2File, namespace: str) -> Nav2Block:
    """Return the parameters of the controller server; those of its plugins are left to who reads them (`within`).

    Raises:
        InputError: the file has none.
    """
    server = file.node("controller_server", namespace)
    if server is None:
        raise file.missing("controller_server")
    server.ignore("failure_tolerance", *(name for kind in PLUGINS for name in plugin_ids(server, kind)))
    server.not_used(*OF_EVERY_NODE, *_OF_SERVER)
    return server


def plugin_ids(server: Nav2Block, kind: str) -> tuple[str, ...]:
    """Return the ids of the plugins that the controller server has of a kind, as the releases of Nav2 list them."""
    single = server.take(f"{kind}_plugin", str, "")
    server.ignore(f"{kind}_plugin_types")
    return (
        server.take_names(f"{kind}_plugins")
        or server.take_names(f"{kind}_plugin_ids")
        or ((single,) if single else (PLUGINS[kind],))
    )


def not_used(*blocks: Nav2Block | None) -> tuple[str, ...]:
    """Return the notes on parameters that have no effect here, one line for those of a node, one for its plugins'."""
    notes = []
    for block in filter(None, blocks):
        unused = block.unused()
        place = ": ".join(filter(None, (str(block.document.file) if block.document else "", block.title)))
        direct, inner = [name for name in unused if "." not in name], [name for name in unused if "." in name]
        notes += [
            f"{place}: not used here: {', '.join(names)}".removeprefix(": ") for names in (direct, inner) if names
        ]
    return tuple(notes)
