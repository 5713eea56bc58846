"""Directives that write the reference of Python from its source.

`{api-of} MODULE` writes the public classes and functions of a module, `{surface}` the names of `mrpbench_core.api`
by topic.

Types are those of the source (`Float`, not the union for which it stands), and docstrings are Markdown.
"""

import ast
import importlib.util
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

from generated import Written, table
from sphinx.application import Sphinx

from mrpbench_core import api

SECTION = re.compile(r"^(Args|Raises|Returns|Yields):\n((?:    .*\n?|\n)+)", re.MULTILINE)
TITLES = {"Args": "Arguments", "Raises": "Errors", "Returns": "Returns", "Yields": "Yields"}
Body = ast.Module | ast.ClassDef
Function = ast.FunctionDef | ast.AsyncFunctionDef


class Module(Written):
    """The public parts of one module."""

    required_arguments = 1
    optional_arguments = 0

    def lines(self) -> Iterator[str]:
        """A section for each class and function."""
        name = self.arguments[0]
        spec = importlib.util.find_spec(name)
        if spec is None or spec.origin is None:
            raise self.error(f"no module {name}")
        self.env.note_dependency(spec.origin)
        module = ast.parse(Path(spec.origin).read_text(encoding="utf-8"))
        yield from (f"### {name}", "", markdown(ast.get_docstring(module)))
        yield from constants_of(module)
        for node in public(module):
            if isinstance(node, ast.ClassDef):
                yield from class_(node)
            elif isinstance(node, Function):
                yield from ("", f"#### {node.name}", *function(node))


class Surface(Written):
    """The names of `mrpbench_core.api`, from its stub."""

    optional_arguments = 0

    def lines(self) -> Iterator[str]:
        """A table for each topic."""
        stub = Path(api.__file__).with_suffix(".pyi")
        self.env.note_dependency(str(stub))
        _, *topics = re.split(r"^# (.+)\n", stub.read_text(encoding="utf-8"), flags=re.MULTILINE)
        for topic, imports in zip(topics[::2], topics[1::2], strict=True):
            names = [name.name for node in ast.parse(imports).body for name in node.names]  # type: ignore[attr-defined]
            yield from ("", f"**{topic}**", "")
            yield from table(
                [{"name": name, "meaning": meaning_of(name)} for name in names], ("name", "meaning"), "name"
            )


def meaning_of(name: str) -> str:
    """The first sentence of the docstring of a name of `mrpbench_core.api`; for an alias, what it stands for."""
    found = getattr(api, name)
    if not (inspect.isclass(found) or inspect.isroutine(found)):
        return "" if isinstance(found, dict) else f"`{inspect.formatannotation(found)}`"
    return (inspect.getdoc(found) or "").partition("\n\n")[0].replace("\n", " ")


def class_(node: ast.ClassDef) -> Iterator[str]:
    """The section of a class."""
    bases = ", ".join(map(ast.unparse, node.bases))
    yield from ("", f"#### {node.name}", f"`class {node.name}{f'({bases})' if bases else ''}`", "")
    yield markdown(ast.get_docstring(node))
    yield from constants_of(node)
    for inner in public(node):
        if isinstance(inner, Function):
            yield from ("", *function(inner))


def constants_of(node: Body) -> Iterator[str]:
    """A table of the fields of a class, or of the constants of a module, those with a docstring or a type."""
    rows = []
    for field, after in zip(node.body, [*node.body[1:], None], strict=True):
        said = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) and after.value.value
        meaning = " ".join(inspect.cleandoc(said).split()) if isinstance(said, str) else ""
        if isinstance(field, ast.AnnAssign):
            target, kind, value = field.target, ast.unparse(field.annotation), field.value
        elif isinstance(field, ast.Assign) and (isinstance(node, ast.ClassDef) or meaning):
            target, kind, value = field.targets[0], "", field.value
        else:
            continue
        name = ast.unparse(target)
        if name.startswith("_") or name == "__all__":
            continue
        default, help_ = default_of(value)
        rows.append({"name": name, "type": kind, "default": default, "meaning": meaning or help_})
    if rows:
        keys = [key for key in ("name", "type", "default", "meaning") if any(row[key] for row in rows)]
        yield from table(rows, tuple(keys), "name")


def default_of(value: ast.expr | None) -> tuple[str, str]:
    """The default of a field as its source writes it, and the help of an option."""
    if not isinstance(value, ast.Call):
        return ("" if value is None else ast.unparse(value)), ""
    called, words = ast.unparse(value.func), {word.arg: word.value for word in value.keywords}
    help_ = ast.literal_eval(words["help"]) if isinstance(words.get("help"), ast.Constant) else ""
    if called not in ("option", "attrs.field", "array", "field"):
        return ast.unparse(value), help_
    if "factory" in words:
        return {"list": "[]", "dict": "{}"}.get(ast.unparse(words["factory"]), ast.unparse(words["factory"])), help_
    default = value.args[0] if value.args and called == "option" else words.get("default")
    return ("" if default is None else ast.unparse(default)), help_


def function(node: Function) -> Iterator[str]:
    """The signature and the docstring of a function."""
    decorators = [ast.unparse(it) for it in node.decorator_list]
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    if "property" in decorators:
        head = f"{node.name}{result}"
    else:
        head = f"{node.name}({ast.unparse(node.args)}){result}".replace("(self, ", "(").replace("(self)", "()")
    yield from ("```python", *(f"@{it}" for it in decorators), head, "```")
    yield markdown(ast.get_docstring(node))


def public(node: Body) -> Iterator[ast.stmt]:
    """The public definitions in a body, in order."""
    for inner in node.body:
        if isinstance(inner, ast.ClassDef | Function) and not inner.name.startswith("_"):
            yield inner


def markdown(docstring: str | None) -> str:
    """A docstring, with its sections as lists."""

    def section(found: re.Match[str]) -> str:
        entries = inspect.cleandoc(found[2]).splitlines()
        return f"**{TITLES[found[1]]}**\n\n" + "\n".join(
            line if line.startswith(" ") else f"- {line}" for line in entries
        )

    return SECTION.sub(section, (docstring or "") + "\n").rstrip()


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("api-of", Module)
    app.add_directive("surface", Surface)
    return {"parallel_read_safe": True}
