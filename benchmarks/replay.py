"""Measure the frames per second of replays in headless Chromium, which draws by software.

Prints one line per number of robots: frames per second while playing, CPU time of the browser per frame, and the size
of the page; medians of `--attempts`. Robots walk at random on a grid of lanes 1 m apart and wait now and then. The page
draws what it shows at first and the layers of `--layers`. The goal is 40 frames per second with 100 robots and 15 with
1,000, on a machine that does nothing else; on a busy machine compare CPU times.
"""

import argparse
import shutil
import statistics
import tempfile
import time
from pathlib import RobotPath as File

import numpy as np
import psutil
from mrpbench_replay.write_page import write_page
from selenium import webdriver

from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Plan, PlanResult, PlanStatus, RobotPath
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_core.store.recording import Recording, RecordingWriter

SECONDS, RATE = 60, 10
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking")
COUNT = """
const [seconds, done] = arguments;
replay.clock.setSpeed(1);
replay.clock.toggle(true);
let frames = 0;
const begin = performance.now();
const count = (now) => {
  frames++;
  if (now - begin < 1000 * seconds) requestAnimationFrame(count);
  else done([frames, (now - begin) / 1000]);
};
requestAnimationFrame(count);"""


def write_run(robots: int, file: File) -> None:
    """Write a recording of random walks, one move or wait per second."""
    random = np.random.default_rng(0)
    side = int(np.ceil(2 * np.sqrt(robots)))
    vertex = np.arange(side * side).reshape(side, side)
    pairs = np.concatenate([np.stack([vertex[:, :-1], vertex[:, 1:]], -1).reshape(-1, 2),
                            np.stack([vertex[:-1], vertex[1:]], -1).reshape(-1, 2)])  # fmt: skip
    edges = np.concatenate([pairs, pairs[:, ::-1]])
    leaving = [np.flatnonzero(edges[:, 0] == place) for place in range(side * side)]
    position = np.stack([vertex.ravel() % side, vertex.ravel() // side], axis=1) + 0.5
    start = random.choice(side * side, robots, replace=False)
    chosen = np.full((robots, SECONDS), -1)
    at = np.tile(start[:, None], SECONDS + 1)
    for second in range(SECONDS):
        moves = random.random(robots) < 0.7
        chosen[:, second] = np.where(moves, [random.choice(leaving[place]) for place in at[:, second]], -1)
        at[:, second + 1] = np.where(moves, edges[chosen[:, second], 1], at[:, second])
    roadmap = Roadmap(position=position, level=np.zeros(len(position)), heading=np.full(len(position), np.nan),
                      edges=edges, duration=np.ones((1, len(edges))), tick=1.0)  # fmt: skip
    steps = np.arange(SECONDS)
    problem = Problem(roadmap=roadmap, profile=np.zeros(robots), radius=np.full(robots, 0.2), start=start,
                      ready=np.zeros(robots), goals=tuple(((int(place),),) for place in at[:, -1]))  # fmt: skip
    corners = np.array([[0, 0], [side, 0], [side, side], [0, side]], float)
    walls = np.hstack([corners, np.roll(corners, -1, axis=0)])
    nan = np.full((SECONDS + 1, 1), np.nan)
    routes = tuple(Route(waypoint=np.hstack([position[row], nan]), level=np.zeros(SECONDS + 1),
                         speed=np.full(SECONDS, np.inf)) for row in at)  # fmt: skip
    context = RunContext(
        run_id="0" * 16,
        world=World(name="random walks", levels=(Level(name="L1", walls=walls),)),
        fleet=Fleet(robots=(load_robot("turtlebot3_burger"),) * robots),
        scenario=Scenario(
            start=np.hstack([position[start], np.full((robots, 1), np.nan)]),
            start_level=np.zeros(robots),
            tasks=tuple(Task(goals=[[*position[place], np.nan]]) for place in at[:, -1]),
        ),
        problem=problem,
        result=PlanResult(
            status=PlanStatus.SOLVED,
            plan=Plan(paths=tuple(RobotPath(edge=row, enter=steps, leave=steps + 1) for row in chosen)),
        ),
        routes=routes,
        goal=tuple((*position[place], float("nan")) for place in at[:, -1]),
    )
    times = np.arange(SECONDS * RATE + 1) / RATE
    second = np.minimum(times.astype(int), SECONDS - 1)
    share = (times - second)[:, None, None]
    places = position[at.T]
    yaw = np.arctan2(*(places[second + 1] - places[second]).transpose(2, 0, 1)[::-1])
    truth = np.dstack([places[second] * (1 - share) + places[second + 1] * share, yaw])
    reached = np.repeat(times.astype("i4")[:, None], robots, axis=1)
    waits = chosen.T[second] < 0
    writer = RecordingWriter(file, context)
    writer.write(
        {
            "time": times,
            "truth": truth,
            "level": np.zeros(reached.shape, "i2"),
            "reached": reached,
            "cleared": reached,
            "released": np.minimum(reached + np.where(waits, 0, 3), SECONDS).astype("i4"),
            "mode": waits.astype("u1"),
        }
    )
    writer.close()


def play(page: File, seconds: float, layers: list[str]) -> tuple[float, float]:
    """Play a page; return frames per second, and the CPU time of the browser per frame in milliseconds."""
    options = webdriver.ChromeOptions()
    for flag in FLAGS:
        options.add_argument(flag)
    options.binary_location = shutil.which("chromium") or ""
    service = webdriver.ChromeService(shutil.which("chromedriver"))
    browser = webdriver.Chrome(options=options, service=service)
    try:
        screen = {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False}
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
        browser.get(page.as_uri())
        while not browser.execute_script("return document.body.classList.contains('ready')"):
            time.sleep(0.05)
        for layer in layers:
            browser.execute_script("replay.shown.setLayer(arguments[0], true)", layer)
        browser.set_script_timeout(10 * seconds + 30)
        before = _cpu_time(service.process.pid)
        frames, taken = browser.execute_async_script(COUNT, seconds)
        return frames / taken, 1000 * (_cpu_time(service.process.pid) - before) / frames
    finally:
        browser.quit()


def _cpu_time(driver: int) -> float:
    """Seconds that all processes of the browser have computed."""
    times = [process.cpu_times() for process in psutil.Process(driver).children(recursive=True)]
    return sum(time.user + time.system for time in times)


def main() -> None:
    """Write and play a page for each number of robots."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 100, 1000])
    parser.add_argument("--seconds", type=float, default=5.0, help="seconds of playing (default: %(default)s)")
    parser.add_argument("--attempts", type=int, default=3, help="times that each page is played (default: %(default)s)")
    parser.add_argument("--layers", nargs="*", default=[], help="layers that are drawn in addition to the usual ones")
    parser.add_argument("--keep", type=File, help="folder that keeps the pages")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.keep or File(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        for robots in arguments.robots:
            page, run = folder / f"{robots}.html", folder / f"{robots}.zip"
            write_run(robots, run)
            recording = Recording(run)
            write_page(recording, {"run_id": "0" * 16, "status": "succeeded"}, page, planner="random walks")
            recording.close()
            played = [play(page, arguments.seconds, arguments.layers) for _ in range(arguments.attempts)]
            rate, cost = (statistics.median(values) for values in zip(*played, strict=True))
            size = page.stat().st_size / 2**20
            print(
                f"{robots:5d} robots: {rate:5.1f} frames/s, {cost:5.1f} ms CPU time per frame, {size:.1f} MiB",
                flush=True,
            )


if __name__ == "__main__":
    main()
