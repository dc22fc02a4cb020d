// visp-direct: direct methods for vision-based robot control, for ViSP.
// SPDX-License-Identifier: GPL-2.0-or-later
// A 3D view by three.js: arms with their shapes and covers, obstacles, the ground, paths of tools; a slider for time, or for each
// joint when nothing moves. view3d.py describes the scene. Poses are row-major 4 x 4, lengths m, z is up. What is done over time is
// in a list of functions of time, so that a new thing to show adds its own.
"use strict";

function vispMatrix(rows) { return new THREE.Matrix4().set(...rows.flat()); }

function vispNumbers(text, Type) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Type(bytes.buffer);
}

// A geometry for each kind of shape.
const vispGeometries = {
  sphere: (s) => new THREE.SphereBufferGeometry(s.radius, 32, 20),
  box: (s) => new THREE.BoxBufferGeometry(...s.size),
  cylinder: (s) => new THREE.CylinderBufferGeometry(s.radius, s.radius, s.length, 40).rotateX(Math.PI / 2),
  mesh: (s) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(vispNumbers(s.vertices, Float32Array), 3));
    geometry.setIndex(new THREE.BufferAttribute(vispNumbers(s.triangles, Uint32Array), 1));
    geometry.computeVertexNormals();
    return geometry;
  },
};

function vispCapsule(s, material) {
  const group = new THREE.Group(), from = new THREE.Vector3(...s.from), to = new THREE.Vector3(...s.to);
  for (const end of [from, to]) {
    const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(s.radius, 24, 16), material);
    ball.position.copy(end);
    group.add(ball);
  }
  const axis = to.clone().sub(from);
  if (axis.length() > 1e-9) {
    const tube = new THREE.Mesh(new THREE.CylinderBufferGeometry(s.radius, s.radius, axis.length(), 32, 1, true), material);
    tube.position.copy(from).add(to).multiplyScalar(0.5);
    tube.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.normalize());
    group.add(tube);
  }
  return group;
}

function vispPart(s, material) {
  if (s.kind === "capsule") {
    return vispCapsule(s, material);
  }
  const part = new THREE.Mesh(vispGeometries[s.kind](s), material);
  if (s.pose) {
    part.applyMatrix(vispMatrix(s.pose));
  }
  return part;
}

// Frames of the base and of the links, and the place of the tool, at given joints.
function vispKinematics(arm, base) {
  const start = base ? vispMatrix(base) : new THREE.Matrix4();
  const chain = arm.chain.map((part) => ({...part, step: vispMatrix(part.step), after: vispMatrix(part.after)}));
  const tool = vispMatrix(arm.tool);
  const frames = (q) => { // of the base and of the links
    const list = [start], moving = start.clone();
    chain.forEach((part) => {
      const value = part.ratio * q[part.joint] + part.offset;
      moving.multiply(part.step).multiply(part.prismatic ? new THREE.Matrix4().makeTranslation(0, 0, value)
                                                         : new THREE.Matrix4().makeRotationZ(value));
      list.push(moving.clone().multiply(part.after));
    });
    return list;
  };
  const toolAt = (q) => new THREE.Vector3().setFromMatrixPosition(frames(q)[arm.tool_link].multiply(tool));
  return {frames, toolAt};
}

// An arm: groups of its links, which place() moves by the kinematics of its joints.
function vispArm(arm, colour, base) {
  const root = new THREE.Group(), covers = [], links = [];
  const palette = ["#d9dee3", "#a9c1d9", "#f2d0a4", "#b7d3b0"];
  arm.links.forEach((link, i) => {
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    const solid = new THREE.MeshStandardMaterial({color: colour || palette[i % palette.length], roughness: 0.7, flatShading: true, side: THREE.DoubleSide});
    const cover = new THREE.MeshStandardMaterial({color: !link.shapes.length && colour || "#6f9bc8", roughness: 0.9, transparent: link.shapes.length > 0, opacity: 0.35,
                                                  depthWrite: !link.shapes.length});
    link.shapes.forEach((s) => group.add(vispPart(s, solid)));
    link.capsules.forEach((s) => {
      const part = vispPart(s, cover);
      part.visible = !link.shapes.length;
      if (link.shapes.length) {
        covers.push(part);
      }
      group.add(part);
    });
    links.push(group);
    root.add(group);
  });
  const {frames, toolAt} = vispKinematics(arm, base);
  const place = (q) => frames(q).forEach((frame, i) => links[i].matrix.copy(frame));
  place(arm.home);
  return {root, covers, place, toolAt};
}

function vispLabel(text, child) {
  const label = document.createElement("label");
  label.append(child, " " + text);
  return label;
}

function vispInput(type, properties) { return Object.assign(document.createElement("input"), {type, ...properties}); }

// From a centre to where all boxes are seen, in a direction. slope: half the height of the picture over its distance.
function vispDistant(centre, direction, boxes, slope) {
  const back = direction.clone().normalize(), right = new THREE.Vector3(0, 0, 1).cross(back).normalize(), up = back.clone().cross(right);
  let distance = 0.3;
  boxes.forEach(({min, max}) => [min.x, max.x].forEach((x) => [min.y, max.y].forEach((y) => [min.z, max.z].forEach((z) => {
    const corner = new THREE.Vector3(x, y, z).sub(centre);
    distance = Math.max(distance, corner.dot(back) + 1.1 * Math.max(Math.abs(corner.dot(up)) / slope, Math.abs(corner.dot(right)) / (1.38 * slope)));
  }))));
  return back.multiplyScalar(distance);
}

function vispView(figure, given) {
  const scene = {...given, arms: given.arms.map((arm) => vispArms[arm])};
  const canvas = figure.querySelector("canvas"), controls = figure.querySelector(".controls");
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    canvas.replaceWith("This browser shows no 3D: WebGL is missing or switched off.");
    return;
  }
  const world = new THREE.Scene(), camera = new THREE.PerspectiveCamera(40, 1.6, 0.01, 200);
  world.background = new THREE.Color("#f7f9fb");
  world.add(new THREE.HemisphereLight("#ffffff", "#b5c0cb", 1.5));
  const sun = new THREE.DirectionalLight("#ffffff", 0.9);
  sun.position.set(2, -3, 5);
  world.add(sun);

  // The runs that are shown: all of them, or one on each side, which the reader chooses.
  const shown = scene.sides ? scene.sides.map((side) => ({...scene.runs[side.run], base: side.base})) : scene.runs;
  const several = shown.length > 1;
  const content = new THREE.Group();
  const armOf = (run) => vispArm(scene.arms[run.arm], several ? run.colour : null, run.base);
  const arms = scene.runs.length ? shown.map(armOf) : scene.arms.map((arm) => vispArm(arm));
  arms.forEach((arm) => content.add(arm.root));
  const moving = [];  // functions of time
  scene.objects.forEach((object) => {
    const material = new THREE.MeshStandardMaterial({color: object.colour || "#c46a4a", transparent: true, opacity: object.wire ? 0.5 : 0.75,
                                                     roughness: 0.9, side: THREE.DoubleSide, flatShading: object.kind === "mesh",
                                                     wireframe: Boolean(object.wire)});
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    group.add(object.kind === "plate" ? vispPlate(object, () => draw()) : vispPart({...object, pose: null}, material));
    group.userData.seen = true; // by cameras
    group.matrix.copy(vispMatrix(object.pose));
    if (object.track && object.track.pose) {
      moving.push((t) => {
        const [k, s] = between(object.track.t, t);
        group.matrix.copy(vispMatrix(object.track.pose[Math.min(object.track.pose.length - 1, Math.round(k + s))]));
      });
    }
    if (object.track && object.track.p) {
      moving.push((t) => {
        const [k, s] = between(object.track.t, t), from = object.track.p[k], to = object.track.p[Math.min(k + 1, object.track.p.length - 1)];
        group.matrix.setPosition(...from.map((value, i) => value + s * (to[i] - value)));
      });
    }
    if (object.there) { // from, until
      moving.push((t) => { group.visible = t >= object.there[0] && (object.there[1] === null || t < object.there[1]); });
    }
    content.add(group);
  });
  world.add(content);
  const eyes = vispEyes(shown, world, content, between);
  if (eyes) {
    moving.push(eyes.setTime);
    eyes.setTime(0);
  }
  const pathOf = (run, base) => {
    const points = run.q.map(vispKinematics(scene.arms[run.arm], base).toolAt);
    return new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({color: run.colour}));
  };
  const ways = scene.runs.filter((run) => !run.camera);
  (scene.sides || [{}]).forEach((side) => ways.forEach((run) => world.add(pathOf(run, side.base || run.base))));

  // What there is fills the picture, seen from the front, the right and above.
  world.updateMatrixWorld(true);
  const boxes = content.children.map((part) => new THREE.Box3().setFromObject(part)).filter((part) => !part.isEmpty());
  const box = new THREE.Box3().setFromObject(content);
  const centre = box.getCenter(new THREE.Vector3()), size = Math.max(0.2, box.getSize(new THREE.Vector3()).length());
  const grid = new THREE.GridHelper(Math.max(1, Math.ceil(size)) * 2, Math.max(1, Math.ceil(size)) * 20, "#9aa7b4", "#dde3e9");
  grid.rotateX(Math.PI / 2);
  grid.position.z = scene.ground === null ? Math.min(0, box.min.z) : scene.ground;
  world.add(grid);
  world.add(new THREE.AxesHelper(0.12 * size));
  camera.up.set(0, 0, 1);
  camera.position.copy(centre).add(vispDistant(centre, new THREE.Vector3(0.75, -0.95, 0.55), boxes, Math.tan(Math.PI / 9)));
  const orbit = new THREE.OrbitControls(camera, canvas);
  orbit.target.copy(centre);
  orbit.enableKeys = false;
  orbit.update();

  const draw = () => eyes ? eyes.draw(renderer, camera) : renderer.render(world, camera);
  const fit = () => {
    const width = figure.clientWidth, height = Math.round(Math.min(560, Math.max(260, 0.62 * width)));
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    renderer.setSize(width, height, false);
    canvas.style.height = height + "px";
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  };
  orbit.addEventListener("change", draw);
  window.addEventListener("resize", fit);

  const setCovers = (shown) => {
    arms.forEach((arm) => arm.covers.forEach((cover) => { cover.visible = shown; }));
    draw();
  };
  const setJoints = (i, q) => {
    arms[i].place(q);
    draw();
  };
  function between(times, t) { // index and fraction
    let k = 0;
    while (k < times.length - 2 && times[k + 1] < t) {
      ++k;
    }
    const span = times.length > 1 ? times[k + 1] - times[k] : 0;
    return [k, span > 0 ? Math.min(1, Math.max(0, (t - times[k]) / span)) : 0];
  }
  const setTime = (t) => {
    shown.forEach((run, i) => {
      const [k, s] = between(run.t, t), next = run.q[Math.min(k + 1, run.q.length - 1)];
      arms[i].place(run.q[k].map((value, j) => value + s * (next[j] - value)));
    });
    moving.forEach((move) => move(t));
    draw();
  };
  const tick = vispInput("checkbox", {});
  if (arms.some((arm) => arm.covers.length)) {
    tick.addEventListener("change", () => setCovers(tick.checked));
    controls.append(vispLabel("covers of the collision check", tick));
  }
  const show = (i, run) => { // on a side
    shown[i] = {...scene.runs[run], base: shown[i].base};
    content.remove(arms[i].root);
    arms[i] = armOf(shown[i]);
    content.add(arms[i].root);
    setCovers(tick.checked);
  };
  if (scene.pictures) {
    moving.push(vispPictures(figure, scene.pictures, between));
  }
  if (scene.runs.length && Math.max(...scene.runs.map((run) => run.t[run.t.length - 1])) > 0) {
    const now = vispTimeControls(controls, scene, shown, setTime);
    if (scene.sides) {
      vispChoices(controls, scene, (i, run) => { show(i, run); now(); });
    }
  } else if (scene.runs.length) {
    setTime(0);
  } else if (scene.arms.length) {
    vispJointControls(controls, scene.arms[0], (q) => setJoints(0, q));
  }
  fit();
  const see = eyes ? (i) => eyes.see(i, scene.objects[i].pose.slice(0, 3).map((row) => row[3])) : () => [];
  figure.vispView = {scene, setTime, setJoints, setCovers, show, see, toolAt: (i, q) => arms[i].toolAt(q).toArray()};
}

// What a camera sees, in a corner of the view. Returns a function of time.
function vispPictures(figure, pictures, between) {
  const image = document.createElement("img");
  image.alt = "what the camera sees";
  image.className = "seen";
  figure.style.position = "relative";
  figure.append(image);
  return (t) => { // the latest
    const [k, s] = between(pictures.t, t);
    image.src = pictures.uri[Math.min(pictures.uri.length - 1, k + Math.floor(s))];
  };
}

// A menu for each side.
function vispChoices(controls, scene, choose) {
  scene.sides.forEach((side, i) => {
    const menu = document.createElement("select");
    menu.setAttribute("aria-label", "run");
    scene.runs.forEach((run, k) => menu.add(new Option(run.name, k, k === side.run, k === side.run)));
    menu.style.borderLeft = "1em solid " + scene.runs[side.run].colour;
    menu.addEventListener("change", () => {
      menu.style.borderLeftColor = scene.runs[Number(menu.value)].colour;
      choose(i, Number(menu.value));
    });
    controls.append(menu);
  });
}

// The last of [[time, text], ...] that has begun.
function vispState(states, t) {
  let text = "";
  states.forEach(([time, now]) => { text = time <= t + 1e-9 ? now : text; });
  return text;
}

// Returns a function that shows the current time again.
function vispTimeControls(controls, scene, shown, setTime) {
  const end = Math.max(...scene.runs.map((run) => run.t[run.t.length - 1]));
  const slider = vispInput("range", {min: 0, max: end, step: end / 1000 || 1, value: 0});
  slider.setAttribute("aria-label", "time");
  const clock = document.createElement("span"), play = document.createElement("button");
  const set = (t) => {
    slider.value = t;
    const states = shown.filter((run) => run.states).map((run) => (shown.length > 1 ? run.name + ": " : "") + vispState(run.states, Number(t)));
    clock.textContent = [Number(t).toFixed(2) + " s", ...states].join(" · ");
    setTime(Number(t));
  };
  let before = null;
  const tick = (now) => {
    if (before === null) {
      return;
    }
    set(Math.min(end, Number(slider.value) + (now - before) / 1000));
    before = now;
    if (Number(slider.value) < end) {
      requestAnimationFrame(tick);
    } else {
      pause();
    }
  };
  const pause = () => { before = null; play.textContent = "Play"; };
  play.textContent = "Play";
  play.addEventListener("click", () => {
    if (before !== null) {
      pause();
      return;
    }
    set(Number(slider.value) >= end ? 0 : slider.value);
    play.textContent = "Pause";
    before = performance.now();
    requestAnimationFrame(tick);
  });
  slider.addEventListener("input", () => { pause(); set(slider.value); });
  controls.append(play, slider, clock);
  if (scene.runs.length > 1 && !scene.sides) {
    scene.runs.forEach((run) => {
      const key = document.createElement("span");
      key.className = "key";
      key.style.background = run.colour;
      controls.append(vispLabel(run.name, key));
    });
  }
  set(0);
  return () => set(slider.value);
}

function vispJointControls(controls, arm, place) {
  const q = [...arm.home], box = document.createElement("div");
  box.className = "joints";
  box.style.flex = "1 1 100%";
  arm.joints.forEach((joint, i) => {
    const range = joint.limits || (joint.type === "prismatic" ? [-1, 1] : [-Math.PI, Math.PI]);
    const slider = vispInput("range", {min: range[0], max: range[1], step: (range[1] - range[0]) / 1000, value: q[i]});
    const label = document.createElement("label"), name = document.createElement("span");
    slider.setAttribute("aria-label", joint.name);
    const tell = () => { name.textContent = joint.name + " " + q[i].toFixed(2); };
    slider.addEventListener("input", () => { q[i] = Number(slider.value); tell(); place(q); });
    tell();
    label.append(name, slider);
    box.append(label);
  });
  controls.append(box);
}
