"""What is raised when a component does not keep its contract."""


class BrokenContractError(Exception):
    """A component returned what its contract rules out; says which and what."""
