// A canvas as sharp as the screen, measured in CSS pixels.

/** Whether the page has the layout for narrow screens; the style sheet has the same limit. */
export const isNarrow = () => window.matchMedia("(max-width: 760px)").matches;

export function fitCanvas(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth, clientHeight } = canvas;
  const width = Math.max(Math.round(clientWidth * ratio), 1);
  const height = Math.max(Math.round(clientHeight * ratio), 1);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}
