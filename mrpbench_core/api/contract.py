"""The exception for a component that breaks its contract."""


class BrokenContractError(Exception):
    """A component returned something that its contract forbids.

    Args:
        message: names the kind of the component, and the value.
        setting: the key of the configuration that chooses the component, such as `simulator`, if it is known.
    """

    def __init__(self, message: str, setting: str = "") -> None:
        super().__init__(message)
        self.setting = setting
