"""Searches for fleets of which the exact answer is known: robots take the same time for each order, at random times.

The distribution of waits of M/D/c is exact: C. D. Crommelin, "Delay probability formulae when the holding times are
constant", Post Office Electrical Engineers Journal 25, 1932; G. J. Franx, "A simple solution for the M/D/c waiting time
distribution", Operations Research Letters 29, 2001.
"""

import heapq
import math
from types import SimpleNamespace

import numpy as np
import pytest
from mrpbench_search.sizing.fleets import Verdict, smallest
from mrpbench_search.sizing.held_out import drive_held_out
from mrpbench_search.sizing.search import Fleets
from scipy.stats import poisson

WARM_UP = 1800.0


def share_within(rate, service, robots, bound, states=400):
    """The share of orders that are done within a bound, in the long run; `rate` in 1/s and times in s."""
    arrivals = poisson.pmf(np.arange(states), rate * service)
    step = np.zeros((states, states))  # from one number of open orders to that one service time later
    for here in range(states):
        left = max(0, here - robots)
        step[here, left:] = arrivals[: states - left]
    matrix = step.T - np.eye(states)
    matrix[-1] = 1.0
    at_most = np.cumsum(np.linalg.solve(matrix, np.eye(states)[-1]))
    wait = bound - service
    if wait < 0:
        return 0.0
    services = int(wait // service) + 1
    mean = rate * (services * service - wait)
    count = services * robots
    few_wait = at_most[robots : robots + count]  # by the number of those that wait
    return float(few_wait[::-1] @ poisson.pmf(np.arange(count), mean))


def served(rate, service, robots, seconds, seed):
    """Releases and ends of the orders f8[orders] of one run, first come first served."""
    generator = np.random.default_rng(seed)
    release = np.cumsum(generator.exponential(1 / rate, int(2 * rate * seconds) + 50))
    release = release[release < seconds]
    free = [0.0] * robots
    done = np.empty(len(release))
    for index, time in enumerate(release.tolist()):
        done[index] = max(time, free[0]) + service
        heapq.heapreplace(free, done[index])
    return release, done


class Queues(Fleets):
    """A search of which the runs are queues; see `Fleets`."""

    service_s = 100.0
    hours = 4.0
    offset = 0
    """Added to seeds, so that searches differ."""

    def results(self, size, samples, chargers=None):
        return [
            self._record(size, sample["seed"], sample.get("limits.execution", 3600 * self.hours)) for sample in samples
        ]

    def _record(self, robots, seed, seconds):
        release, done = served(self.rate / 60, self.service_s, robots, seconds, [self.offset, seed])
        ended = done <= seconds
        counted = (release > WARM_UP) & (release <= seconds - self.bound_s)
        time = np.linspace(WARM_UP, seconds, 500)
        waiting = np.searchsorted(release, time) - np.searchsorted(np.sort(done), time)
        growth = np.polyfit(time, waiting, 1)[0] / (self.rate / 60)
        return {
            "run_id": f"{seed}",
            "seed": seed,
            "status": "succeeded",
            "config": {
                "limits": {"execution": seconds},
                "metrics": [{"plugin": "tasks", "warm_up": WARM_UP, "within": self.bound_s}],
            },
            "metrics": {
                "tasks.open_growth": float(growth),
                "tasks.service_level": float(np.mean((done - release)[counted] <= self.bound_s)),
                "tasks.service_p95_s": float(np.percentile((done - release)[ended], 95)),
                "tasks.per_hour": float(ended.sum() * 3600 / seconds),
                "tasks.utilisation": min(1.0, float(ended.sum() * self.service_s / (robots * seconds))),
                "tasks.released": len(release),
                "execution.time_blocked_s": 0.0,
            },
        }


def queues(rate, bound_s, seeds, offset):
    """A search for orders per minute, with so many seeds."""
    config = {"tasks": {"plugin": "poisson", "rate": rate}, "scenario": {"robots": 1}}
    points = [SimpleNamespace(canonical=config | {"seed": seed, "repeat": 0}) for seed in range(seeds)]
    fleets = Queues(study=None, points=points, rate=rate, bound_s=bound_s, requests=None, announce=lambda _: None)
    fleets.offset = offset
    return fleets


@pytest.mark.parametrize("bound", [110.0, 150.0, 230.0])
def test_with_one_robot_the_share_in_time_is_that_of_erlang(bound):
    """M/D/1 in closed form: A. K. Erlang, 1909."""
    rate, service, wait = 0.007, 100.0, bound - 100.0
    terms = range(int(wait // service) + 1)
    exact = (1 - rate * service) * sum(
        (-rate * (wait - k * service)) ** k / math.factorial(k) * math.exp(rate * (wait - k * service)) for k in terms
    )
    assert share_within(rate, service, 1, bound) == pytest.approx(exact)


def test_the_simulated_queue_has_the_exact_share():
    release, done = served(0.04, 100.0, 5, 2e6, 3)
    assert np.mean(done - release <= 150) == pytest.approx(share_within(0.04, 100.0, 5, 150.0), abs=0.02)


@pytest.mark.parametrize(("rate", "bound", "needed"), [(2.4, 250.0, 5), (3.3, 200.0, 7)])
def test_the_smallest_fleet_is_found_and_one_robot_fewer_does_not_serve(rate, bound, needed):
    found, held_out = [], []
    for offset in range(5):
        fleets = queues(rate, bound, seeds=8, offset=offset)
        fleets.run(3)
        found.append(smallest(fleets.verdicts))
        held_out.append([run.serves for run in drive_held_out(fleets, 10 * 3600.0)])
    assert found == [(needed, needed)] * 5
    serves, fewer = np.sum(held_out, axis=0)
    assert serves >= 3, "one run of ten hours may have more orders than the mean"
    assert fewer == 0


def test_a_fleet_at_the_bound_is_left_open_and_no_wrong_statement_is_made():
    """With 14 robots 95.15 % of the orders are in time, which no search of a hundred runs shows."""
    assert share_within(0.1, 100.0, 14, 120.0) == pytest.approx(0.9515, abs=1e-4)
    for offset in range(3):
        fleets = queues(6.0, 120.0, seeds=4, offset=offset)
        fleets.run(8)
        for size, verdict in fleets.verdicts.items():
            assert verdict is not (Verdict.SERVES if size < 14 else Verdict.DOES_NOT)
        assert smallest(fleets.verdicts)[0] == 14
