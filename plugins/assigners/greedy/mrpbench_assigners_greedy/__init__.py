"""Greedy assigners: of tasks at once, and of queues of tasks that come over time."""

from mrpbench_assigners_greedy.greedy import Greedy
from mrpbench_assigners_greedy.insertion import Insertion
from mrpbench_assigners_greedy.token_passing import TokenPassing

__all__ = ["Greedy", "Insertion", "TokenPassing"]
