// visp-direct: direct methods for vision-based robot control, for ViSP.
// SPDX-License-Identifier: GPL-2.0-or-later
// Cameras that runs move, in the 3D view: a frustum with the image that the camera sees, the way of the camera, and the image once
// more in a corner. The image is rendered from the objects of the scene; arms, ways and the ground are not in it. camera3d.py
// describes a camera.
"use strict";

// A rectangle in the plane z = depth of a frame with x to the right and y down, turned to its origin.
function vispRectangle(left, right, top, bottom, depth) {
  return new THREE.PlaneBufferGeometry(right - left, bottom - top).rotateX(Math.PI).translate((left + right) / 2, (top + bottom) / 2, depth);
}

// A flat target with its photograph. loaded() is called when that can be shown.
function vispPlate(s, loaded) {
  const material = new THREE.MeshBasicMaterial({color: s.picture ? "#ffffff" : s.colour, side: THREE.DoubleSide});
  if (s.picture) {
    material.map = new THREE.TextureLoader().load(s.picture, loaded);
    material.map.minFilter = THREE.LinearFilter;
  }
  const [width, height] = s.size;
  return new THREE.Mesh(vispRectangle(-width / 2, width / 2, -height / 2, height / 2, 0), material);
}

// A camera on one side of the view.
function vispEye(camera, base) {
  const [left, right, top, bottom] = camera.lens, depth = camera.depth;
  const root = new THREE.Group(), start = base ? vispMatrix(base) : new THREE.Matrix4();
  root.matrixAutoUpdate = false;
  const corners = [[left, top], [right, top], [right, bottom], [left, bottom]].map(([x, y]) => new THREE.Vector3(x * depth, y * depth, depth));
  const ends = corners.flatMap((corner, i) => [new THREE.Vector3(), corner, corner, corners[(i + 1) % 4]]);
  const lines = new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(ends), new THREE.LineBasicMaterial());
  const height = Math.round(512 * (bottom - top) / (right - left)), target = new THREE.WebGLRenderTarget(512, height);
  const picture = new THREE.Mesh(vispRectangle(...camera.lens.map((x) => x * depth), depth),
                                 new THREE.MeshBasicMaterial({map: target.texture, side: THREE.DoubleSide}));
  const goal = new THREE.LineLoop(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: "#00a0ff", depthTest: false, transparent: true}));
  goal.renderOrder = 1;
  goal.frustumCulled = false;
  goal.userData.seen = true;
  root.add(lines, picture); // the goal when there is one: an empty line has no extent
  const way = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
  way.frustumCulled = false;
  const eye = new THREE.Camera(), near = 0.005, flip = new THREE.Matrix4().makeScale(1, -1, -1);
  eye.matrixAutoUpdate = false;
  eye.projectionMatrix.makePerspective(left * near, right * near, -top * near, -bottom * near, near, 100);
  eye.projectionMatrixInverse.getInverse(eye.projectionMatrix);
  const poseAt = (pose) => start.clone().multiply(new THREE.Matrix4().set(...pose, 0, 0, 0, 1));
  const show = (run) => { // another run
    lines.material.color.set(run.colour);
    way.material.color.set(run.colour);
    way.geometry.setFromPoints(run.camera.pose.map((pose) => new THREE.Vector3().setFromMatrixPosition(poseAt(pose))));
  };
  const setTime = (run, t, between) => {
    const [k, s] = between(run.t, t), poses = run.camera.pose;
    root.matrix.copy(poseAt(poses[Math.min(poses.length - 1, k + Math.round(s))]));
    eye.matrix.multiplyMatrices(root.matrix, flip);
    eye.matrixWorldNeedsUpdate = true;
    const begun = run.camera.goals.filter(([from]) => from <= t + 1e-9);
    const points = begun.length ? begun[begun.length - 1][1] : [];
    root.remove(goal);
    if (points.length) {
      goal.geometry.setFromPoints(points.map(([x, y]) => new THREE.Vector3(x * depth, y * depth, depth)));
      root.add(goal);
    }
  };
  return {root, way, goal, eye, target, show, setTime, ratio: (bottom - top) / (right - left)};
}

// Only what eyes see is in layer 0.
function vispLayers(object, seen) {
  seen = seen || Boolean(object.userData.seen);
  if (object.isMesh || object.isLine) {
    object.layers.set(seen ? 0 : 1);
  }
  object.children.forEach((child) => vispLayers(child, seen));
}

// The cameras of the runs that are shown; null without any.
function vispEyes(shown, world, content, between) {
  if (!shown.length || !shown.every((run) => run.camera)) {
    return null;
  }
  const eyes = shown.map((run) => vispEye(run.camera, run.base)), told = [];
  eyes.forEach((one) => { content.add(one.root, one.way); });
  const setTime = (t) => eyes.forEach((one, i) => {
    if (told[i] !== shown[i].name) {
      told[i] = shown[i].name;
      one.show(shown[i]);
    }
    one.setTime(shown[i], t, between);
  });
  const look = (renderer, one) => { // with its own goal only
    const background = world.background;
    eyes.forEach((other) => { other.goal.visible = other === one; });
    world.background = new THREE.Color("#dfe4ea");
    renderer.render(world, one.eye);
    eyes.forEach((other) => { other.goal.visible = true; });
    world.background = background;
  };
  const draw = (renderer, camera) => {
    vispLayers(world, false);
    camera.layers.enable(1);
    eyes.forEach((one) => {
      renderer.setRenderTarget(one.target);
      look(renderer, one);
    });
    renderer.setRenderTarget(null);
    const size = renderer.getSize(new THREE.Vector2()), width = Math.min(240, 0.28 * size.x), edge = 3;
    renderer.setViewport(0, 0, size.x, size.y);
    renderer.render(world, camera);
    renderer.setScissorTest(true);
    eyes.forEach((one, i) => {
      const x = i === 0 ? 8 : size.x - width - 8, height = width * one.ratio;
      renderer.setScissor(x - edge, 8 - edge, width + 2 * edge, height + 2 * edge);
      renderer.setClearColor(shown[i].colour);
      renderer.clear();
      renderer.setScissor(x, 8, width, height);
      renderer.setViewport(x, 8, width, height);
      look(renderer, one);
    });
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, size.x, size.y);
  };
  const see = (i, place) => { // of the drawn time, in shares of the image from its left and upper edge
    const p = new THREE.Vector3(...place).project(eyes[i].eye);
    return [(p.x + 1) / 2, (1 - p.y) / 2];
  };
  return {setTime, draw, see};
}
