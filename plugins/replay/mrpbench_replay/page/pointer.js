// Mouse, pen and fingers on the map: drag to pan, wheel or pinch to zoom, press a robot to follow it.

const STILL = 4; // pixels a press may move and still be a press

export function listenToPointers(canvas, { pan, zoom, press, hover }) {
  const down = new Map();
  let moved = 0;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (!down.size) moved = 0;
    down.set(event.pointerId, place(event));
  });

  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = down.get(event.pointerId);
    if (!before) {
      hover(...now);
      return;
    }
    moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (down.size === 2) {
      const other = [...down].find(([id]) => id !== event.pointerId)[1];
      const [gap, gapBefore] = [now, before].map((point) => Math.hypot(point[0] - other[0], point[1] - other[1]));
      pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
      zoom(gap / Math.max(gapBefore, 1), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else if (moved > STILL) pan(now[0] - before[0], now[1] - before[1]);
    down.set(event.pointerId, now);
  });

  const release = (event) => {
    if (down.delete(event.pointerId) && event.type === "pointerup" && moved <= STILL) press(...place(event));
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => hover(-1, -1));

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
      zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0015)), ...place(event));
    },
    { passive: false },
  );
}
