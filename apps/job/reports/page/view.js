// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
//
// The view and those who look at it: mouse, keys, the table of places. Without WebGL the page stays as it is.
"use strict";

(() => {
  const element = (name) => document.getElementById("view-" + name);
  const canvas = element("canvas");
  const data = JSON.parse(element("data").textContent);
  const rows = [...document.querySelectorAll("tr.place")];
  const wallRows = data.walls ? [...document.querySelectorAll("tr.wall")] : [];
  const format = (value) => String(Number(value.toPrecision(4)));
  const formatPoint = (point) => point.map(format).join(", ");
  const inUnits = data.lengths ? " " + data.lengths : "";

  // Asked on a canvas of its own, so that a browser without WebGL has nothing to report.
  function hasWebGl() {
    const other = document.createElement("canvas");
    return Boolean(other.getContext("webgl2") || other.getContext("webgl"));
  }

  const limits = document.querySelector(".places")?.dataset ?? {};
  data.limits = [Number(limits.below ?? -Infinity), Number(limits.above ?? Infinity)];

  function makeElement(kind, name, text, style = {}) {
    const made = document.createElement(kind);
    made.className = name;
    made.textContent = text;
    Object.assign(made.style, style);
    return made;
  }

  // A field of a color and its text.
  function makeClass(text, name, style) {
    const made = makeElement("span", "class", text);
    made.prepend(makeElement("i", name, "", style));
    return made;
  }

  // One scale with numbers.
  function makeScale() {
    const colors = data.colors.match(/.{6}/g).map((color) => "#" + color);
    const bar = makeElement("span", "bar", "", { background: `linear-gradient(to right,${colors.join(",")})` });
    const step = MedialVoxelScene.makeStep(data.high - data.low, 5);
    for (let number = Math.ceil(data.low / step); number * step <= data.high; ++number) {
      const left = (100 * (number * step - data.low)) / (data.high - data.low);
      bar.append(makeElement("span", "tick", format(number * step), { left: left + "%" }));
    }
    return [bar];
  }

  // Walls below, within and above the limits that there are.
  function makeClasses() {
    const [below, above] = data.limits.map(format);
    const texts = [
      limits.below && `below ${below}`,
      limits.below && limits.above ? `${below} to ${above}` : limits.below ? `${below} and more` : `up to ${above}`,
      limits.above && `above ${above}`,
    ];
    return texts.flatMap((text, i) => (text ? [makeClass(text, "", { background: MedialVoxelScene.CLASSES[i] })] : []));
  }

  function showLegend(choice) {
    if (choice === "wall") {
      const title = makeElement("span", "title", "Colors of the walls in their table");
      element("legend").replaceChildren(title, makeClass("no wall, as at rims", "", { background: MedialVoxelScene.getWallColor(0) }));
      return;
    }
    element("legend").replaceChildren(
      makeElement("span", "title", `Thickness, ${data.lengths}`),
      ...(choice === "limits" ? makeClasses() : makeScale()),
      makeClass("rim or junction, in the color of the nearest wall", "rim")
    );
  }

  // Sides, corners of the extent and texts of a row of the table.
  function readPlace(row, frame) {
    const numbers = (name) => row.dataset[name].split(" ").map(Number);
    const toScene = (point) => new THREE.Vector3(...point.map((value, axis) => value - frame.middle[axis]));
    const box = numbers("box");
    const corners = [box.slice(0, 3), box.slice(3)].map((index) => new THREE.Vector3(...frame.toScene(index)));
    const sides = [numbers("sides").slice(0, 3), numbers("sides").slice(3)].map(toScene);
    return { center: toScene(numbers("center")), sides, size: corners[0].distanceTo(corners[1]), text: row.dataset.text };
  }

  function start() {
    const section = element("title").parentElement;
    section.hidden = false;
    const sheet = MedialVoxelSheet.build(data, element("points").textContent);
    const scene = MedialVoxelScene.make(canvas, data, sheet);
    const { camera } = scene;
    const controls = new THREE.OrbitControls(camera, canvas);
    const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    let selected = -1;
    let chosenWall = 0;
    let flight = null;
    let isAsked = false;
    let isWhole = true; // as it is shown at first

    const say = (text) => (element("status").textContent = text);

    function showTexts() {
      const texts = selected < 0 ? scene.placeTicks() : [scene.mark];
      element("ticks").replaceChildren(
        ...texts.map(({ point, away, text, kind }) => {
          const seen = point.clone().project(camera);
          const span = document.createElement("span");
          const length = Math.hypot(away.x, away.y) || 1;
          span.textContent = text;
          span.className = kind;
          const offset = (kind === "mark" ? 36 : 16) / length; // pixels
          span.style.left = `calc(${50 + 50 * seen.x}% + ${offset * away.x}px)`;
          span.style.top = `calc(${50 - 50 * seen.y}% - ${offset * away.y}px)`;
          span.hidden = seen.z > 1;
          return span;
        })
      );
    }

    function draw() {
      isAsked = false;
      const place = selected >= 0 && element("open").checked ? scene.place : null;
      camera.updateMatrixWorld();
      const depth = place ? -place.center.clone().applyMatrix4(camera.matrixWorldInverse).z - place.reach : 0;
      scene.hideBefore(Math.max(depth, 0));
      scene.render(controls.target);
      showTexts();
      if (!flight) {
        section.dataset.arrived = String(selected);
      }
      section.dataset.camera = [...camera.position.toArray(), ...controls.target.toArray()].map(format).join(" ");
    }

    function ask() {
      if (!isAsked) {
        isAsked = true;
        requestAnimationFrame(draw);
      }
    }

    // Moves the camera in half a second, or at once for those who want no motion.
    function fly(position, target) {
      const from = { position: camera.position.clone(), target: controls.target.clone(), time: performance.now() };
      flight = {};
      delete section.dataset.arrived;
      const own = flight;
      const step = (now) => {
        if (flight !== own) {
          return;
        }
        const time = calm ? 1 : Math.min(1, Math.max(0, (now - from.time) / 500));
        const share = time * time * (3 - 2 * time);
        camera.position.lerpVectors(from.position, position, share);
        controls.target.lerpVectors(from.target, target, share);
        controls.update();
        ask();
        if (time < 1) {
          requestAnimationFrame(step);
        } else {
          flight = null;
        }
      };
      step(from.time);
    }

    function markRow(number) {
      selected = number;
      section.dataset.place = String(number);
      rows.forEach((row, i) => row.classList.toggle("seen", i === number));
      scene.marks.visible = number >= 0;
    }

    function showWhole() {
      isWhole = true;
      markRow(-1);
      const direction = new THREE.Vector3(0.55, -1, 0.62).normalize();
      const { target, distance } = scene.fit(direction);
      fly(target.clone().addScaledVector(direction, distance), target);
      say("");
    }

    function choosePieces() {
      scene.choosePieces(element("pieces").checked);
      controls.minDistance = scene.getRadius() / 1000;
      controls.maxDistance = scene.getRadius() * 20;
      cut();
    }

    function color() {
      scene.colorBy(element("color").value);
      showLegend(element("color").value);
      ask();
    }

    // This one in its color and the others faint; again, or 0: all.
    function chooseWall(number) {
      chosenWall = number === chosenWall ? 0 : number;
      scene.chooseWall(chosenWall);
      wallRows.forEach((row, i) => {
        row.classList.toggle("seen", i + 1 === chosenWall);
        row.querySelector("button").setAttribute("aria-pressed", String(i + 1 === chosenWall));
      });
      section.dataset.wall = String(chosenWall);
      if (chosenWall > 0) {
        element("color").value = "wall";
        color();
        if (!element("pieces").checked && sheet.wall.some((wall, at) => wall === chosenWall && !sheet.isMain[at])) {
          element("pieces").checked = true;
          choosePieces();
        }
      }
      say(chosenWall > 0 ? `Wall ${chosenWall}; the others are faint` : "");
      ask();
    }

    function showPart() {
      const isShown = element("surface").checked;
      scene.showPart(isShown, () => {
        const part = MedialVoxelPart.build(data, element("part").textContent, sheet);
        section.dataset.partTriangles = String(part.faces.index.length / 3);
        return part;
      });
      section.dataset.part = String(isShown);
      ask();
    }

    // The sheet of a larger thickness: what is less important goes.
    function chooseImportance() {
      const least = Number(element("importance").value);
      scene.hideBelow(least);
      element("importance-text").textContent = format(least * data.lengthUnit) + inUnits;
      section.dataset.importance = format(least * data.lengthUnit);
      ask();
    }

    // Controls of what this sheet has.
    function offerChoices() {
      const [least, most] = data.importance;
      element("importance-label").hidden = least === most;
      Object.assign(element("importance"), { min: least, max: most, value: least });
      chooseImportance();
      const others = 1 - sheet.isMain.reduce((sum, is) => sum + is, 0) / sheet.isMain.length;
      const has = { limits: limits.below || limits.above, wall: data.walls };
      [...element("color").options].filter(({ value }) => value && !has[value]).forEach((option) => option.remove());
      element("color-label").hidden = element("color").length < 2;
      element("wall-keys").hidden = !data.walls;
      data.walls && chooseWall(0);
      element("pieces-label").hidden = others === 0;
      element("pieces-text").textContent = `Other pieces, ${(100 * others).toFixed(1)} % of the sheet`;
      section.dataset.others = String(others);
    }

    // From where both sides are seen beside each other, and the sheet between them from above.
    function showPlace(number) {
      isWhole = false;
      const place = readPlace(rows[number], sheet.frame);
      const across = place.sides[1].clone().sub(place.sides[0]);
      const thickness = across.length() || 1;
      across.normalize();
      const view = camera.position.clone().sub(controls.target).normalize();
      if (view.dot(across) < 0) {
        across.negate();
      }
      const along = view.addScaledVector(across, -view.dot(across));
      if (along.length() < 0.05) {
        along.set(across.y, across.z, across.x).addScaledVector(across, -along.dot(across));
      }
      const reach = Math.min(Math.max(place.size / 2, 4 * thickness), 10 * thickness);
      const direction = along.normalize().multiplyScalar(0.75).addScaledVector(across, 0.66).normalize();
      scene.place = { center: place.center, reach: reach / 2 };
      scene.mark = { point: place.center, away: { x: 0, y: 1.4 }, text: rows[number].dataset.length, kind: "mark" };
      markRow(number);
      if (!element("pieces").checked && !scene.isInMainPiece(place.center)) {
        element("pieces").checked = true;
        choosePieces();
      }
      scene.marks.show(place.sides);
      fly(place.center.clone().addScaledVector(direction, Math.min(4.2 * reach, 2 * scene.getRadius())), place.center);
      say(place.text);
    }

    function cut(axis) {
      const isCut = element("axis").value !== "";
      element("cut").disabled = element("flip").disabled = !isCut;
      const at = scene.setCut(isCut ? Number(element("axis").value) : null, element("cut").value / 200, element("flip").checked);
      section.dataset.cut = at === null ? "" : format(at);
      if (at !== null && axis !== undefined) {
        say("Cut across " + "xyz"[element("axis").value] + " at " + format(at));
      }
      ask();
    }

    function chooseCut(axis) {
      element("axis").value = element("axis").value === axis ? "" : axis;
      cut(axis);
    }

    function moveCut(steps) {
      element("cut").value = Number(element("cut").value) + steps;
      cut(element("axis").value);
    }

    function turn(right, up) {
      const arm = camera.position.clone().sub(controls.target);
      const spherical = new THREE.Spherical().setFromVector3(new THREE.Vector3(arm.y, arm.z, arm.x));
      spherical.theta += right;
      spherical.phi -= up;
      spherical.makeSafe();
      const turned = new THREE.Vector3().setFromSpherical(spherical);
      camera.position.copy(controls.target).add(arm.set(turned.z, turned.x, turned.y));
      controls.update();
      ask();
    }

    function move(right, up) {
      const length = 0.04 * camera.position.distanceTo(controls.target);
      const step = new THREE.Vector3(right * length, up * length, 0).applyQuaternion(camera.quaternion);
      camera.position.add(step);
      controls.target.add(step);
      controls.update();
      ask();
    }

    function zoom(factor) {
      camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
      controls.update();
      ask();
    }

    const nextPlace = (steps) => {
      if (rows.length > 0) {
        showPlace(selected < 0 ? 0 : (selected + steps + rows.length) % rows.length);
      }
    };

    const ANGLE = Math.PI / 24;
    const arrow = (right, up) => (event) => (event.shiftKey ? move(right, up) : turn(right * ANGLE, up * ANGLE));
    const keys = {
      ArrowLeft: arrow(-1, 0),
      ArrowRight: arrow(1, 0),
      ArrowUp: arrow(0, 1),
      ArrowDown: arrow(0, -1),
      "+": () => zoom(1 / 1.15),
      "=": () => zoom(1 / 1.15),
      "-": () => zoom(1.15),
      n: () => nextPlace(1),
      p: () => nextPlace(-1),
      x: () => chooseCut("0"),
      y: () => chooseCut("1"),
      z: () => chooseCut("2"),
      "[": () => moveCut(-4),
      "]": () => moveCut(4),
      s: () => element("surface").click(),
      Home: showWhole,
      Escape: () => {
        data.walls && chooseWall(0);
        showWhole();
      },
    };

    function pressKey(event) {
      const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (action && !event.ctrlKey && !event.altKey && !event.metaKey) {
        event.preventDefault();
        flight = null;
        isWhole = false;
        action(event);
      }
    }

    // A click is a press that did not move.
    function listenToClicks() {
      let pressed = null;
      canvas.addEventListener("pointerdown", (event) => {
        flight = null;
        pressed = [event.clientX, event.clientY];
        canvas.focus({ preventScroll: true });
      });
      canvas.addEventListener("click", (event) => {
        const area = canvas.getBoundingClientRect();
        if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) {
          return;
        }
        const [x, y] = [(event.clientX - area.left) / area.width, (event.clientY - area.top) / area.height];
        const hit = scene.pick(2 * x - 1, 1 - 2 * y);
        if (hit) {
          const point = hit.point.toArray().map((value, axis) => value + sheet.frame.middle[axis]);
          const length = hit.isKnown ? "thickness " + format(hit.thickness) + inUnits : "a rim or junction, without a thickness";
          say(`At ${formatPoint(point)}: ${length}${hit.wall > 0 ? `, wall ${hit.wall}` : ""}`);
        }
      });
    }

    // The number of a row becomes a button, which keys reach.
    function listenToRow(row, label, show) {
      const button = document.createElement("button");
      const cell = row.cells[0];
      button.type = "button";
      button.textContent = cell.textContent;
      button.setAttribute("aria-label", label);
      cell.replaceChildren(button);
      row.addEventListener("click", () => {
        element("stage").scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
        canvas.focus({ preventScroll: true });
        show();
      });
    }

    function listenToRows() {
      document.body.classList.add("with-view");
      rows.forEach((row, number) => listenToRow(row, "Fly to " + row.dataset.text, () => showPlace(number)));
      wallRows.forEach((row, i) => {
        listenToRow(row, `Show wall ${i + 1}`, () => chooseWall(i + 1));
        row.cells[0].prepend(makeElement("i", "object", "", { background: MedialVoxelScene.getWallColor(i + 1) }));
      });
    }

    controls.enableKeys = false;
    controls.enableZoom = false;
    controls.screenSpacePanning = true;
    controls.addEventListener("change", ask);
    controls.addEventListener("start", () => (isWhole = false));
    canvas.addEventListener("focus", () => (controls.enableZoom = true));
    canvas.addEventListener("blur", () => (controls.enableZoom = false));
    canvas.addEventListener("keydown", pressKey);
    element("whole").addEventListener("click", showWhole);
    element("axis").addEventListener("change", () => cut(element("axis").value));
    element("cut").addEventListener("input", () => cut(element("axis").value));
    element("flip").addEventListener("change", () => cut());
    element("open").addEventListener("change", ask);
    element("surface").addEventListener("change", showPart);
    element("color").addEventListener("change", color);
    element("importance").addEventListener("input", chooseImportance);
    element("pieces").addEventListener("change", () => {
      choosePieces();
      showWhole();
    });
    new ResizeObserver(() => {
      scene.resize();
      isWhole ? showWhole() : ask();
    }).observe(canvas.parentElement);
    listenToClicks();
    listenToRows();
    offerChoices();
    color();
    scene.resize();
    choosePieces();
    showWhole();
    section.dataset.triangles = String(sheet.faces.index.length / 3);
    document.getElementById("picture").open = false;
  }

  if (hasWebGl()) {
    start();
  }
})();
