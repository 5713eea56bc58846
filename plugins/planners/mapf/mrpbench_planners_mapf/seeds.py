"""Where the random choices of a planner begin."""

import attrs

from mrpbench_core.api.component import option


def seed_option(what: str) -> int | None:
    """The option that sets the seed; None leaves it to the run."""
    seed: int | None = option(
        None,
        help=f"{what}; without it drawn from the run's seed and repeat.",
        validator=attrs.validators.optional(attrs.validators.ge(0)),
    )
    return seed
