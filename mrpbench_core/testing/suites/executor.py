"""Checks that every executor must pass."""

from concurrent.futures import Executor

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.suites.component import ComponentConformance


class ExecutorConformance(ComponentConformance):
    """Checks of executors: `class TestMine(ExecutorConformance)`."""

    def make(self) -> ExecutorSource:
        """Return the executor to check."""
        raise NotImplementedError("define make(self) and return the executor to check")

    def test_is_an_executor_of_the_standard_library(self) -> None:
        with self.make().open(1) as executor:
            require(
                isinstance(executor, Executor),
                f"opens {type(executor).__name__} instead of a concurrent.futures.Executor",
            )

    def test_opens_with_several_workers_or_says_why_not(self) -> None:
        try:
            executor = self.make().open(2)
        except InputError as refusal:
            raise Skip(str(refusal)) from None
        with executor:
            results = [future.result(timeout=60) for future in [executor.submit(abs, -number) for number in range(8)]]
        require(results == list(range(8)), f"two workers returned {results}")

    def test_returns_the_results_of_calls(self) -> None:
        with self.make().open(1) as executor:
            futures = [executor.submit(divmod, number, 7) for number in range(20)]
            results = [future.result(timeout=60) for future in futures]
        require(results == [divmod(number, 7) for number in range(20)], f"20 calls returned {results}")

    def test_equal_calls_are_all_made(self) -> None:
        with self.make().open(1) as executor:
            futures = [executor.submit(object) for _ in range(5)]
            results = [future.result(timeout=60) for future in futures]
        require(
            len({id(each) for each in results}) == 5,
            "equal calls were made only once, so that repeated runs would be lost",
        )

    def test_passes_on_the_exceptions_of_calls(self) -> None:
        with self.make().open(1) as executor:
            error = executor.submit(divmod, 1, 0).exception(timeout=60)
            require(isinstance(error, ZeroDivisionError), f"a call that raises ZeroDivisionError gave {error!r}")
            if executor.submit(divmod, 9, 2).result(timeout=60) != (4, 1):
                raise Fault("fails after a call has raised: pass the exception on, and go on")
