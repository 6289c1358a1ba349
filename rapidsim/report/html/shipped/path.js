// The path in space: seen from far away, so that equal lengths look equal everywhere.

// Both pictures are turned together; each has its own scale and place.
const look = { turn: -0.9, lift: 0.45, bySpeed: false };
const farEye = { scale: 1, x: 0, y: 0, whole: true };
const nearEye = { scale: 1, x: 0, y: 0, whole: false };

function tcpAt(robot, i) {
  return [robot.tcp[0][i], robot.tcp[1][i], robot.tcp[2][i]];
}

function armAt(robot, t) {
  if (robot.arm) return [...linkFrames(robot, jointsAt(robot, t), t).map(frame => frame.place), tcpAt(robot, placeOf(robot.t, t))];
  const k = Math.min(Math.round(t / (robot.poses.step || 1)), robot.pose[0].length - 1);
  const points = [];
  for (let p = 0; p < robot.poses.points; p++)
    points.push([robot.pose[3 * p][k], robot.pose[3 * p + 1][k], robot.pose[3 * p + 2][k]]);
  return points;
}

// Points that a picture must hold: arm, base and path, or the work alone.
function scene(eye) {
  const points = eye.whole ? objectCorners() : [];
  for (const robot of robots) {
    for (const failed of robot.failed) points.push(failed.end, failed.at);
    const work = robot.targets.filter(target => target[4]).map(target => target.slice(1, 4));
    if (!eye.whole && work.length > 1) { points.push(...work); continue; }
    const step = Math.max(1, Math.floor(robot.t.length / 600));
    for (let i = 0; i < robot.t.length; i += step)
      if (eye.whole || robot.kind[i] > 1) points.push(tcpAt(robot, i));
    if (eye.whole || !points.length)
      for (let t = 0; t <= run.end; t += Math.max(run.end / 20, 1e-3)) points.push(...armAt(robot, t), ...cornersAt(robot, t));
  }
  return points;
}

// Bring all into the picture, whatever direction it is seen from.
function fit(eye, canvas) {
  const points = scene(eye).map(point => seen({ scale: 1, x: 0, y: 0 }, point, 0, 0));
  const span = values => [Math.min(...values), Math.max(...values)];
  const [left, right] = span(points.map(p => p[0])), [top, bottom] = span(points.map(p => p[1]));
  eye.x = (left + right) / 2;
  eye.y = -(top + bottom) / 2;
  const wide = (canvas.clientWidth - 110) / Math.max(right - left, 10);
  const high = (canvas.clientHeight - 90) / Math.max(bottom - top, 10);
  eye.scale = Math.min(wide, high);
  redraw();
}

function drawSpace(eye, canvas) {
  const { pen, width, height } = prepared(canvas);
  const at = point => seen(eye, point, width, height);
  drawFloor(pen, at);
  for (const robot of robots) {
    // Near the work the arm is in the way: it is a veil there.
    pen.globalAlpha = eye.whole ? 1 : 0.3;
    drawArm(robot, pen, at);
    pen.globalAlpha = 1;
    drawTravelled(robot, pen, at);
    drawFailed(robot, pen, at);
    if (!eye.whole) drawTargets(robot, pen, at);
  }
  drawAxes(pen, height);
}

function drawFloor(pen, at) {
  let reach = 500;
  for (const robot of robots)
    for (const along of [robot.tcp[0], robot.tcp[1]]) for (const x of along) reach = Math.max(reach, Math.abs(x));
  const step = Math.pow(10, Math.floor(Math.log10(reach / 2)));
  const end = Math.ceil(reach / step) * step;
  pen.strokeStyle = colour("rule");
  pen.lineWidth = 1;
  for (let k = -end; k <= end + 1e-9; k += step) {
    strip(pen, [at([k, -end, 0]), at([k, end, 0])]);
    strip(pen, [at([-end, k, 0]), at([end, k, 0])]);
  }
}


function drawTravelled(robot, pen, at) {
  const colours = KINDS.map(colour);
  const shade = i => look.bySpeed
    ? SPEEDS[Math.min(Math.floor((robot.speed[i] / topSpeed) * SPEEDS.length), SPEEDS.length - 1)]
    : colours[robot.kind[i]];
  pen.lineWidth = 2;
  let begin = 0;
  for (let i = 1; i <= robot.t.length; i++) {
    // A jump without speed is a change of tool, not a way.
    const jumped = i < robot.t.length && robot.speed[i] === 0 && robot.speed[i - 1] === 0;
    if (i < robot.t.length && !jumped && shade(i) === shade(begin)) continue;
    pen.strokeStyle = shade(begin);
    pen.beginPath();
    for (let k = begin; k <= Math.min(jumped ? i - 1 : i, robot.t.length - 1); k++) {
      const [x, y] = at(tcpAt(robot, k));
      if (k === begin) pen.moveTo(x, y); else pen.lineTo(x, y);
    }
    pen.stroke();
    begin = i;
  }
}

function drawTargets(robot, pen, at) {
  const taken = [];
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  for (const [name, ...place] of robot.targets) {
    const [x, y] = at(place.slice(0, 3));
    disc(pen, [x, y], 3, colour("ink"));
    // To the left where there is no room on the right.
    const wide = pen.measureText(name).width + 8;
    const left = x + 8 + wide > pen.canvas.clientWidth && x - wide > 0;
    const box = [left ? x - wide - 7 : x + 7, y - 8, wide, 16];
    // A name that would cover another one is left out; it comes when one zooms in.
    if (taken.some(o => box[0] < o[0] + o[2] && o[0] < box[0] + box[2] && box[1] < o[1] + o[3] && o[1] < box[1] + box[3])) continue;
    taken.push(box);
    pen.fillStyle = colour("ink");
    pen.fillText(name, left ? x - wide : x + 8, y);
  }
}

function drawFailed(robot, pen, at) {
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  for (const failed of robot.failed) {
    pen.strokeStyle = colour("error");
    pen.lineWidth = 1.5;
    pen.setLineDash([6, 4]);
    strip(pen, failed.way.map(at));
    pen.setLineDash([]);
    const [x, y] = at(failed.at);
    pen.lineWidth = 3;
    strip(pen, [[x - 6, y - 6], [x + 6, y + 6]]);
    strip(pen, [[x - 6, y + 6], [x + 6, y - 6]]);
    pen.fillStyle = colour("error");
    // To the left where there is no room on the right.
    const left = x > pen.canvas.clientWidth - 110;
    pen.textAlign = left ? "right" : "left";
    pen.fillText(failed.code + " line " + failed.line, x + (left ? -11 : 11), y - 12);
    disc(pen, at(failed.end), 4, colour("error"));
  }
}

// The directions of the base, in the corner.
function drawAxes(pen, height) {
  const unit = { scale: 1, x: 0, y: 0 };
  const names = [["x", [1, 0, 0], "j1"], ["y", [0, 1, 0], "j2"], ["z", [0, 0, 1], "j3"]];
  pen.lineWidth = 2;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (const [name, axis, tint] of names) {
    const [dx, dy] = seen(unit, axis, 0, 0);
    pen.strokeStyle = pen.fillStyle = colour(tint);
    strip(pen, [[44, height - 44], [44 + 28 * dx, height - 44 + 28 * dy]]);
    pen.fillText(name, 44 + 37 * dx, height - 44 + 37 * dy);
  }
}

// What the colours mean, beside the pictures and not in them.
function writeLegend(place) {
  place.replaceChildren();
  place.classList.toggle("ramp", look.bySpeed);
  const add = (tint, words) => {
    const item = document.createElement("span"), swatch = document.createElement("i");
    swatch.style.background = tint;
    item.append(swatch, words);
    place.append(item);
  };
  if (look.bySpeed) {
    place.append("0 ");
    for (const tint of SPEEDS) add(tint, "");
    place.append(" " + topSpeed.toFixed(0) + " mm/s");
    return;
  }
  const used = new Set(robots.flatMap(robot => [...new Set(robot.kind)]));
  KINDS.forEach((kind, k) => { if (used.has(k)) add(colour(kind), KIND_NAMES[kind]); });
}

function strip(pen, points) {
  pen.beginPath();
  points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

function disc(pen, [x, y], radius, fill) {
  pen.fillStyle = fill;
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fill();
}

function turnable(eye, canvas) {
  let held = null;
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    const factor = Math.exp(-0.0015 * event.deltaY);
    const dx = event.offsetX - canvas.clientWidth / 2, dy = canvas.clientHeight / 2 - event.offsetY;
    eye.x += (dx / eye.scale) * (1 - 1 / factor);
    eye.y += (dy / eye.scale) * (1 - 1 / factor);
    eye.scale *= factor;
    redraw();
  }, { passive: false });
  canvas.addEventListener("pointerdown", event => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    if (!held) return;
    const dx = event.clientX - held[0], dy = event.clientY - held[1];
    held = [event.clientX, event.clientY];
    if (event.shiftKey || event.buttons === 2) {
      eye.x -= dx / eye.scale;
      eye.y += dy / eye.scale;
    } else {
      look.turn -= 0.008 * dx;
      look.lift = Math.min(Math.max(look.lift + 0.008 * dy, -Math.PI / 2), Math.PI / 2);
    }
    redraw();
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
}
