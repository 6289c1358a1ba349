// The moves and the signals as lanes over time.

const LANE = 22, LANE_GAP = 16;

function drawLanes(canvas) {
  const moving = robots.filter(robot => robot.moves.length);
  const lanes = run.signals.length + moving.length;
  canvas.style.height = lanes * (LANE + LANE_GAP) + BOTTOM + "px";
  const { pen, width, height } = prepared(canvas);
  let top = 0;
  for (const robot of moving) {
    drawName(pen, robots.length > 1 ? robot.task + " moves" : "moves", top);
    for (const [start, end, kind, name] of robot.moves)
      drawState(pen, width, top + LANE_GAP, start, end, colour(kind), name, "panel");
    top += LANE + LANE_GAP;
  }
  for (const signal of run.signals) {
    drawName(pen, signal.name, top);
    const binary = signal.changes.every(([, value]) => value === 0 || value === 1);
    signal.changes.forEach(([start, value], k) => {
      const end = k + 1 < signal.changes.length ? signal.changes[k + 1][0] : run.end;
      const fill = binary ? colour(value ? "good" : "rule") : colour("note");
      const ink = binary && !value ? "soft" : "panel";
      drawState(pen, width, top + LANE_GAP, start, end, fill, String(value), ink);
    });
    top += LANE + LANE_GAP;
  }
  drawTimeAxis(pen, width, height - BOTTOM - 4, height - BOTTOM);
  drawNow(pen, width, 0, height - BOTTOM);
}

function drawName(pen, name, top) {
  pen.fillStyle = colour("soft");
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillText(name, LEFT, top + LANE_GAP / 2);
}

function drawState(pen, width, top, start, end, fill, name, ink) {
  if (end < view.from || start > view.to) return;
  const left = Math.max(timeToX(start, width), LEFT), right = Math.min(timeToX(end, width), width - RIGHT);
  pen.fillStyle = fill;
  pen.fillRect(left, top, Math.max(right - left - 1, 0.5), LANE);
  if (right - left < 26) return;
  pen.save();
  pen.beginPath();
  pen.rect(left, top, right - left - 4, LANE);
  pen.clip();
  pen.fillStyle = colour(ink);
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillText(name, left + 6, top + LANE / 2 + 1);
  pen.restore();
}
