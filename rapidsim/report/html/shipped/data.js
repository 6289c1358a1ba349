// The run as numbers: columns come as steps of whole numbers and are added up here.

const run = JSON.parse(document.getElementById("run").textContent);

function column(packed) {
  const values = new Float64Array(packed.steps.length);
  let whole = 0;
  for (let i = 0; i < values.length; i++) {
    whole += packed.steps[i];
    values[i] = whole / packed.scale;
  }
  return values;
}

const robots = run.robots.map(packed => {
  const robot = { ...packed };
  for (const name of ["t", "kind", "speed"]) robot[name] = column(packed[name]);
  for (const name of ["tcp", "joints", "range", "joint_speed", "joint_acceleration"])
    robot[name] = packed[name].map(column);
  if (packed.arm) robot.stands = { ...packed.stands, turn: packed.stands.turn.map(column), place: packed.stands.place.map(column) };
  else robot.pose = packed.poses.places.map(column);
  return robot;
});
const objects = run.objects.map(packed => ({ ...packed, turn: packed.turn.map(column), place: packed.place.map(column) }));
const topSpeed = Math.max(1e-9, ...robots.map(robot => robot.speed.reduce((a, b) => Math.max(a, b), 0)));

const KINDS = run.kinds;
const SPEEDS = run.speeds;
const KIND_NAMES = { joint: "MoveJ", axes: "MoveAbsJ", line: "MoveL", circle: "MoveC", corner: "corner" };

// Colours live in the style sheet, so that they follow light and dark.
function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

function jointColour(k) {
  return "j" + (1 + (k % 8));
}

// What all pictures share: the stretch of time in sight, and the instant that is looked at.
const view = { from: 0, to: Math.max(run.end, 1e-3), now: 0, listeners: [] };

let redrawAsked = false;
function redraw() {
  if (redrawAsked) return;
  redrawAsked = true;
  requestAnimationFrame(() => {
    redrawAsked = false;
    for (const draw of view.listeners) draw();
  });
}

// Last place in an ascending column whose value is not above x; 0 before the first.
function placeOf(values, x) {
  let low = 0, high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= x) low = middle; else high = middle - 1;
  }
  return low;
}

// A canvas of the size it is shown at, in the screen's own pixels.
function prepared(canvas) {
  const scale = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "12px system-ui, sans-serif";
  pen.lineJoin = "round";
  return { pen, width, height };
}

function ticks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  if (!(rough > 0)) return [];
  const power = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) found.push(k * step);
  return found;
}

function number(value, span) {
  const digits = span > 0 ? Math.max(0, Math.min(4, 1 - Math.floor(Math.log10(span)))) : 0;
  const shown = value.toFixed(digits);
  return Number(shown) === 0 ? (0).toFixed(digits) : shown;
}
