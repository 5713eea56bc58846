"""The metrics of POGEMA by the definitions of its code, version 1.4.

They differ from those of the field by one where noted: steps are counted from 1.
"""

import numpy as np

from mrpbench_core.api import Bool, Int


def one_shot(on_goal: Bool) -> dict[str, float]:
    """Return CSR, ISR, SoC, makespan and ep_length of an episode in which robots stay at their goals (`nothing`).

    Args:
        on_goal: bool[T,n] whether each robot is at its goal after each of T steps.
    """
    arrival = settled(on_goal)
    return {
        "CSR": float(on_goal[-1].all()),
        "ISR": float(on_goal[-1].mean()),
        "SoC": float(arrival.sum()),
        "makespan": float(arrival.max(initial=0)),
        "ep_length": float(len(on_goal)),
    }


def finishing(on_goal: Bool) -> dict[str, float]:
    """Return CSR, ISR and ep_length of an episode in which robots leave the grid at their goals (`finish`).

    Args:
        on_goal: bool[T,n] whether each robot has been at its goal in each of T steps or before.
    """
    steps, robots = on_goal.shape
    last = np.where(on_goal.any(axis=0), on_goal.argmax(axis=0), steps - 1)
    return {
        "CSR": float(on_goal[-1].all()),
        "ISR": float(on_goal[-1].mean()),
        "ep_length": float(last.sum() / robots + 1),
    }


def settled(on_goal: Bool) -> Int:
    """Return the step i8[n], from 1, since which each robot is at its goal, the last one if it is not.

    As in POGEMA, it does not matter where a robot is after the last step.
    """
    stays = on_goal[-2::-1].cumprod(axis=0).sum(axis=0) if len(on_goal) > 1 else np.zeros(on_goal.shape[1], np.int64)
    step: Int = len(on_goal) - stays
    return step
