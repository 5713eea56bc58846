// The controls of the clock: play, steps, speed, and the time axis as a slider.

import { SPEEDS } from "replay/clock.js";

const get = (id) => document.getElementById(id);

/** Connect the controls to the clock; returns `step(by)`, which stops at the next sample in a direction. */
export function playback(run, clock) {
  const step = (by) => {
    clock.toggle(false);
    run.seek(clock.now); // the last step may not be drawn yet
    const at = run.sample + (by > 0 || run.fraction === 0 ? by : 0) + (by > 0 && run.fraction >= 1 ? 1 : 0);
    clock.seek(run.time[Math.min(Math.max(at, 0), run.samples - 1)]);
  };
  for (const speed of SPEEDS) get("speed").append(new Option(`${speed}×`, speed));
  get("speed").value = clock.speed;
  get("speed").addEventListener("change", () => clock.setSpeed(Number(get("speed").value)));
  Object.assign(get("scrub"), { min: run.begin, max: run.end, value: run.begin });
  get("scrub").addEventListener("input", () => clock.seek(Number(get("scrub").value)));
  get("play").addEventListener("click", () => clock.toggle());
  get("back").addEventListener("click", () => step(-1));
  get("forth").addEventListener("click", () => step(1));
  clock.addEventListener("change", () => {
    document.body.classList.toggle("playing", clock.playing);
    get("play").setAttribute("aria-label", clock.playing ? "Pause" : "Play");
    get("speed").value = clock.speed;
  });
  return step;
}
