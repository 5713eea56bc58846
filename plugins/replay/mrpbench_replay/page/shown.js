// What the viewer chose to see.

export const LAYERS = [
  { key: "names", label: "Names", letter: "n" },
  { key: "lanes", label: "Lanes", letter: "a" },
  { key: "plan", label: "Plan", letter: "p" },
  { key: "driven", label: "Driven", letter: "d" },
  { key: "reserved", label: "Reserved", letter: "r" },
  { key: "tasks", label: "Tasks", letter: "o" },
  { key: "waits", label: "Waits", letter: "w" },
  { key: "estimate", label: "Estimate", letter: "m" },
  { key: "lidar", label: "Lidar", letter: "l" },
  { key: "map", label: "Robot maps", letter: "s" },
  { key: "trajectories", label: "Trajectories", letter: "y" },
  { key: "heat", label: "Heat", letter: "h" },
  { key: "gantt", label: "Gantt", letter: "g" },
];
const FEW = 40; // number of robots whose paths a reader can distinguish

export class Shown extends EventTarget {
  constructor(run, recorded) {
    super();
    const few = run.count <= FEW;
    this.many = !few;
    const missing = {
      names: !run.world.vertices.some(([, , , name]) => name),
      lanes: !run.world.lanes.length,
      reserved: !run.arrays.released,
      tasks: !run.tasks,
      waits: !run.arrays.reason,
      estimate: !run.ghost,
      lidar: !recorded.scans,
      map: !recorded.maps,
      trajectories: !recorded.trajectories,
      heat: !run.arrays.mode,
    };
    this.offered = LAYERS.filter(({ key }) => !missing[key]);
    if (!run.planned) this.offered = this.offered.map((it) => (it.key === "plan" ? { ...it, label: "Goals" } : it));
    this.layers = { names: few, lanes: true, plan: few, driven: few, reserved: true, tasks: true, waits: true, estimate: false, lidar: false, map: false, trajectories: Boolean(recorded.trajectories), heat: false, gantt: false };
    this.colour = few ? "robot" : "state";
    this.selected = -1;
    this.follow = false;
    this.level = run.value("level", 0, 0);
    this.dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  }

  set(changes) {
    Object.assign(this, changes);
    this.dispatchEvent(new Event("change"));
  }

  setLayer(key, on = !this.layers[key]) {
    if (this.offered.some((layer) => layer.key === key)) this.set({ layers: { ...this.layers, [key]: on } });
  }

  /** Choose a robot (-1 = none). Of many robots, only the chosen one's paths are shown unless one asks for all. */
  select(robot, follow = true) {
    const one = robot >= 0;
    const paths = this.many && one !== this.selected >= 0 ? { plan: one, driven: one } : {};
    this.set({ selected: robot, follow: one && follow, layers: { ...this.layers, ...paths } });
  }
}
