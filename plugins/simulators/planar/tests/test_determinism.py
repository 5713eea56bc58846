import hashlib
import subprocess
import sys

SCRIPT = """
import hashlib, sys, numpy as np
from mrpbench_simulators_planar import Planar
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.execution.state import Inputs
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import Level, World
room = World(name="room", levels=(Level(name="L1", walls=[[0, 0, 2, 0], [2, 0, 2, 2], [2, 2, 0, 2], [0, 2, 0, 0]]),))
starts = np.array([[x, y, x + y] for x in (0.4, 1.0, 1.6) for y in (0.4, 1.0, 1.6)])
random, digest, scans = np.random.default_rng(7), hashlib.sha256(), hashlib.sha256()
contacts = 0
fleet = Fleet(robots=(load_robot("turtlebot3_burger"),) * 9)
planar = Planar(slip=0.02, actuation_noise=0.05, threads=int(sys.argv[1]))
with planar.open(room, fleet, starts, 11, 0.05, (0.2,)) as simulation:
    for period in range(401):
        movers = np.array([[1 + np.sin(period / 50), 1.3, 0, 0]])
        state = simulation.step(Inputs(twist=random.uniform(-1, 1, (9, 2)), movers=movers))
        contacts += len(state.contacts)
        digest.update(state.pose.tobytes() + state.twist.tobytes() + state.contacts.tobytes())
        if period % int(sys.argv[2]) == 0:
            for batch in simulation.scans():
                scans.update(batch.ranges.tobytes())
assert contacts > 50
print(digest.hexdigest(), scans.hexdigest())
"""


def test_two_processes_agree_to_the_last_bit_with_any_number_of_threads():
    def run(threads, every=1):
        command = [sys.executable, "-c", SCRIPT, str(threads), str(every)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    first = run(1)
    assert len(first.split()[0]) == hashlib.sha256().digest_size * 2
    assert first == run(3)
    assert first == run(2, every=5)  # scans are read late
