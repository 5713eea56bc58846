"""`mrpbench new-plugin KIND NAME`: write a distribution that installs, runs and passes its checks, as a start."""

import argparse
import keyword
import re
from importlib import resources
from pathlib import Path
from string import Template

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import installed
from mrpbench_core.plugins.kinds import group_of, singular
from mrpbench_core.version import __version__

SHARED = {"pyproject.toml.txt", "README.md.txt", "gitignore.txt", "init.py.txt", "test.py.txt"}
EXAMPLES = {"scenario": {"robots": 3}}
"""Required options of a template, by kind, with values for its test."""
NAME = re.compile(r"[a-z][a-z0-9]*([_-][a-z0-9]+)*")


@attrs.frozen
class Plugin:
    """The names of a new plugin; all follow from its kind and name."""

    kind: str
    name: str

    @property
    def kinds(self) -> str:
        """Plural of the kind, as in its entry-point group."""
        return group_of(self.kind).rpartition(".")[2]

    @property
    def package(self) -> str:
        """Name of the package."""
        return f"mrpbench_{self.kinds}_{self.name}"

    @property
    def distribution(self) -> str:
        """Name of the distribution."""
        return self.package.replace("_", "-")

    @property
    def class_name(self) -> str:
        """Name of the component's class."""
        return "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def placeholders(self) -> dict[str, str]:
        """Values of the placeholders in the templates."""
        major, minor = __version__.split(".")[:2]
        options = EXAMPLES.get(self.kind, {})
        return {
            "kind": self.kind,
            "Kind": self.kind.capitalize(),
            "kinds": self.kinds,
            "name": self.name,
            "package": self.package,
            "distribution": self.distribution,
            "Class": self.class_name,
            "Suite": f"{self.kind.capitalize()}Conformance",
            "version": f"{major}.{minor}",
            "next_version": f"{major}.{int(minor) + 1}",
            "arguments": ", ".join(f"{key}={value}" for key, value in options.items()),
            "example": "".join(f" {key}={value}" for key, value in options.items()),
            "yaml": "".join(f", {key}: {value}" for key, value in options.items()),
        }


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("kind", metavar="KIND", help=", ".join(kinds()))
    parser.add_argument("name", metavar="NAME", help="name in configurations: lower-case letters, digits, _")
    parser.add_argument(
        "--folder", metavar="DIR", type=Path, help="folder to create (default: the name of the distribution)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the folder."""
    plugin = named(arguments.kind, arguments.name)
    folder = arguments.folder or Path(plugin.distribution)
    write(plugin, folder)
    example = plugin.placeholders["example"]
    print(f"wrote {folder}: a working {plugin.kind}. Next:")
    print(f"  pip install -e {folder}")
    print(f"  mrpbench check {plugin.kind}:{plugin.name}{example}")
    return 0


def kinds() -> list[str]:
    """Return the kinds that have a template."""
    files = (file.name for file in resources.files("mrpbench_core.cli").joinpath("templates").iterdir())
    return sorted(name.removesuffix(".py.txt") for name in files if name.endswith(".py.txt") and name not in SHARED)


def named(kind: str, name: str) -> Plugin:
    """Return the names of the plugin that the user asks for.

    Raises:
        InputError: there is no template for the kind, or the name is invalid or taken.
    """
    kind = singular(kind)
    if kind not in kinds():
        raise InputError(f"there is no template for a {kind!r}", hint=f"there are {', '.join(kinds())}")
    plugin = Plugin(kind, name.replace("-", "_"))
    if not NAME.fullmatch(name):
        raise InputError(
            f"{name!r} is not a name", hint="use lower-case letters, digits and _, beginning with a letter"
        )
    if keyword.iskeyword(plugin.name):
        raise InputError(f"{name!r} is a keyword of Python", hint="choose another name")
    if plugin.class_name in _words(plugin):
        raise InputError(f"the template already uses the name {plugin.class_name}", hint="choose another name")
    for provider in installed():
        if provider.kind == kind and provider.name == plugin.name:
            raise InputError(f"{kind} {plugin.name!r} is installed already, by {provider.origin}")
    return plugin


def write(plugin: Plugin, folder: Path) -> None:
    """Write the distribution.

    Raises:
        InputError: the folder exists already, or cannot be written.
    """
    files = {
        "pyproject.toml": "pyproject.toml.txt",
        "README.md": "README.md.txt",
        ".gitignore": "gitignore.txt",
        f"{plugin.package}/__init__.py": "init.py.txt",
        f"{plugin.package}/{plugin.name}.py": f"{plugin.kind}.py.txt",
        f"tests/test_{plugin.name}.py": "test.py.txt",
    }
    texts = {file: Template(_template(name)).substitute(plugin.placeholders) for file, name in files.items()}
    texts[f"{plugin.package}/py.typed"] = ""
    try:
        folder.mkdir(parents=True)
        for file, text in texts.items():
            path = folder / file
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
    except FileExistsError:
        raise InputError("exists already and is not overwritten", file=folder) from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=folder) from None


def _words(plugin: Plugin) -> set[str]:
    """Return the capitalised names in the template."""
    return set(re.findall(r"\b[A-Z]\w*", _template(f"{plugin.kind}.py.txt")))


def _template(name: str) -> str:
    return resources.files("mrpbench_core.cli").joinpath("templates", name).read_text(encoding="utf-8")
