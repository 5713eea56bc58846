// Puts the page together and draws it, a frame at a time and only when something changed.

import { EventPanel, eventText, fillAbout, fillFigures, fillHeader } from "replay/about.js";
import { boundsOf } from "replay/bounds.js";
import { Clock, clockText } from "replay/clock.js";
import { coloursOf } from "replay/colours.js";
import { layerControls, levelControls, tabs } from "replay/controls.js";
import { CriticsTable } from "replay/critics.js";
import { readArrays } from "replay/data.js";
import { Facilities } from "replay/facilities.js";
import { FleetPanel } from "replay/fleet.js";
import { Ground } from "replay/ground.js";
import { Gantt } from "replay/gantt.js";
import { Heat } from "replay/heat.js";
import { helpDialog, listenToKeys } from "replay/keys.js";
import { legend } from "replay/legend.js";
import { Lidar } from "replay/lidar.js";
import { Paths } from "replay/paths.js";
import { People } from "replay/people.js";
import { playback } from "replay/playback.js";
import { listenToPointers } from "replay/pointer.js";
import { RobotMaps } from "replay/robot_maps.js";
import { Robots } from "replay/robots.js";
import { Run, STATES } from "replay/run.js";
import { Shown } from "replay/shown.js";
import { fitCanvas, isNarrow } from "replay/surface.js";
import { TaskPanel } from "replay/task_panel.js";
import { applyTheme, readTheme } from "replay/theme.js";
import { Timeline } from "replay/timeline.js";
import { Trajectories } from "replay/trajectories.js";
import { View } from "replay/view.js";

const get = (id) => document.getElementById(id);
const PANEL_MS = 100; // between updates of the panel while playing
const CLOSE = 70; // pixels per metre at least when a robot is followed

const data = JSON.parse(get("run").textContent);
const run = new Run(data, await readArrays("motion"));
const clock = new Clock(run.begin, run.end);
const shown = new Shown(run, { scans: Boolean(data.scans), trajectories: Boolean(data.trajectories), maps: Boolean(data.maps) });
const view = new View(boundsOf(run));
const [ground, paths, robots] = [new Ground(run), new Paths(run), new Robots(run)];
const facilities = new Facilities(run);
const people = new People(run);
const heat = new Heat(run, view.bounds);
const lidar = new Lidar(run, data.scans);
const maps = new RobotMaps(run, data.maps);
const trajectories = new Trajectories(run, data.trajectories);
const timeline = new Timeline(run, get("track"));
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
applyTheme(shown.dark);
let theme = readTheme(STATES);
const colours = () => coloursOf(run, theme, shown);
let stale = { ground: true, actors: true, panel: true };
let [lastFrame, lastPanel] = [0, 0];

fillHeader(run);
fillFigures(run);
fillAbout(run, data);
layerControls(shown);
const refreshLevels = levelControls(run, shown);
const drawLegend = legend(run);
const fleet = new FleetPanel(run, shown, colours);
const critics = new CriticsTable(run, trajectories);
const events = new EventPanel(run, ([time, , robot]) => {
  clock.seek(time);
  if (robot >= 0) shown.select(robot);
});
const tasks = new TaskPanel(run, (robot) => shown.select(robot));
const gantt = new Gantt(run, { seek: (time) => clock.seek(time), choose: (robot) => shown.select(robot) });
get("tab-tasks").hidden = !run.tasks;
const openTab = tabs(() => (stale.panel = true));
const help = helpDialog();

function retheme() {
  applyTheme(shown.dark);
  theme = readTheme(STATES);
  timeline.prepare(theme);
  gantt.stale = true;
  drawLegend(theme);
  stale = { ground: true, actors: true, panel: true };
}

function resize() {
  const [stage, levels, above] = [get("stage"), get("levels"), get("layers").offsetHeight + 14];
  const wide = !isNarrow();
  view.inset = {
    left: 0,
    right: wide && levels.offsetWidth ? levels.offsetWidth + 20 : 0,
    top: above + (wide ? 0 : levels.offsetHeight),
    bottom: get("zoom").offsetHeight + 14,
  };
  levels.style.top = `${above + 6}px`;
  levels.classList.toggle("row", !wide);
  view.resize(stage.clientWidth, stage.clientHeight);
  retheme();
}

function moveView(change) {
  change();
  stale.ground = stale.actors = true;
}

function draw() {
  run.seek(clock.now);
  follow();
  const painted = colours();
  if (stale.ground) {
    ground.draw(fitCanvas(get("ground")), view, theme, shown);
    if (shown.layers.heat) heat.draw(fitCanvas(get("ground")), view, theme, shown);
  }
  const context = fitCanvas(get("actors"));
  context.clearRect(0, 0, view.width, view.height);
  if (shown.layers.map) maps.draw(context, view, theme, shown);
  facilities.draw(context, view, theme, shown);
  paths.draw(context, view, shown, painted);
  if (shown.layers.lidar) lidar.draw(context, view, shown, painted);
  if (shown.layers.waits) run.why.draw(context, view, theme, shown);
  people.draw(context, view, theme, shown);
  if (shown.layers.trajectories) trajectories.draw(context, view, theme, shown);
  robots.draw(context, view, theme, shown, painted, calm.matches || !clock.playing);
  if (run.tasks && shown.layers.tasks) run.tasks.draw(context, view, theme, shown);
  timeline.draw(theme);
  gantt.draw(theme, shown.selected);
  get("now").textContent = clockText(run.now);
  stale.ground = stale.actors = false;
}

function follow() {
  if (!shown.follow || shown.selected < 0) return;
  const level = run.value("level", shown.selected, shown.level);
  if (level !== shown.level) shown.set({ level });
  view.centre(run.pose.x[shown.selected], run.pose.y[shown.selected]);
  stale.ground = true;
}

function refreshPanel() {
  fleet.refresh();
  critics.refresh(shown.selected, shown.layers.trajectories);
  events.list.refresh();
  tasks.refresh(theme);
  refreshLevels();
  get("scrub").value = run.now;
  get("scrub").setAttribute("aria-valuetext", `${clockText(run.now)} of ${clockText(run.end)}`);
  stale.panel = false;
}

function frame(now) {
  clock.advance(Math.min((now - lastFrame) / 1000, 0.25));
  lastFrame = now;
  if (stale.actors || stale.ground) draw();
  if (stale.panel && (!clock.playing || now - lastPanel >= PANEL_MS)) {
    lastPanel = now;
    refreshPanel();
  }
  requestAnimationFrame(frame);
}

clock.addEventListener("change", () => {
  stale.actors = stale.panel = true;
});

let before = -1;
shown.addEventListener("change", () => {
  stale = { ground: true, actors: true, panel: true };
  gantt.show(shown.layers.gantt);
  get("heat-note").hidden = !shown.layers.heat;
  if (shown.layers.heat) get("heat-note").textContent = heat.text;
  if (shown.selected !== before && shown.selected >= 0) {
    if (shown.follow) view.zoom(Math.max(CLOSE / view.scale, 1));
    openTab("tab-robots");
    requestAnimationFrame(() => {
      fleet.reveal(shown.selected);
      gantt.reveal(shown.selected);
    });
  }
  before = shown.selected;
  if (shown.layers.map) maps.read().then(() => (stale.actors = true));
  if (shown.layers.lidar) lidar.read().then(() => (stale.actors = true));
  if (shown.layers.trajectories && shown.selected >= 0) trajectories.read().then(() => (stale.actors = stale.panel = true));
});
const step = playback(run, clock);

function nextEvent(forward) {
  const found = events.next(clock.now, forward);
  if (found) clock.seek(found[0]);
}

function nextRobot(by) {
  if (run.count) shown.select((Math.max(shown.selected, by > 0 ? -1 : 0) + by + run.count) % run.count);
}

function swapTheme() {
  shown.set({ dark: !shown.dark });
  retheme();
}

const fit = () => {
  shown.set({ follow: false });
  moveView(() => view.fit());
};
const zoom = (factor, ...at) => moveView(() => view.zoom(factor, ...at));
const pan = (dx, dy) => {
  if (shown.follow) shown.set({ follow: false });
  moveView(() => view.pan(dx, dy));
};

get("zoom-in").addEventListener("click", () => zoom(1.5));
get("zoom-out").addEventListener("click", () => zoom(1 / 1.5));
get("fit").addEventListener("click", fit);
get("theme").addEventListener("click", swapTheme);
get("help").addEventListener("click", () => help.showModal());

listenToPointers(get("actors"), {
  pan,
  zoom: (factor, px, py) => (shown.follow ? zoom(factor) : zoom(factor, px, py)),
  press: (px, py) => {
    const robot = robots.at(px, py, view);
    shown.select(robot === shown.selected ? -1 : robot);
  },
  hover: (px, py) => {
    const robot = px < 0 ? -1 : robots.at(px, py, view, 3);
    get("actors").style.cursor = robot >= 0 ? "pointer" : "";
    tip(robot >= 0 ? `${run.names[robot]}: ${run.doing(robot)}` : "", px, py);
  },
});

get("timeline").addEventListener("pointermove", ({ offsetX }) => {
  const near = events.items.filter(([time]) => Math.abs(timeline.x(time) - offsetX) < 4).slice(0, 8);
  get("timeline").title = near.map((event) => eventText(run, event)).join("\n") || clockText(timeline.time(offsetX));
});

function tip(text, px, py) {
  const box = get("tooltip");
  box.hidden = !text;
  box.textContent = text;
  box.style.transform = `translate(${px + 14}px, ${py + 10}px)`;
}

listenToKeys({
  " ": () => clock.toggle(),
  ArrowLeft: () => step(-1),
  ArrowRight: () => step(1),
  PageUp: () => clock.seek(clock.now - 10),
  PageDown: () => clock.seek(clock.now + 10),
  Home: () => clock.seek(run.begin),
  End: () => clock.seek(run.end),
  "[": () => clock.shift(-1),
  "]": () => clock.shift(1),
  ",": () => nextEvent(false),
  ".": () => nextEvent(true),
  "/": () => {
    openTab("tab-robots");
    get("search").focus();
  },
  j: () => nextRobot(1),
  k: () => nextRobot(-1),
  "+": () => zoom(1.5),
  "=": () => zoom(1.5),
  "-": () => zoom(1 / 1.5),
  f: fit,
  t: swapTheme,
  c: () => shown.set({ colour: shown.colour === "robot" ? "state" : "robot" }),
  "?": () => help.showModal(),
  "shift ArrowLeft": () => pan(60, 0),
  "shift ArrowRight": () => pan(-60, 0),
  "shift ArrowUp": () => pan(0, 60),
  "shift ArrowDown": () => pan(0, -60),
  escape: (target) => (target === get("search") ? target.blur() : shown.select(-1)),
  ...Object.fromEntries(shown.offered.map(({ key, letter }) => [letter, () => shown.setLayer(key)])),
});

window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", ({ matches }) => {
  shown.set({ dark: matches });
  retheme();
});
new ResizeObserver(resize).observe(get("stage"));
get("gantt").addEventListener("scroll", () => (stale.actors = true));
resize();
requestAnimationFrame(frame);

/** For the console and for tests. */
window.replay = { run, clock, shown, view, robots, lidar, maps, trajectories, facilities, heat, gantt, tasks };
document.body.classList.add("ready");
