// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
//
// The sheet, the box around it and the marks of a place as a scene of three.js. Knows nothing of keys and tables.
"use strict";

const MedialVoxelScene = (() => {
  const VERTEX = `
    attribute float thickness;
    attribute float isKnown;
    attribute float importance;
    attribute vec3 wallColor;
    attribute float isChosen;
    uniform float pointSize;
    varying vec3 ofWall;
    varying float chosen;
    varying float weight;
    varying float wall;
    varying float known;
    varying float light;
    varying float depth;
    varying float facing;
    varying vec3 place;
    void main() {
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      vec3 across = normalMatrix * normal;
      float lit = dot(across, across) > 0.0 ? abs(dot(normalize(across), normalize(vec3(0.35, 0.45, 1.0)))) : 0.8;
      light = 0.42 + 0.6 * lit;
      facing = dot(across, across) > 0.0 ? abs(dot(normalize(across), normalize(seen.xyz))) : 1.0;
      wall = thickness;
      known = isKnown;
      weight = importance;
      ofWall = wallColor;
      chosen = isChosen;
      depth = -seen.z;
      place = position;
      gl_Position = projectionMatrix * seen;
      gl_PointSize = clamp(pointSize / depth, 1.0, 64.0);
    }`;
  const FRAGMENT = `
    uniform sampler2D colors;
    uniform vec2 range;
    uniform vec2 limits;
    uniform vec3 classes[3];
    uniform bool isByLimits;
    uniform bool isByWall;
    uniform bool isOneWall;
    uniform float pixelRatio;
    uniform vec4 cut;
    uniform float nearest;
    uniform float least;
    varying vec3 ofWall;
    varying float chosen;
    varying float weight;
    varying float wall;
    varying float known;
    varying float light;
    varying float depth;
    varying vec3 place;
    void main() {
      #ifdef ROUND
      if (length(gl_PointCoord - 0.5) > 0.5) discard;
      #endif
      if (depth < nearest || weight < least - 0.5 || dot(cut.xyz, place) > cut.w) discard;
      float share = (wall - range.x) / (range.y - range.x);
      vec3 color = texture2D(colors, vec2(clamp(share, 0.002, 0.998), 0.5)).rgb;
      if (isByLimits) color = wall < limits.x ? classes[0] : wall > limits.y ? classes[2] : classes[1];
      if (known < -0.5) color = vec3(0.62, 0.64, 0.67);
      float stripe = step(0.6, fract((gl_FragCoord.x + gl_FragCoord.y) / (7.0 * pixelRatio)));
      if (known < 0.5) color = mix(color, vec3(1.0), 0.75 * stripe);
      if (isByWall) color = ofWall;
      if (isOneWall && chosen < 0.5) {
        // A grid of pixels, through which the chosen wall is seen.
        if (mod(floor(gl_FragCoord.x), 2.0) + mod(floor(gl_FragCoord.y), 2.0) > 0.5) discard;
        color = mix(color, vec3(0.9), 0.8);
      }
      gl_FragColor = vec4(color * light, 1.0);
    }`;
  // Gray glass, denser where it is seen from the side.
  const PART_FRAGMENT = `
    uniform vec4 cut;
    uniform float nearest;
    varying float light;
    varying float depth;
    varying float facing;
    varying vec3 place;
    void main() {
      if (depth < nearest || dot(cut.xyz, place) > cut.w) discard;
      gl_FragColor = vec4(mix(vec3(0.36, 0.39, 0.44), vec3(0.85), facing) * light, mix(0.7, 0.18, facing));
    }`;
  const FAR_AWAY = 1e30;
  const MARGIN = 70; // pixels around the box
  const CLASSES = ["#d55e00", "#009e73", "#0072b2"]; // below, within and above; told apart by all eyes
  const WALLS = "#9aa0a8 #e6194b #3cb44b #4363d8 #f58231 #911eb4 #42d4f4 #f032e6 #bfef45 #469990 #9a6324 #ffe119 #000075".split(" ");
  // Gray for no wall; the others repeat.
  const getColorOfWall = (wall) => (wall > 0 ? 1 + ((wall - 1) % (WALLS.length - 1)) : 0);

  function makeColors(hex) {
    const bytes = new Uint8Array(hex.length / 2);
    bytes.forEach((_, i) => (bytes[i] = parseInt(hex.substr(2 * i, 2), 16)));
    const texture = new THREE.DataTexture(bytes, bytes.length / 3, 1, THREE.RGBFormat);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
  }

  function makeGeometry({ positions, normals, thickness, isKnown, importance, wallColor, isChosen }, { index }) {
    const geometry = new THREE.BufferGeometry();
    const set = (name, values, size) => values && geometry.setAttribute(name, new THREE.BufferAttribute(values, size));
    set("position", positions, 3);
    set("normal", normals, 3);
    set("thickness", thickness, 1);
    set("isKnown", isKnown, 1);
    set("importance", importance, 1);
    set("wallColor", wallColor, 3);
    set("isChosen", isChosen, 1);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    return geometry;
  }

  // Colors of the points by their walls, and whether these are chosen.
  function makeWalls(data, sheet) {
    if (!data.walls) {
      return {};
    }
    const colors = WALLS.map((color) => new THREE.Color(color).toArray());
    const wallColor = new Float32Array(3 * sheet.wall.length);
    sheet.wall.forEach((wall, at) => wallColor.set(colors[getColorOfWall(wall)], 3 * at));
    return { wallColor, isChosen: new Float32Array(sheet.wall.length) };
  }

  // The box along the axes of space around the largest piece of the sheet, or all of them.
  function makeBounds(data, sheet, hasAll) {
    const box = new THREE.Box3();
    const point = new THREE.Vector3();
    sheet.isMain.forEach((isMain, at) => {
      if (isMain || hasAll) {
        box.expandByPoint(point.fromArray(sheet.positions, 3 * at));
      }
    });
    return box.expandByScalar(Math.max(...data.spacing) * data.edge);
  }

  // Steps of 1, 2 or 5 times a power of ten, at most so many of them.
  function makeStep(length, most = 4) {
    const raw = length / most;
    const power = 10 ** Math.floor(Math.log10(raw));
    return power * ([1, 2, 5].find((factor) => factor * power >= raw) ?? 10);
  }

  // Numbers along the axes: where on which axis, and the text.
  function makeTicks(bounds, frame, unit) {
    const ticks = [];
    const longest = Math.max(...bounds.getSize(new THREE.Vector3()).toArray());
    const step = makeStep(longest);
    for (let axis = 0; axis < 3; ++axis) {
      const [low, high] = [bounds.min, bounds.max].map((end) => end.getComponent(axis) + frame.middle[axis]);
      for (let number = Math.ceil(low / step); number * step <= high; ++number) {
        const text = String(Number((number * step).toPrecision(10)));
        ticks.push({ axis, at: number * step - frame.middle[axis], text, kind: "number" });
      }
      ticks.push({ axis, at: high - frame.middle[axis] + 0.06 * longest, text: "xyz"[axis] + unit, kind: "name" });
    }
    return ticks;
  }

  // The edge of the box along an axis that is lowest in the picture, of z the one most to the left, and the way off it.
  function findEdge(axis, bounds, camera) {
    const middle = bounds.getCenter(new THREE.Vector3());
    const center = middle.clone().project(camera);
    const ends = [bounds.min, bounds.max];
    const edges = [0, 1, 2, 3].map((corner) => {
      const point = middle.clone();
      point.setComponent((axis + 1) % 3, ends[corner & 1].getComponent((axis + 1) % 3));
      point.setComponent((axis + 2) % 3, ends[corner >> 1].getComponent((axis + 2) % 3));
      const away = point.clone().project(camera).sub(center);
      return { point, away, rank: axis === 2 ? away.x : away.y };
    });
    return edges.reduce((best, edge) => (edge.rank < best.rank ? edge : best));
  }

  // Two balls and a line that nothing hides.
  function makeMarks() {
    const marks = new THREE.Group();
    const options = { color: 0x111827, depthTest: false, transparent: true };
    const ball = new THREE.SphereBufferGeometry(1, 20, 14);
    const balls = [0, 1].map(() => new THREE.Mesh(ball, new THREE.MeshBasicMaterial(options)));
    const line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(options));
    line.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    line.frustumCulled = false;
    marks.add(...balls, line);
    marks.children.forEach((child) => (child.renderOrder = 10));
    marks.visible = false;
    marks.show = (sides) => {
      sides.forEach((side, i) => {
        balls[i].position.copy(side);
        line.geometry.attributes.position.setXYZ(i, side.x, side.y, side.z);
      });
      line.geometry.attributes.position.needsUpdate = true;
      marks.visible = true;
    };
    marks.setSize = (size) => balls.forEach((one) => one.scale.setScalar(size));
    return marks;
  }

  function make(canvas, data, sheet) {
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    const bounds = new THREE.Box3();
    const middle = new THREE.Vector3();
    const uniforms = {
      colors: { value: makeColors(data.colors) },
      range: { value: new THREE.Vector2(data.low, data.high) },
      limits: { value: new THREE.Vector2(...data.limits) },
      classes: { value: CLASSES.map((color) => new THREE.Color(color)) },
      isByLimits: { value: false },
      isByWall: { value: false },
      isOneWall: { value: false },
      pixelRatio: { value: 1 },
      cut: { value: new THREE.Vector4(0, 0, 0, FAR_AWAY) },
      nearest: { value: 0 },
      least: { value: 0 },
      pointSize: { value: 1 },
    };
    const makeMaterial = (options) =>
      new THREE.ShaderMaterial({ uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: THREE.DoubleSide, ...options });
    const walls = makeWalls(data, sheet);
    const surface = new THREE.Mesh(makeGeometry({ ...sheet, ...walls }, sheet.faces), makeMaterial({}));
    const singles = new THREE.Points(makeGeometry({ ...sheet, ...walls }, sheet.singles), makeMaterial({ defines: { ROUND: true } }));
    surface.frustumCulled = singles.frustumCulled = false;
    const marks = makeMarks();
    const scene = new THREE.Scene();
    scene.add(surface, singles, new THREE.Box3Helper(bounds, 0x8b95a3), marks);
    const camera = new THREE.PerspectiveCamera(32, 1, 1, 10);
    camera.up.set(0, 0, 1);
    const pieces = { hasAll: false, drawn: [[surface.geometry, sheet.faces.main], [singles.geometry, sheet.singles.main]] };
    let ticks = [];
    let radius = 0;

    // The largest piece alone, or all.
    function choosePieces(hasAll) {
      bounds.copy(makeBounds(data, sheet, hasAll));
      bounds.getCenter(middle);
      radius = bounds.getSize(new THREE.Vector3()).length() / 2;
      ticks = makeTicks(bounds, sheet.frame, data.lengths.length < 3 ? `, ${data.lengths}` : "");
      pieces.hasAll = hasAll;
      setDrawRanges();
    }

    function setDrawRanges() {
      pieces.drawn.forEach(([geometry, main]) => geometry.setDrawRange(0, pieces.hasAll ? Infinity : main));
    }

    // The surface of the part over the sheet: its nearest layer alone, which the depths find first. Made when it is first shown.
    let layers = null;
    function showPart(isShown, build) {
      if (isShown && !layers) {
        const part = build();
        const geometry = makeGeometry(part, part.faces);
        const options = { fragmentShader: PART_FRAGMENT, transparent: true };
        layers = [{ colorWrite: false }, { depthWrite: false }].map((more, order) => {
          const layer = new THREE.Mesh(geometry, makeMaterial({ ...options, ...more }));
          layer.frustumCulled = false;
          layer.renderOrder = order + 1;
          return layer;
        });
        scene.add(...layers);
        pieces.drawn.push([geometry, part.faces.main]);
        setDrawRanges();
      }
      (layers || []).forEach((layer) => (layer.visible = isShown));
    }

    // The target, and the distance from it at which the box just fits with room for the numbers, seen from a direction.
    function fit(direction) {
      const right = camera.up.clone().cross(direction).normalize();
      const up = direction.clone().cross(right);
      const ends = [bounds.min, bounds.max].map((end) => end.clone().sub(middle).toArray());
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => new THREE.Vector3(...[0, 1, 2].map((axis) => ends[(corner >> axis) & 1][axis])));
      const slope = Math.tan((camera.fov * Math.PI) / 360);
      const { clientWidth, clientHeight } = canvas;
      const target = middle.clone();
      const distances = [
        [right, slope * camera.aspect * (1 - MARGIN / clientWidth)],
        [up, slope * (1 - MARGIN / clientHeight)],
      ].map(([axis, most]) => {
        const [high, low] = [1, -1].map((sign) => Math.max(...corners.map((corner) => sign * corner.dot(axis) + most * corner.dot(direction))));
        target.addScaledVector(axis, (high - low) / 2);
        return (high + low) / (2 * most);
      });
      return { target, distance: Math.max(...distances) };
    }

    // 0: all
    function chooseWall(number) {
      uniforms.isOneWall.value = number > 0;
      sheet.wall.forEach((wall, at) => (walls.isChosen[at] = wall === number ? 1 : 0));
      [surface, singles].forEach(({ geometry }) => (geometry.attributes.isChosen.needsUpdate = true));
    }

    function resize() {
      const { clientWidth, clientHeight } = canvas.parentElement;
      uniforms.pixelRatio.value = Math.min(window.devicePixelRatio, 2);
      renderer.setPixelRatio(uniforms.pixelRatio.value);
      renderer.setSize(clientWidth, clientHeight, false);
      camera.aspect = clientWidth / Math.max(clientHeight, 1);
    }

    function render(target) {
      const distance = camera.position.distanceTo(target);
      const toMiddle = camera.position.distanceTo(middle);
      const far = toMiddle + 2 * radius;
      camera.near = Math.max(distance / 50, toMiddle - 2 * radius, far / 1e5);
      camera.far = far;
      camera.updateProjectionMatrix();
      const height = renderer.getDrawingBufferSize(new THREE.Vector2()).y;
      uniforms.pointSize.value = (data.edge * Math.max(...data.spacing) * height) / (2 * Math.tan((camera.fov * Math.PI) / 360));
      marks.setSize(distance * 0.006);
      renderer.render(scene, camera);
    }

    // axis null: no cut
    function setCut(axis, share, isFlipped) {
      const sign = isFlipped ? -1 : 1;
      const cut = new THREE.Vector4(0, 0, 0, FAR_AWAY);
      if (axis !== null) {
        const [low, high] = [bounds.min, bounds.max].map((end) => end.getComponent(axis));
        cut.setComponent(axis, sign).setComponent(3, sign * (low + share * (high - low)));
      }
      uniforms.cut.value = cut;
      return axis === null ? null : uniforms.cut.value.w * sign + sheet.frame.middle[axis];
    }

    // Texts, their points, and the direction in the picture that they are to be moved along.
    function placeTicks() {
      const edges = [0, 1, 2].map((axis) => findEdge(axis, bounds, camera));
      return ticks.map(({ axis, at, text, kind }) => {
        const { point, away } = edges[axis];
        return { point: point.clone().setComponent(axis, at), away, text, kind };
      });
    }

    function isShown(point) {
      const { x, y, z, w } = uniforms.cut.value;
      const depth = -point.clone().applyMatrix4(camera.matrixWorldInverse).z;
      return x * point.x + y * point.y + z * point.z <= w && depth >= uniforms.nearest.value;
    }

    // Where the sheet is hit at a place of the canvas from -1 to 1; null: nowhere.
    function pick(x, y) {
      const caster = new THREE.Raycaster();
      caster.setFromCamera(new THREE.Vector2(x, y), camera);
      const isImportant = ({ face }) => sheet.importance[face.a] >= uniforms.least.value;
      const hit = caster.intersectObject(surface).find((found) => isShown(found.point) && isImportant(found));
      const at = hit?.face.a;
      return hit ? { point: hit.point, thickness: sheet.thickness[at], isKnown: sheet.isKnown[at] > 0, wall: sheet.wall[at] } : null;
    }

    // Whether the point of the sheet that is nearest to a place is in its largest piece.
    function isInMainPiece(place) {
      let [least, nearest] = [Infinity, 0];
      const point = new THREE.Vector3();
      for (let at = 0; at < sheet.isMain.length; ++at) {
        const distance = point.fromArray(sheet.positions, 3 * at).distanceToSquared(place);
        [least, nearest] = distance < least ? [distance, at] : [least, nearest];
      }
      return sheet.isMain[nearest] > 0;
    }

    return {
      camera, marks, resize, render, setCut, pick, placeTicks, choosePieces, showPart, fit, isInMainPiece, chooseWall,
      getRadius: () => radius,
      hideBefore: (depth) => (uniforms.nearest.value = depth),
      hideBelow: (importance) => (uniforms.least.value = importance),
      colorBy: (choice) => {
        uniforms.isByLimits.value = choice === "limits";
        uniforms.isByWall.value = choice === "wall";
      },
    };
  }

  return { make, makeStep, getWallColor: (wall) => WALLS[getColorOfWall(wall)], CLASSES };
})();
