"""The hook plugins that observe a study, each in a process of its own: one that ends or blocks it costs no run."""

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, Self

import attrs

from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.processes.channel import Channel, ClosedError, GarbledError, new_key
from mrpbench_core.engine.processes.child import ENDING_S
from mrpbench_core.engine.processes.limits import IMPORT_S
from mrpbench_core.plugins.hooks import DISABLE, LOG, Hooks, enabled_hooks
from mrpbench_core.plugins.importing import attributed_to
from mrpbench_core.plugins.installed import Provider

CLOSING_S = 5.0
"""Seconds from the end of a connection to the end of its process."""
HOOK_S = 60.0
"""Seconds that a hook may take."""
OBSERVED = ("mrpbench_study_started", "mrpbench_run_started", "mrpbench_run_finished", "mrpbench_study_finished")


class StudyHooks:
    """The hooks of one study; a context manager."""

    def __init__(self) -> None:
        failed = f"a hook plugin cannot be used ({DISABLE} can leave it out)"
        chosen = in_worker(failed, observers) if enabled_hooks() else []
        self._observers = [Observer(Provider(**provider)) for provider in chosen]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for observer in self._observers:
            observer.close()

    def call(self, hook: str, **arguments: Any) -> None:
        """Call every implementation of `hook` with plain data, one after another."""
        for observer in list(self._observers):
            if (fault := observer.call({"hook": hook, "arguments": arguments})) is not None:
                LOG.warning("hook plugin %r is disabled for this study: %s: %s", observer.name, hook, fault)
                self._observers.remove(observer)


def observers() -> list[dict[str, Any]]:
    """In a worker process: check all hook plugins; return those that observe studies, as plain data."""
    providers = []
    for provider in enabled_hooks():
        hooks = Hooks()
        with attributed_to(f"{provider.kind} {provider.name!r} of {provider.origin}"):
            hooks.load(provider)
            hooks.check()
        if any(map(hooks.has, OBSERVED)):
            providers.append(attrs.asdict(provider))
    return providers


class Observer:
    """The process of one hook plugin, which ends with this process."""

    def __init__(self, provider: Provider) -> None:
        self.name = provider.name
        self._start: dict[str, Any] | None = {"provider": attrs.asdict(provider)}
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "mrpbench_core.engine.study.hook_process", str(theirs.fileno())],
                stdin=subprocess.DEVNULL,
                stdout=2,  # standard output is for what the command prints
                pass_fds=[theirs.fileno()],
                start_new_session=True,
            )
        key = new_key()
        ours.sendall(key)
        self._channel = Channel(ours, key)

    def call(self, message: Mapping[str, Any]) -> str | None:
        """Let it call a hook; return what went wrong, after which the process has ended."""
        if self._start is not None:
            start, self._start = self._start, None
            if (fault := self._ask(start, IMPORT_S)) is not None:
                return fault
        return self._ask(message, HOOK_S)

    def close(self) -> None:
        """End it, and all that it started."""
        self._channel.shut_down()
        try:
            self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            self._end()
        self._channel.close()

    def _ask(self, message: Mapping[str, Any], limit_s: float) -> str | None:
        try:
            self._channel.send(message)
            if self._channel.receive(limit_s) is not None:
                return None
            self._end()
            fault = f"it did not return within {limit_s:g} s"
        except GarbledError:
            self._end()
            fault = "it wrote to the connection of the engine"
        except ClosedError:
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(CLOSING_S)
            self._end()
            code = self._process.returncode
            fault = f"its process ended with exit code {code}" if code >= 0 else f"its process ended by signal {-code}"
        self._channel.close()
        return fault

    def _end(self) -> None:
        """Let it end what the plugin started; if the plugin keeps it from that, kill it."""
        self._process.terminate()
        try:
            self._process.wait(ENDING_S)
        except subprocess.TimeoutExpired:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
