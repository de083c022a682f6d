// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
//
// The sheet from the bytes in the page: points, and the surface through them. Knows nothing of how it is shown.
"use strict";

const MedialVoxelSheet = (() => {
  const NOT_MEASURED = 1; // the code of a point whose cells are left out of the measurement; 0: all of them are unpaired
  const FIRST_LENGTH = 2;
  const MOST_ROUNDS = 256; // that lengths spread, a point further in each

  function decodeBase64(text) {
    const characters = atob(text.trim());
    const bytes = new Uint8Array(characters.length);
    for (let i = 0; i < bytes.length; ++i) {
      bytes[i] = characters.charCodeAt(i);
    }
    return bytes;
  }

  // Numbers are seven bits to a byte, low ones first.
  function makeReader(bytes) {
    let at = 0;
    return {
      byte: () => bytes[at++],
      number: () => {
        let number = 0;
        for (let factor = 1; ; factor *= 128) {
          const byte = bytes[at++];
          number += (byte & 127) * factor;
          if (byte < 128) {
            return number;
          }
        }
      },
    };
  }

  // Blocks, indices of their points in the volume, thickness, whether it is known, the thickness of the importance, and the wall.
  function decodePoints(bytes, data) {
    const reader = makeReader(bytes);
    const number = data.points;
    const [width, height] = data.blocks;
    const points = {
      number,
      keys: new Float64Array(number),
      blocks: new Uint32Array(3 * number),
      indices: new Float64Array(3 * number),
      thickness: new Float32Array(number),
      isKnown: new Float32Array(number),
      isMeasured: new Uint8Array(number),
      importance: new Float32Array(number),
      wall: new Uint32Array(number),
    };
    let key = 0;
    for (let point = 0; point < number; ++point) {
      key += reader.number();
      points.keys[point] = key;
      const row = Math.floor(key / width);
      points.blocks.set([key % width, row % height, Math.floor(row / height)], 3 * point);
      for (let axis = 0; axis < 3; ++axis) {
        const inside = data.edge > 1 ? ((reader.byte() + 0.5) / 256) * data.edge - 0.5 : 0;
        points.indices[3 * point + axis] = points.blocks[3 * point + axis] * data.edge + inside;
      }
      const code = reader.number();
      points.isMeasured[point] = code !== NOT_MEASURED;
      points.isKnown[point] = code >= FIRST_LENGTH;
      points.thickness[point] = code >= FIRST_LENGTH ? (code - FIRST_LENGTH) * data.lengthUnit : 0;
      points.importance[point] = data.importance[1] > 0 ? reader.number() : 0;
      points.wall[point] = data.walls !== undefined ? reader.number() : 0;
    }
    return points;
  }

  // At 3 * point + axis the point of the block before along the axis, or -1.
  function findPrevious(points, size) {
    const strides = [1, size[0], size[0] * size[1]];
    const pointOf = new Map();
    const previous = new Int32Array(3 * points.number).fill(-1);
    points.keys.forEach((key, point) => pointOf.set(key, point));
    for (let at = 0; at < previous.length; ++at) {
      if (points.blocks[at] > 0) {
        previous[at] = pointOf.get(points.keys[Math.floor(at / 3)] - strides[at % 3]) ?? -1;
      }
    }
    return previous;
  }

  // A sheet that crosses an edge between four blocks is in all of them: there it has a quadrilateral, unless isCrossed
  // denies it. Edges of these are named as in previous, by their second end; uses counts the quadrilaterals at them.
  function findFaces(points, previous, isCrossed = () => true) {
    const faces = [];
    const uses = new Uint8Array(previous.length);
    for (let point = 0; point < points.number; ++point) {
      for (let axis = 0; axis < 3; ++axis) {
        const [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
        const [beforeB, beforeC] = [previous[3 * point + b], previous[3 * point + c]];
        const opposite = beforeB >= 0 && beforeC >= 0 ? previous[3 * beforeB + c] : -1;
        if (opposite >= 0 && isCrossed(point, axis)) {
          faces.push(point, beforeB, opposite, point, opposite, beforeC);
          [3 * point + b, 3 * point + c, 3 * beforeB + c, 3 * beforeC + b].forEach((edge) => ++uses[edge]);
        }
      }
    }
    return { faces: new Uint32Array(faces), uses };
  }

  // Moves points by a share of the way to the mean of their neighbors; those at the end of the sheet along the end.
  function smoothOnce(values, previous, uses, isEnd, share) {
    const sums = new Float64Array(values.length);
    const numbers = new Uint8Array(values.length / 3);
    const add = (to, from) => {
      for (let axis = 0; axis < 3; ++axis) {
        sums[3 * to + axis] += values[3 * from + axis];
      }
      ++numbers[to];
    };
    uses.forEach((used, edge) => {
      if (used > 0) {
        const [one, other] = [Math.floor(edge / 3), previous[edge]];
        [[one, other], [other, one]].forEach(([to, from]) => {
          if (!isEnd[to] || used === 1) {
            add(to, from);
          }
        });
      }
    });
    for (let at = 0; at < values.length; ++at) {
      const number = numbers[Math.floor(at / 3)];
      values[at] += number > 0 ? share * (sums[at] / number - values[at]) : 0;
    }
  }

  // The steps of voxels go, the size stays (Taubin 1995).
  function smooth(points, previous, uses) {
    const isEnd = new Uint8Array(points.number);
    uses.forEach((used, edge) => {
      if (used === 1) {
        isEnd[Math.floor(edge / 3)] = isEnd[previous[edge]] = 1;
      }
    });
    for (let round = 0; round < 4; ++round) {
      smoothOnce(points.indices, previous, uses, isEnd, 0.6);
      smoothOnce(points.indices, previous, uses, isEnd, -0.62);
    }
  }

  // Lengths spread from the nearest points that have one; points that are only not measured count as known then. Points
  // that no length reaches are -1.
  function spreadLengths(points, previous) {
    const isSet = Uint8Array.from(points.isKnown);
    let hasSpread = true;
    for (let round = 0; hasSpread && round < MOST_ROUNDS; ++round) {
      const sums = new Float64Array(points.number);
      const numbers = new Uint8Array(points.number);
      previous.forEach((other, at) => {
        const point = Math.floor(at / 3);
        if (other >= 0 && isSet[point] !== isSet[other]) {
          const [to, from] = isSet[point] ? [other, point] : [point, other];
          sums[to] += points.thickness[from];
          ++numbers[to];
        }
      });
      numbers.forEach((number, point) => {
        if (number > 0) {
          points.thickness[point] = sums[point] / number;
          points.isKnown[point] = points.isMeasured[point] ? points.isKnown[point] : 1;
          isSet[point] = 1;
        }
      });
      hasSpread = numbers.some((number) => number > 0);
    }
    isSet.forEach((is, point) => (points.isKnown[point] = is ? points.isKnown[point] : -1));
  }

  // Which points are in the largest connected piece.
  function findMainPiece(points, previous) {
    const parents = Uint32Array.from({ length: points.number }, (_, point) => point);
    const find = (point) => {
      while (parents[point] !== point) {
        point = parents[point] = parents[parents[point]];
      }
      return point;
    };
    previous.forEach((other, at) => {
      if (other >= 0) {
        parents[find(other)] = find(Math.floor(at / 3));
      }
    });
    const sizes = new Uint32Array(points.number);
    parents.forEach((_, point) => ++sizes[find(point)]);
    const largest = sizes.indexOf(sizes.reduce((most, size) => Math.max(most, size), 0));
    return Uint8Array.from(parents, (_, point) => (find(point) === largest ? 1 : 0));
  }

  // Groups of so many points with those of the main piece first, and the number of points in these.
  function putMainFirst(index, size, isMain) {
    const [main, others] = [[], []];
    for (let at = 0; at < index.length; at += size) {
      (isMain[index[at]] ? main : others).push(...index.subarray(at, at + size));
    }
    return { index: Uint32Array.from([...main, ...others]), main: main.length };
  }

  // The matrix from indices to space, relative to the middle of the volume.
  function makeFrame(data) {
    const columns = [0, 1, 2].map((axis) => data.direction[axis].map((part) => part * data.spacing[axis]));
    const toSpace = (index) =>
      [0, 1, 2].map((row) => data.origin[row] + columns.reduce((sum, column, axis) => sum + column[row] * index[axis], 0));
    const middle = toSpace(data.size.map((size) => (size - 1) / 2));
    const toScene = (index) => toSpace(index).map((value, row) => value - middle[row]);
    return { toSpace, toScene, middle };
  }

  function placePoints(points, shift, frame) {
    const positions = new Float32Array(3 * points.number);
    for (let point = 0; point < points.number; ++point) {
      const index = [0, 1, 2].map((axis) => points.indices[3 * point + axis] + shift[axis]);
      positions.set(frame.toScene(index), 3 * point);
    }
    return positions;
  }

  // Unit normals up to their sign, by area.
  function makeNormals(positions, faces) {
    const normals = new Float32Array(positions.length);
    const corner = (point, axis) => positions[3 * point + axis];
    for (let at = 0; at < faces.length; at += 3) {
      const [a, b, c] = [faces[at], faces[at + 1], faces[at + 2]];
      const [u, v] = [b, c].map((other) => [0, 1, 2].map((axis) => corner(other, axis) - corner(a, axis)));
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const point of [a, b, c]) {
        const along = normal.reduce((sum, part, axis) => sum + part * normals[3 * point + axis], 0);
        for (let axis = 0; axis < 3; ++axis) {
          normals[3 * point + axis] += along < 0 ? -normal[axis] : normal[axis];
        }
      }
    }
    for (let at = 0; at < normals.length; at += 3) {
      const length = Math.hypot(normals[at], normals[at + 1], normals[at + 2]) || 1;
      for (let axis = 0; axis < 3; ++axis) {
        normals[at + axis] /= length;
      }
    }
    return normals;
  }

  // Points without a face, as lines in rods have them.
  function findSingles(points, faces) {
    const isUsed = new Uint8Array(points.number);
    faces.forEach((point) => (isUsed[point] = 1));
    return Uint32Array.from(isUsed.keys()).filter((point) => !isUsed[point]);
  }

  function build(data, text) {
    const points = decodePoints(decodeBase64(text), data);
    const previous = findPrevious(points, data.blocks);
    const { faces, uses } = findFaces(points, previous);
    spreadLengths(points, previous);
    smooth(points, previous, uses);
    const frame = makeFrame(data);
    const positions = placePoints(points, data.shift, frame);
    const isMain = findMainPiece(points, previous);
    return {
      frame,
      indices: points.indices,
      positions,
      isMain,
      faces: putMainFirst(faces, 3, isMain),
      normals: makeNormals(positions, faces),
      singles: putMainFirst(findSingles(points, faces), 1, isMain),
      thickness: points.thickness,
      isKnown: points.isKnown,
      importance: points.importance,
      wall: points.wall,
    };
  }

  return { build, decodeBase64, makeReader, findPrevious, findFaces, smooth, placePoints, makeNormals, putMainFirst };
})();
