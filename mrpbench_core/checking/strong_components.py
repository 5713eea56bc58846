"""Strongly connected components: Tarjan, "Depth-first search and linear graph algorithms", SIAM J. Computing 1972."""

from collections.abc import Iterator


def strong_components(before: list[int], after: list[int]) -> list[tuple[int, ...]]:
    """The sorted components of at least two nodes, of a graph with arcs `before[i] -> after[i]`."""
    next_of: dict[int, list[int]] = {}
    for one, other in zip(before, after, strict=True):
        next_of.setdefault(one, []).append(other)
    number: dict[int, int] = {}
    lowest: dict[int, int] = {}
    open_nodes: dict[int, None] = {}  # a stack with quick look-up
    components = []
    trail: list[tuple[int, Iterator[int]]] = []  # instead of recursion, which a long convoy of robots would exhaust

    def enter(node: int) -> None:
        number[node] = lowest[node] = len(number)
        open_nodes[node] = None
        trail.append((node, iter(next_of.get(node, ()))))

    for root in next_of:
        if root not in number:
            enter(root)
        while trail:
            node, ahead = trail[-1]
            for other in ahead:
                if other not in number:
                    enter(other)
                    break
                if other in open_nodes:
                    lowest[node] = min(lowest[node], number[other])
            else:
                trail.pop()
                if trail:
                    lowest[trail[-1][0]] = min(lowest[trail[-1][0]], lowest[node])
                if lowest[node] == number[node]:
                    component: list[int] = []
                    while not component or component[-1] != node:
                        component.append(open_nodes.popitem()[0])
                    if len(component) > 1:
                        components.append(tuple(sorted(component)))
    return sorted(components)
