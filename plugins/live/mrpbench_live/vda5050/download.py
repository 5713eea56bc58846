"""Zone sets that a vehicle fetches from where `downloadZoneSet` says (3.0, 6.4.2), without stopping meanwhile."""

import hashlib
import threading
import urllib.error
import urllib.request
from typing import Any

from mrpbench_live.vda5050.messages import LARGEST, read

PATIENCE_S = 10.0
"""Wall seconds for which a server may be silent."""
SCHEMES = "http://", "https://"


class Download:
    """Fetches a file in a thread: JSON as on the topic `zoneSet`, of which the header may be missing.

    Args:
        link: where it is.
        digest: its SHA-256 in hexadecimal digits; empty: it is not checked.
    """

    def __init__(self, link: str, digest: str) -> None:
        self._link, self._digest = link, digest
        self.content: Any = None
        """What was read."""
        self.fault: str | None = None
        """Why nothing was."""
        self._thread = threading.Thread(target=self._fetch, daemon=True)
        self._thread.start()

    @property
    def over(self) -> bool:
        """True if it has succeeded or failed."""
        return not self._thread.is_alive()

    def _fetch(self) -> None:
        if not self._link.startswith(SCHEMES):
            self.fault = f"{self._link!r} is no address of a file: {' or '.join(SCHEMES)}"
            return
        try:
            with urllib.request.urlopen(self._link, timeout=PATIENCE_S) as answer:  # noqa: S310 - the scheme is one of two
                payload = answer.read(LARGEST + 1)
        except (OSError, ValueError, urllib.error.URLError) as error:
            self.fault = f"{self._link} cannot be read: {error}"
            return
        if self._digest and hashlib.sha256(payload).hexdigest() != self._digest.lower():
            self.fault = f"{self._link} has another SHA-256 than {self._digest}"
            return
        self.content, self.fault = read(payload)
