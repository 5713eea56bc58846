"""The actions that vehicles know, and where each may be."""

from collections.abc import Mapping

from mrpbench_live.vda5050.names import Names

SCOPES: Mapping[str, tuple[str, ...]] = {
    "cancelOrder": ("INSTANT",),
    "startPause": ("INSTANT",),
    "stopPause": ("INSTANT",),
    "stateRequest": ("INSTANT",),
    "factsheetRequest": ("INSTANT",),
    "clearInstantActions": ("INSTANT",),
    "trigger": ("INSTANT",),
    "initializePosition": ("INSTANT",),
    "startCharging": ("INSTANT", "NODE"),
    "stopCharging": ("INSTANT", "NODE"),
    "pick": ("NODE",),
    "drop": ("NODE",),
    "detectObject": ("NODE", "EDGE"),
    "finePositioning": ("NODE", "EDGE"),
    "waitForTrigger": ("NODE",),
}
"""In the words of 3.0."""
ZONE_SCOPES: Mapping[str, tuple[str, ...]] = dict.fromkeys(
    ("downloadZoneSet", "enableZoneSet", "deleteZoneSet"), ("INSTANT",)
)
"""What vehicles know besides where zones exist."""


def scopes_of(names: Names) -> Mapping[str, tuple[str, ...]]:
    """Return the actions that vehicles of a version know, and where each may be."""
    return {**SCOPES, **ZONE_SCOPES} if names.zones else SCOPES
