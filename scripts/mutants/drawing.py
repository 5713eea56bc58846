"""Mutants of the production code: each changes one bound, sign or check of one file."""

import ast
import hashlib
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import attrs

ROOT = Path(__file__).parents[2]
KINDS = ("bound", "sign", "check")
_COMPARISONS: dict[type[ast.cmpop], tuple[str, str]] = {
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.In: (" in ", " not in "),
    ast.NotIn: (" not in ", " in "),
    ast.Is: (" is ", " is not "),
    ast.IsNot: (" is not ", " is "),
}
_ARITHMETIC: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
}

_BOUNDED = ("min", "max", "minimum", "maximum", "clip", "range", "arange")
"""Calls whose arguments are bounds."""


@attrs.frozen(kw_only=True)
class Mutant:
    """One change: `before` becomes `after` between two offsets of a file's text."""

    file: str
    """Relative to the checkout."""
    scope: str
    """Qualified name of the innermost function or class; empty in a module."""
    in_function: bool
    kind: str
    line: int
    """From 1: where the change is."""
    start: int
    """Offset in the file's bytes."""
    before: str
    after: str
    id: str
    """The same for the same change of the same text, wherever in its scope that is."""

    def apply(self, text: str) -> str:
        """The text of the file with the change."""
        content, before = text.encode(), self.before.encode()
        end = self.start + len(before)
        if content[self.start : end] != before:
            raise ValueError(f"{self.file}:{self.line} is not what it was when the mutant was drawn")
        return (content[: self.start] + self.after.encode() + content[end:]).decode()


def production_files() -> list[str]:
    """Python files of all distributions, relative to the checkout, without tests."""
    packages = [ROOT / "mrpbench_core", ROOT / "native/python/mrpbench_native", *ROOT.glob("plugins/**/mrpbench_*/")]
    return sorted(str(file.relative_to(ROOT)) for package in packages for file in package.rglob("*.py"))


def draw(files: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """As many mutants of each kind; the order depends on their ids, so that a change elsewhere draws the same ones."""
    queues: dict[str, list[Mutant]] = {kind: [] for kind in KINDS}
    for mutant in (mutant for file in files for mutant in mutants(file)):
        queues[mutant.kind].append(mutant)
    for queue in queues.values():
        queue.sort(key=lambda mutant: hashlib.sha256(f"{seed} {mutant.id}".encode()).digest())
    drawn = [queues[kind][place] for place in range(count) for kind in KINDS if place < len(queues[kind])]
    return drawn[:count]


def mutants(file: str) -> list[Mutant]:
    """All mutants of one file."""
    text = (ROOT / file).read_text()
    lines = text.encode().splitlines(keepends=True)
    offsets = [0]
    for line in lines:
        offsets.append(offsets[-1] + len(line))
    content, seen, found = text.encode(), Counter[str](), []
    for kind, scope, in_function, (row, column), (end_row, end_column), find, after in _changes(ast.parse(text)):
        start, end = offsets[row - 1] + column, offsets[end_row - 1] + end_column
        before = content[start:end].decode()
        if find is not None:  # an operator: somewhere between its operands
            if before.count(find) != 1:
                continue
            start, before = start + before.index(find), find
        number = content.count(b"\n", 0, start)
        around = lines[number].strip().decode()
        key = f"{file}\0{scope}\0{around}\0{start - offsets[number]}\0{before}\0{after}"
        seen[key] += 1
        identity = hashlib.sha256(f"{key}\0{seen[key]}".encode()).hexdigest()[:12]
        found.append(
            Mutant(
                file=file, scope=scope, in_function=in_function, kind=kind, line=number + 1, start=start,
                before=before, after=after, id=identity,
            )
        )  # fmt: skip
    return found


_Place = tuple[int, int]
_Change = tuple[str, str, bool, _Place, _Place, str | None, str]
"""Kind, scope, whether that is in a function, start, end, the operator to look for, and what takes its place."""


def _changes(tree: ast.Module) -> Iterator[_Change]:
    pending: list[tuple[ast.AST, str, bool]] = [(tree, "", False)]
    while pending:
        node, scope, in_function = pending.pop()
        for kind, start, end, find, after in _changes_of(node):
            yield kind, scope, in_function, start, end, find, after
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            scope = f"{scope}.{node.name}".lstrip(".")
            in_function = in_function or not isinstance(node, ast.ClassDef)
        annotations = [getattr(node, name, None) for name in ("annotation", "returns")]
        children = [child for child in ast.iter_child_nodes(node) if child not in annotations]
        pending += [(child, scope, in_function) for child in reversed(children)]


def _changes_of(node: ast.AST) -> Iterator[tuple[str, _Place, _Place, str | None, str]]:
    """The changes of this node itself."""
    match node:
        case ast.Compare(left=left, ops=[operator], comparators=[right]):
            old, new = _COMPARISONS[type(operator)]
            yield "bound" if old[0] in "<>" else "sign", _end(left), _start(right), old, new
            yield from _bounds(left, right)
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=arguments) if name in _BOUNDED:
            yield from _bounds(*arguments)
        case ast.BinOp(op=operator, left=left, right=right) if type(operator) in _ARITHMETIC and not _is_text(node):
            old, new = _ARITHMETIC[type(operator)]
            yield "sign", _end(left), _start(right), old, new
            yield from _bounds(left, right)
        case ast.BoolOp(op=operator, values=[*_, left, right]):
            old, new = ("and", "or") if isinstance(operator, ast.And) else ("or", "and")
            yield "sign", _end(left), _start(right), old, new
        case ast.UnaryOp(op=ast.Not() | ast.USub() as operator, operand=operand) if not isinstance(
            operand, ast.Constant
        ):
            yield "sign", _start(node), _start(operand), "not" if isinstance(operator, ast.Not) else "-", ""
        case ast.If(test=test, body=[*_, ast.Raise() | ast.Return() | ast.Continue() | ast.Break()], orelse=[]):
            yield "check", _start(test), _end(test), None, "False"
        case ast.Expr(value=ast.Call()):
            yield "check", _start(node), _end(node), None, "pass"


def _bounds(*operands: ast.expr) -> Iterator[tuple[str, _Place, _Place, str | None, str]]:
    """A number one greater, for each operand that is a number."""
    for node in operands:
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            yield "bound", _start(node), _end(node), None, repr(node.value + 1)


def _is_text(node: ast.BinOp) -> bool:
    """Whether an operand shows that text is joined or formatted, not numbers."""
    sides = (node.left, node.right)
    return any(
        isinstance(side, ast.JoinedStr) or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in sides
    )


def _start(node: ast.expr | ast.stmt) -> _Place:
    return node.lineno, node.col_offset


def _end(node: ast.expr | ast.stmt) -> _Place:
    assert node.end_lineno is not None
    assert node.end_col_offset is not None
    return node.end_lineno, node.end_col_offset
