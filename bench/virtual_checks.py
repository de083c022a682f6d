# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures back what virtual scans claim to be: volume, share of single voxels, blur, noise and its correlation."""

import numpy as np
import virtual_parts as parts
import virtual_scan as scan
from scipy import optimize, special


def check_volumes():
    """Relative error of the volume of wedges and of a shell; worst of all tilts."""
    walls = (0.5, 1, 2, 4, 8)
    width = max(walls) + 2 * parts.MARGIN + 8
    exact = sum(wall * (wall + 2 * parts.MARGIN + 8) * width for wall in walls)
    worst = 0.0
    for normal in parts.TILTS.values():
        fine = parts.step_wedge(walls, normal, (0.13, -0.31, 0.42)).fill(2)
        worst = max(worst, abs(fine.sum() / 8 / exact - 1))
    hull = parts.shell(0.75, 19.3, (0.2, -0.1, 0.4), 48).fill(2).sum() / 8
    outer, inner = 19.3 + 0.375, 19.3 - 0.375
    return {"wedge": worst, "shell": abs(hull / (4 / 3 * np.pi * (outer**3 - inner**3)) - 1)}


def check_shares():
    """Largest difference from counting 40^3 points of single voxels with a rule that is written anew."""
    random = np.random.default_rng(5)
    axis = (np.arange(40) + 0.5) / 40 - 0.5
    grid = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
    worst = 0.0
    for name, normal in parts.TILTS.items():
        part = parts.plate(1.5, normal, (0.2, 0.1, -0.3), 24, 6.0)
        filled = scan.blur(part.fill(4), 0, 4)
        turn = parts.frame(normal, (0.31, 0.87, -0.2))
        edge = np.argwhere((filled > 0) & (filled < 1))
        for z, y, x in random.permutation(edge)[:40]:
            own = np.abs((grid + (x, y, z) - 11.5 - (0.2, 0.1, -0.3)) @ turn.T)
            counted = (own <= (6.0, 6.0, 0.75)).all(axis=1).mean()
            worst = max(worst, abs(counted - filled[z, y, x]))
    return worst


def fit_edge(values, distance, reach=5.0):
    """Standard deviation of the Gaussian whose integral is the edge; distance: from the face, positive in the material."""
    near = np.abs(distance) < reach

    def rise(place, middle, sigma, low, high):
        return low + (high - low) * special.ndtr((place - middle) / sigma)

    found, _ = optimize.curve_fit(rise, distance[near], values[near], (0, 0.8, 0, 1))
    return abs(float(found[1]))


def check_blurs():
    """Stated blur, and the fitted one without the share of the voxel, 1/12 of its variance."""
    part = parts.plate(14, (1, 2, 5), (0.1, 0.2, 0.3), 48, 16.0)
    wall, fine = part.walls[0], part.fill(scan.DIVISION)
    z, y, x = np.indices(part.size[::-1]).reshape(3, -1)
    points = np.stack((x, y, z), axis=-1)
    clear = np.all([np.abs(limit.distance(points)[0]) < 8 for limit in wall.limits], axis=0) & (wall.offset(points) > 0)
    distance = wall.thickness / 2 - wall.offset(points[clear])
    result = {}
    for sigma in (0.5, 0.8, 1.0, 1.5):
        width = fit_edge(scan.blur(fine, sigma).reshape(-1)[clear], distance)
        result[str(sigma)] = round(float(np.sqrt(width**2 - 1 / 12)), 4)
    return result


def describe_noise(noise):
    """Standard deviation, and correlation of neighbors along x, y and z."""
    noise = noise - noise.mean()
    variance = (noise**2).mean()
    pairs = [(noise[..., 1:] * noise[..., :-1]), (noise[:, 1:] * noise[:, :-1]), (noise[1:] * noise[:-1])]
    return {
        "deviation": round(float(np.sqrt(variance)), 4),
        "neighbors": [round(float(pair.mean() / variance), 3) for pair in pairs],
    }


def run_checks():
    random = np.random.default_rng(9)
    shape = (96, 96, 96)
    theory = np.exp(-1 / (4 * scan.CORRELATION**2))
    return {
        "volume_relative_error": {name: float(f"{error:.1e}") for name, error in check_volumes().items()},
        "voxel_share_error": round(float(check_shares()), 4),
        "blur_measured": check_blurs(),
        "white_noise_of_0.1": describe_noise(scan.make_noise(shape, 0.1, False, random)),
        "correlated_noise_of_0.1": describe_noise(scan.make_noise(shape, 0.1, True, random)),
        "correlation_of_continuous_gaussian": round(float(theory), 3),
    }
