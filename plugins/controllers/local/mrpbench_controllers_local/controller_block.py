"""Find the parameters of a controller among those of Nav2's controller server."""

from mrpbench_controllers_local.nav2_names import HERE, OF_SHIM
from mrpbench_core.api.nav2 import plugin_ids
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import Nav2Block

SHIM = "nav2_rotation_shim_controller::RotationShimController"
NOT_HERE = "the shim is not used here"


def controller_block(server: Nav2Block, plugin: str, controller_id: str | None) -> Nav2Block:
    """Return the block of a controller, by its id or as the only one of its kind among those that the file lists.

    Args:
        server: parameters of the controller server.
        plugin: the controller in Nav2, alone or in a rotation shim.
        controller_id: its id, None = any.

    Raises:
        InputError: there is none, or there are several with different values.
    """
    listed = plugin_ids(server, "controller")
    if controller_id is not None and controller_id not in listed:
        raise server.error(
            f"there is no controller {controller_id!r}", "controller_plugins", hint=f"it lists {', '.join(listed)}"
        )
    ids = [name for name in listed if name in server.blocks() and controller_id in (None, name)]
    if not ids and controller_id is None:  # a block for any node (`/**`) may also be for this one
        named = [name for name in server.blocks(shared=True) if f"{name}.plugin" in server]
        ids = [name for name in named if plugin in _plugins(server, name, listed)]
    if not ids:
        blocks = ", ".join(server.blocks()) or "none"
        why = "it lists" if any(f"controller_plugin{end}" in server for end in ("s", "_ids", "")) else "is the default"
        message = f"no parameters of {' or '.join(listed)}, which {why}"
        raise server.error(message, "controller_plugins", hint=f"blocks that there are: {blocks}")
    fitting = [name for name in ids if plugin in _plugins(server, name, listed)]
    if not fitting:
        raise _unfit(server, plugin, ids, listed)
    if any(server.values(name) != server.values(fitting[0]) for name in fitting):
        message = f"{' and '.join(fitting)} are {plugin} with different values"
        raise server.error(message, "controller_plugins", hint="choose one by the option `controller_id`")
    return server.within(fitting[0])


def primary_block(block: Nav2Block) -> Nav2Block:
    """Return the parameters of the controller in the block of a rotation shim; since lyrical they have a block."""
    plugin = _name(block.take("plugin", str, ""))
    if plugin != SHIM:
        return block
    block.ignore(*OF_SHIM)
    if "primary_controller" in block:
        block.take("primary_controller", str)
        return block
    primary = block.within("primary_controller")
    primary.take("plugin", str)
    return primary


def controller_notes(server: Nav2Block, block: Nav2Block) -> tuple[str, ...]:
    """Return the notes that the file does not list a block, and that it is one of a shim, which is not used."""
    listed, block_id = plugin_ids(server, "controller"), block.title.rpartition(".")[2]
    notes = (
        []
        if block_id in listed
        else [f"controller_plugins lists {', '.join(listed)}, but only {block_id} has parameters"]
    )
    if _name(block.take("plugin", str, "")) == SHIM:
        notes.append(f"{NOT_HERE}: take `plugin: rotation_shim` with this file, and this as its `primary_controller`")
    place = f"{block.document.file}: " if block.document else ""
    return tuple(f"{place}{block.title}: {note}" for note in notes)


def _plugins(server: Nav2Block, name: str, listed: tuple[str, ...]) -> tuple[str, ...]:
    """Return the plugins whose parameters a block has; any if it names none."""
    types = server.take_names("controller_plugin_types")  # of eloquent
    plugin_type = server.take(f"{name}.plugin", str, dict(zip(listed, types, strict=False)).get(name, ""))
    plugin = _name(plugin_type)
    if plugin == SHIM:
        primary = "primary_controller" if f"{name}.primary_controller" in server else "primary_controller.plugin"
        return plugin, _name(server.take(f"{name}.{primary}", str, ""))
    return (plugin,) if plugin else tuple(HERE)


def _unfit(server: Nav2Block, plugin: str, ids: list[str], listed: tuple[str, ...]) -> InputError:
    """Return the error that no block is of a plugin."""
    kinds = {name: _plugins(server, name, listed) for name in ids}
    known = [HERE[kind[-1]] for kind in kinds.values() if kind[-1] in HERE]
    hint = f"choose `plugin: {known[0]}`" if known else f"controllers here: {', '.join(HERE)}"
    if len(ids) == 1:
        named = next((key for key in ("primary_controller", "plugin") if f"{ids[0]}.{key}" in server), "plugin")
        return server.error(f"{kinds[ids[0]][-1]} is not {plugin}", f"{ids[0]}.{named}", hint=hint)
    words = ", ".join(f"{name} is {kind[-1]}" for name, kind in kinds.items())
    return server.error(f"no controller is {plugin}: {words}", "controller_plugins", hint=hint)


def _name(plugin: str) -> str:
    """Return the name of a plugin; older releases also write `/` for `::`."""
    return plugin.replace("/", "::")
