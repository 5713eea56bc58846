"""The exception for a component that breaks its contract."""


class BrokenContractError(Exception):
    """A component returned something that its contract forbids; the message names the component and the value."""
