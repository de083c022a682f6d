// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
//
// The surface of the part from the bytes in the page: shares of object in blocks, and a surface net through them
// (Gibson 1998), made of the same points and faces as the sheet.
"use strict";

const MedialVoxelPart = (() => {
  const BITS_OF_SHARE = 16; // as a factor
  const MIDDLE = 7.5; // between outside and inside, in 15ths

  // Shares with a border of blocks without object, so that the surface closes at the faces of the volume.
  function decodeShares(bytes, blocks) {
    const reader = MedialVoxelSheet.makeReader(bytes);
    const size = blocks.map((number) => number + 2);
    const shares = new Uint8Array(size[0] * size[1] * size[2]);
    let [share, left] = [0, 0];
    for (let z = 1; z <= blocks[2]; ++z) {
      for (let y = 1; y <= blocks[1]; ++y) {
        const row = (z * size[1] + y) * size[0];
        for (let x = 1; x <= blocks[0]; ++x, --left) {
          if (left === 0) {
            const run = reader.number();
            [share, left] = [run % BITS_OF_SHARE, Math.floor(run / BITS_OF_SHARE) + 1];
          }
          shares[row + x] = share;
        }
      }
    }
    return { shares, size, strides: [1, size[0], size[0] * size[1]] };
  }

  const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => [corner & 1, (corner >> 1) & 1, corner >> 2]);
  const isInside = (share) => share > MIDDLE;

  // From the first of eight blocks to each of them.
  const findOffsets = (strides) => CORNERS.map((corner) => corner.reduce((offset, step, axis) => offset + step * strides[axis], 0));

  // The mean of the points where edges between the middles of eight blocks cross the surface, from the first of them.
  function findCrossing({ shares, strides }, key, offsets) {
    const sum = [0, 0, 0, 0];
    CORNERS.forEach((corner, i) => {
      for (let axis = 0; axis < 3; ++axis) {
        const [from, to] = [shares[key + offsets[i]], shares[key + offsets[i] + strides[axis]]];
        if (corner[axis] === 0 && isInside(from) !== isInside(to)) {
          corner.forEach((step, other) => (sum[other] += other === axis ? (MIDDLE - from) / (to - from) : step));
          ++sum[3];
        }
      }
    });
    return sum.slice(0, 3).map((value) => value / sum[3]);
  }

  // A point between eight blocks that are not alike; its block is the first of them.
  function findPoints(grid, edge) {
    const { shares, size, strides } = grid;
    const [keys, blocks, indices] = [[], [], []];
    const offsets = findOffsets(strides);
    for (let key = 0; key + offsets[7] < shares.length; ++key) {
      const first = isInside(shares[key]);
      if (offsets.some((offset) => isInside(shares[key + offset]) !== first)) {
        const block = [key % size[0], Math.floor(key / strides[1]) % size[1], Math.floor(key / strides[2])];
        keys.push(key);
        blocks.push(...block);
        findCrossing(grid, key, offsets).forEach((step, axis) => indices.push((block[axis] + step - 0.5) * edge - 0.5));
      }
    }
    return { number: keys.length, keys, blocks, indices: Float64Array.from(indices) };
  }

  // Which blocks are connected with one that has a main point of the sheet.
  function findMainBlocks({ shares, size, strides }, sheet, edge) {
    const isMain = new Uint8Array(shares.length);
    const open = [];
    const add = (at) => {
      if (isInside(shares[at]) && !isMain[at]) {
        isMain[at] = 1;
        open.push(at);
      }
    };
    sheet.isMain.forEach((is, point) => {
      const block = size.map((most, axis) => Math.min(Math.floor((sheet.indices[3 * point + axis] + 1) / edge) + 1, most - 1));
      if (is) {
        add(block.reduce((at, index, axis) => at + index * strides[axis], 0));
      }
    });
    while (open.length > 0) {
      const at = open.pop();
      strides.forEach((stride) => [at - stride, at + stride].forEach(add));
    }
    return isMain;
  }

  function build(data, text, sheet) {
    const grid = decodeShares(MedialVoxelSheet.decodeBase64(text), data.part.blocks);
    const { shares, strides } = grid;
    const points = findPoints(grid, data.part.edge);
    const previous = MedialVoxelSheet.findPrevious(points, grid.size);
    const isCrossed = (point, axis) => isInside(shares[points.keys[point]]) !== isInside(shares[points.keys[point] + strides[axis]]);
    const { faces, uses } = MedialVoxelSheet.findFaces(points, previous, isCrossed);
    MedialVoxelSheet.smooth(points, previous, uses);
    const positions = MedialVoxelSheet.placePoints(points, [0, 0, 0], sheet.frame);
    const isMainBlock = findMainBlocks(grid, sheet, data.part.edge);
    const offsets = findOffsets(strides);
    const isMain = points.keys.map((key) => offsets.some((offset) => isMainBlock[key + offset]));
    return { positions, normals: MedialVoxelSheet.makeNormals(positions, faces), faces: MedialVoxelSheet.putMainFirst(faces, 3, isMain) };
  }

  return { build };
})();
