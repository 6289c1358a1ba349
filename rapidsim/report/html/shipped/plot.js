// Curves over time. All plots share the stretch of time in sight and its margins.

const LEFT = 52, RIGHT = 12, TOP = 8, BOTTOM = 20;

function timeToX(t, width) {
  return LEFT + ((t - view.from) / (view.to - view.from)) * (width - LEFT - RIGHT);
}

function xToTime(x, width) {
  return view.from + ((x - LEFT) / (width - LEFT - RIGHT)) * (view.to - view.from);
}

// lines: {name, colour, values, times, steps, thin}; limits: horizontal lines.
function addPlot(parent, title, lines, options) {
  const box = document.createElement("div");
  box.className = "plot";
  const name = document.createElement("div");
  name.className = "name";
  name.append(title);
  const values = lines.map(line => {
    const label = document.createElement("label");
    const swatch = document.createElement("i");
    const value = document.createElement("span");
    label.append(swatch, line.name + " ", value);
    label.onclick = () => { line.hidden = !line.hidden; label.classList.toggle("off", line.hidden); redraw(); };
    name.append(label);
    return { swatch, value };
  });
  const canvas = document.createElement("canvas");
  box.append(name, canvas);
  parent.append(box);
  steer(canvas);
  view.listeners.push(() => {
    if (!box.offsetParent) return;
    drawPlot(canvas, lines, options);
    lines.forEach((line, k) => {
      values[k].swatch.style.background = colour(line.colour);
      const place = placeOf(line.times, view.now);
      values[k].value.textContent = line.times.length ? line.values[place].toFixed(options.digits) : "";
    });
  });
  return box;
}

function drawPlot(canvas, lines, options) {
  const { pen, width, height } = prepared(canvas);
  const shown = lines.filter(line => !line.hidden);
  const [low, high] = range(shown, options);
  const y = value => TOP + ((high - value) / (high - low)) * (height - TOP - BOTTOM);
  pen.lineWidth = 1;
  pen.strokeStyle = colour("rule");
  pen.fillStyle = colour("soft");
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const tick of ticks(low, high, (height - TOP - BOTTOM) / 34)) {
    stroke(pen, LEFT, y(tick), width - RIGHT, y(tick));
    pen.fillText(number(tick, high - low), LEFT - 6, y(tick));
  }
  drawTimeAxis(pen, width, TOP, height - BOTTOM);
  pen.save();
  pen.beginPath();
  pen.rect(LEFT, TOP, width - LEFT - RIGHT, height - TOP - BOTTOM);
  pen.clip();
  for (const limit of options.limits || []) {
    pen.strokeStyle = colour("error");
    pen.setLineDash([5, 4]);
    stroke(pen, LEFT, y(limit), width - RIGHT, y(limit));
    pen.setLineDash([]);
  }
  for (const line of shown) drawLine(pen, line, width, y);
  drawNow(pen, width, TOP, height - BOTTOM);
  pen.restore();
}

function drawLine(pen, line, width, y) {
  const first = Math.max(placeOf(line.times, view.from), 0);
  const last = Math.min(placeOf(line.times, view.to) + 1, line.times.length - 1);
  pen.strokeStyle = colour(line.colour);
  pen.lineWidth = line.thin ? 1.2 : 1.6;
  pen.beginPath();
  for (let i = first; i <= last; i++) {
    const x = timeToX(line.times[i], width), v = y(line.values[i]);
    if (i === first) pen.moveTo(x, v);
    else {
      if (line.steps) pen.lineTo(x, y(line.values[i - 1]));
      pen.lineTo(x, v);
    }
  }
  pen.stroke();
}

// The values in sight, with air; always wide enough for what options.hold names.
function range(lines, options) {
  let low = Infinity, high = -Infinity;
  for (const line of lines) {
    const first = placeOf(line.times, view.from), last = placeOf(line.times, view.to);
    for (let i = first; i <= Math.min(last + 1, line.times.length - 1); i++) {
      if (line.capped && line.values[i] > line.capped) continue;
      low = Math.min(low, line.values[i]);
      high = Math.max(high, line.values[i]);
    }
  }
  for (const value of options.hold || []) { low = Math.min(low, value); high = Math.max(high, value); }
  if (!(high > low)) { low = (Number.isFinite(low) ? low : 0) - 1; high = low + 2; }
  const air = 0.06 * (high - low);
  return [options.floor === undefined ? low - air : options.floor, high + air];
}

function drawTimeAxis(pen, width, top, bottom) {
  pen.strokeStyle = colour("rule");
  pen.fillStyle = colour("soft");
  pen.textAlign = "center";
  pen.textBaseline = "top";
  const all = ticks(view.from, view.to, (width - LEFT - RIGHT) / 90);
  all.forEach((tick, k) => {
    const x = timeToX(tick, width);
    stroke(pen, x, top, x, bottom);
    const text = number(tick, view.to - view.from) + (k === all.length - 1 ? " s" : "");
    pen.textAlign = x > width - RIGHT - 24 ? "right" : "center";
    pen.fillText(text, Math.min(x, width - RIGHT), bottom + 5);
  });
}

function drawNow(pen, width, top, bottom) {
  const x = timeToX(view.now, width);
  if (x < LEFT || x > width - RIGHT) return;
  pen.strokeStyle = colour("ink");
  pen.lineWidth = 1;
  stroke(pen, x, top, x, bottom);
}

function stroke(pen, x1, y1, x2, y2) {
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(x2, y2);
  pen.stroke();
}

function zoom(at, factor) {
  const least = Math.min(run.end, 0.02);
  const span = Math.min(Math.max((view.to - view.from) * factor, least), run.end);
  const share = (at - view.from) / (view.to - view.from);
  move(at - share * span, span);
}

function move(from, span) {
  view.from = Math.max(0, Math.min(from, run.end - span));
  view.to = view.from + Math.max(span, 1e-3);
  redraw();
}

// The mouse in whatever has time from left to right.
function steer(canvas) {
  let held = null;
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(xToTime(event.offsetX, canvas.clientWidth), Math.exp(0.0015 * event.deltaY));
  }, { passive: false });
  canvas.addEventListener("pointerdown", event => {
    held = { x: event.offsetX, from: view.from };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    const width = canvas.clientWidth;
    if (held && Math.abs(event.offsetX - held.x) > 3) {
      const span = view.to - view.from;
      move(held.from - ((event.offsetX - held.x) / (width - LEFT - RIGHT)) * span, span);
    } else if (!playing()) {
      view.now = Math.min(Math.max(xToTime(event.offsetX, width), 0), run.end);
      redraw();
    }
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("dblclick", () => move(0, run.end));
}
