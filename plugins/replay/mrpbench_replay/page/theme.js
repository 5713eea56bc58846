// Colours live in the style sheet; canvases read them from there.

const NAMES = [
  "paper", "floor", "lift", "grid", "wall", "obstacle", "door", "lane", "place", "name", "ink", "muted", "rule", "accent", "alarm", "nose", "page", "hover",
];
export const COLOURS = 8;

export function readTheme(states) {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(`--${name}`).trim();
  const theme = Object.fromEntries(NAMES.map((name) => [name, read(name)]));
  theme.robot = Array.from({ length: COLOURS }, (_, index) => read(`robot-${index}`));
  theme.state = states.map((state) => read(`state-${state.replace(" ", "-")}`));
  return theme;
}

export function applyTheme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}
