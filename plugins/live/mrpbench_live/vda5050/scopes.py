"""The actions that vehicles know, and where each may be."""

from collections.abc import Mapping

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
