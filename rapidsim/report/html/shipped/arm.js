// The arm: its links at any joints, drawn as the bodies they are made of, or as a row of bones.

// Joints [deg, mm where one slides] of the robot under somebody's hand, instead of those of the run.
const hand = { robot: null, joints: [] };

function jointsAt(robot, t) {
  if (hand.robot === robot) return hand.joints;
  const i = placeOf(robot.t, t);
  return robot.joints.map(column => column[i]);
}

// Base, links and flange as the page shows them.
function linkFrames(robot, joints, t) {
  const k = Math.min(Math.round(t / (robot.stands.step || 1)), robot.stands.place[0].length - 1);
  const base = { turn: robot.stands.turn.map(column => column[k]), place: robot.stands.place.map(column => column[k]) };
  return framesOf(base, robot.arm.links, joints);
}

// The tool in the flange, as it is at an instant of the run.
function toolAt(robot, t) {
  const i = placeOf(robot.t, t);
  const flange = linkFrames(robot, robot.joints.map(column => column[i]), t).at(-1);
  const [x, y, z] = tcpAt(robot, i).map((value, k) => value - flange.place[k]);
  const [a, b, c, d, e, f, g, h, l] = flange.turn;
  return turned([a, d, g, b, e, h, c, f, l], [x, y, z]);
}

// A corner of each body: what a picture must have room for.
function cornersAt(robot, t) {
  if (!robot.arm || !robot.arm.bodies.length) return [];
  const frames = linkFrames(robot, jointsAt(robot, t), t);
  return robot.arm.bodies.map(({ link, corners }) => moved(frames[link], corners.slice(0, 3)));
}

function drawArm(robot, pen, at) {
  // All that stands in the cell is drawn with the first arm, what is far off first.
  const outlines = robot === robots[0] ? objectOutlines(at) : [];
  if (!robot.arm) { drawOutlines(pen, outlines); drawBones(pen, armAt(robot, view.now).map(at)); return; }
  const frames = linkFrames(robot, jointsAt(robot, view.now), view.now);
  const tcp = moved(frames.at(-1), toolAt(robot, view.now));
  outlines.push(...robot.arm.bodies.map(({ link, corners, colour }) => outlineOf(frames[link], corners, colour, at)));
  drawOutlines(pen, outlines);
  if (robot.arm.bodies.length) drawTool(pen, at(frames.at(-1).place), at(tcp));
  else drawBones(pen, [...frames.map(frame => frame.place), tcp].map(at));
}

// Where an object of the cell stands, or is carried, at an instant.
function objectFrame({ turn, place }, t) {
  const k = Math.min(Math.round(t / (run.pose_step || 1)), place[0].length - 1);
  return { turn: turn.map(column => column[k]), place: place.map(column => column[k]) };
}

function objectOutlines(at) {
  return objects.flatMap(object => {
    if (object.exists && !(object.exists[0] <= view.now && view.now < object.exists[1])) return [];
    const frame = objectFrame(object, view.now);
    // What is large lies under other things more often than over them: its farthest corner counts.
    return object.parts.map(corners => outlineOf(frame, corners, object.colour, at, depths => Math.min(...depths)));
  });
}

function objectCorners() {
  return objects.flatMap(object => object.parts.map(corners => moved(objectFrame(object, 0), corners.slice(0, 3))));
}

// An arm without shapes: bones that grow thinner, with a knob at each joint.
function drawBones(pen, points) {
  const bones = points.slice(0, -1).filter((point, k, all) => !k || Math.hypot(point[0] - all[k - 1][0], point[1] - all[k - 1][1]) > 1);
  pen.lineCap = "round";
  for (const [tint, more] of [["arm-edge", 3], ["arm", 0]]) {
    pen.strokeStyle = colour(tint);
    for (let k = 1; k < bones.length; k++) {
      pen.lineWidth = Math.max(5, 15 - 2 * k) + more;
      strip(pen, [bones[k - 1], bones[k]]);
    }
  }
  pen.lineCap = "butt";
  bones.forEach((bone, k) => { disc(pen, bone, Math.max(3, 6 - k), colour("panel")); });
  drawTool(pen, points.at(-2), points.at(-1));
}

function drawTool(pen, flange, tcp) {
  pen.strokeStyle = colour("soft");
  pen.lineWidth = 3;
  pen.lineCap = "round";
  strip(pen, [flange, tcp]);
  pen.lineCap = "butt";
  disc(pen, tcp, 4.5, colour("ink"));
}

// A slider for each joint; what they show is the run again as soon as it is played.
function handTools(place, robot) {
  const rows = robot.arm.limits.map(([low, high], j) => {
    const row = document.createElement("label"), slider = document.createElement("input"), value = document.createElement("output");
    Object.assign(slider, { type: "range", min: low, max: high, step: 0.1 });
    slider.addEventListener("input", () => {
      if (hand.robot !== robot) Object.assign(hand, { robot, joints: rows.map(one => Number(one.slider.value)) });
      hand.joints[j] = Number(slider.value);
      redraw();
    });
    row.append("J" + (j + 1), slider, value);
    place.append(row);
    return { slider, value };
  });
  const where = document.createElement("p");
  where.className = "aside";
  place.append(where);
  button(place, "back to the run", release);
  view.listeners.push(() => {
    const joints = jointsAt(robot, view.now);
    rows.forEach(({ slider, value }, j) => { slider.value = joints[j]; value.textContent = joints[j].toFixed(1) + robot.arm.units[j]; });
    const tcp = moved(linkFrames(robot, joints, view.now).at(-1), toolAt(robot, view.now));
    where.textContent = "TCP at " + tcp.map(x => x.toFixed(1)).join(", ") + " mm" + (hand.robot === robot ? ", by hand" : "");
  });
}

function release() {
  hand.robot = null;
  redraw();
}
