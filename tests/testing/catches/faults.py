"""Components with one fault, and the checks that they fail."""

import attrs

from mrpbench_core import testing

frozen = attrs.frozen(kw_only=True)


def failures(component):
    """Reasons of failed checks, by name."""
    return {
        check.name: check.reason
        for check in testing.run_checks(testing.suite_for(component))
        if check.outcome == "failed"
    }


def changed(base, **methods):
    """A component like `base` with other methods or class attributes."""
    name = f"Changed{len(globals())}"
    made = frozen(type(name, (base,), {"__doc__": "Changed.", "__module__": __name__, **methods}))
    globals()[name] = made  # where pickle and configurations look for it
    return made
