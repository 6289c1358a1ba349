// Puts the page together: contents, buttons, plots; plays the run.

const spaces = [[farEye, document.getElementById("cell")], [nearEye, document.getElementById("path")]];
const lanes = document.getElementById("lanes");

function button(parent, name, press) {
  const one = document.createElement("button");
  one.textContent = name;
  one.onclick = () => press(one);
  parent.append(one);
  return one;
}

function gap(parent) {
  const space = document.createElement("span");
  space.className = "gap";
  parent.append(space);
}

// Contents.
for (const part of document.querySelectorAll("main section")) {
  const link = document.createElement("a");
  link.href = "#" + part.id;
  link.textContent = part.querySelector("h2").firstChild.textContent;
  document.getElementById("contents").append(link);
}

// Light or dark, as the system has it until somebody presses.
const dark = window.matchMedia("(prefers-color-scheme: dark)");
function paint(isDark) {
  document.documentElement.classList.toggle("dark", isDark);
  redraw();
}
dark.addEventListener("change", () => paint(dark.matches));
document.getElementById("theme").onclick = () => paint(!document.documentElement.classList.contains("dark"));

// Playing.
let started = null;
function playing() {
  return started !== null;
}
function play() {
  if (started === null) return;
  view.now = (performance.now() - started) / 1000;
  if (view.now >= run.end) { view.now = run.end; stop(); }
  if (view.now > view.to || view.now < view.from) move(view.now, view.to - view.from);
  redraw();
  requestAnimationFrame(play);
}
function stop() {
  started = null;
  playButton.textContent = "▶ play";
}

const timeTools = document.getElementById("time-tools");
const playButton = button(timeTools, "▶ play", () => {
  if (playing()) { stop(); return; }
  if (view.now >= run.end) view.now = 0;
  release();
  started = performance.now() - 1000 * view.now;
  playButton.textContent = "❚❚ pause";
  play();
});
button(timeTools, "whole run", () => move(0, run.end));
const readout = document.createElement("span");
readout.className = "readout";
timeTools.append(readout);
gap(timeTools);

// Plots, a set for each robot.
const plots = document.getElementById("plots");
const SHARE = { digits: 1, limits: [-100, 100], hold: [-100, 100] };
const CURVES = {
  angle: ["Joint angles [deg]", "joints", { digits: 2 }],
  range: ["Joint angles [% of range]", "range", SHARE],
  speed: ["Joint speeds [% of limit]", "joint_speed", SHARE],
  acceleration: ["Joint accelerations [% of limit]", "joint_acceleration", SHARE],
};
const shown = { angle: true, range: false, speed: true, acceleration: false };
let chosen = robots[0];

function programmedSpeed(robot) {
  const line = { name: "programmed", colour: "programmed", times: [], values: [], steps: true, thin: true };
  const add = (time, value) => { line.times.push(time); line.values.push(value); };
  let moved = 0;
  for (const [start, end, , , speed] of robot.moves) {
    if (start > moved + 1e-4) add(moved, 0);
    add(start, speed);
    moved = end;
  }
  add(moved, 0);
  add(run.end, 0);
  // What is programmed far beyond what is reached is left to run out of the picture.
  line.capped = 2 * topSpeed;
  return line;
}

const sets = robots.map(robot => {
  const set = document.createElement("div");
  plots.append(set);
  const speed = { name: "TCP", colour: "tcp", times: robot.t, values: robot.speed };
  addPlot(set, "TCP speed [mm/s]", [programmedSpeed(robot), speed], { digits: 1, floor: 0, hold: [1] });
  const boxes = {};
  for (const [name, [title, column, options]] of Object.entries(CURVES)) {
    const lines = robot[column].map((values, k) => ({ name: "J" + (k + 1), colour: jointColour(k), times: robot.t, values }));
    boxes[name] = addPlot(set, title.replace("[deg]", "[" + robot.units + "]"), lines, options);
  }
  return { robot, set, boxes };
});

function showPlots() {
  for (const { robot, set, boxes } of sets) {
    set.style.display = robot === chosen ? "" : "none";
    for (const [name, box] of Object.entries(boxes)) box.style.display = shown[name] ? "" : "none";
  }
  redraw();
}

if (robots.length > 1)
  for (const robot of robots) {
    const one = button(timeTools, robot.task, () => {
      chosen = robot;
      for (const other of timeTools.querySelectorAll(".robot")) other.classList.toggle("on", other === one);
      showPlots();
    });
    one.classList.add("robot");
    one.classList.toggle("on", robot === chosen);
  }
for (const name of Object.keys(CURVES)) {
  const toggle = button(timeTools, "joint " + name, () => {
    shown[name] = !shown[name];
    toggle.classList.toggle("on", shown[name]);
    showPlots();
  });
  toggle.classList.toggle("on", shown[name]);
}
showPlots();
steer(lanes);

// Joints under the reader's hand, of the robot that is chosen.
for (const robot of robots) {
  if (!robot.arm) continue;
  const own = document.createElement("div");
  own.className = "hand";
  document.getElementById("hand").append(own);
  handTools(own, robot);
  view.listeners.push(() => { own.style.display = robot === chosen ? "" : "none"; });
}
view.listeners.push(() => { document.getElementById("hand").style.display = chosen.arm ? "" : "none"; });

// Path.
const pathTools = document.getElementById("path-tools");
const views = { "from the side": [-0.9, 0.45], "above": [-Math.PI / 2, Math.PI / 2], "front": [0, 0], "left": [-Math.PI / 2, 0] };
for (const [name, [turn, lift]] of Object.entries(views))
  button(pathTools, name, () => { Object.assign(look, { turn, lift }); fitAll(); });
gap(pathTools);
button(pathTools, "coloured by speed", one => {
  look.bySpeed = !look.bySpeed;
  one.classList.toggle("on", look.bySpeed);
  redraw();
});
const legend = document.createElement("span");
legend.className = "legend";
pathTools.append(legend);
view.listeners.push(() => writeLegend(legend));
function fitAll() {
  for (const [eye, canvas] of spaces) fit(eye, canvas);
}
for (const [eye, canvas] of spaces) {
  turnable(eye, canvas);
  view.listeners.push(() => drawSpace(eye, canvas));
}

view.listeners.push(() => drawLanes(lanes), () => {
  const move = chosen.moves.find(([start, end]) => start <= view.now && view.now < end);
  const what = move ? move[3] + ", line " + move[5] : "at rest";
  readout.textContent = view.now.toFixed(3) + " s   " + (chosen.moves.length ? what : "");
});
const remarks = [];
if (run.step_ms > 12) remarks.push("shown every " + run.step_ms + " ms");
for (const robot of robots)
  if (robot.move_count > robot.moves.length) remarks.push(robot.move_count + " moves: too many for a lane of their own");
document.getElementById("frame").textContent = run.frame;
document.getElementById("sampling").textContent = remarks.join("; ");
window.addEventListener("resize", fitAll);
paint(dark.matches);
fitAll();
// At once, and not with the next frame: a page that is printed or photographed may have none.
for (const draw of view.listeners) draw();
