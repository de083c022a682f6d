# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Step wedges of aluminum, scanned by a cone beam and reconstructed by RTK (itk-rtk). Lengths are voxels of 0.25 mm.

Paths through the boxes are exact, four for each pixel, whose intensities are averaged. The counts have Poisson noise. A
beam of one energy is linear; a beam of 100 kV hardens, and nothing corrects it. Scatter, focal spot, rings and motion
are not simulated. The axis of rotation is x of the part.
"""

import functools
import pathlib
import tempfile

import itk
import numpy as np
import thickness_runs as runs
import virtual_checks as checks
import virtual_parts as parts
import virtual_scan as scan
from itk import RTK as rtk
from scipy import ndimage

VOXEL = 0.025  # cm
SOURCE, DETECTOR = 800.0, 1600.0  # distances from the source of the axis and of the detector
PROJECTIONS = 360
PITCH = 2.0  # of the pixels; magnified twice
DIVISION = 2
# Mass attenuation of aluminum, keV and cm2/g (NIST, Hubbell and Seltzer), and its density.
ATTENUATION = ((10, 26.23), (15, 7.955), (20, 3.441), (30, 1.128), (40, 0.5685), (50, 0.3681), (60, 0.2778), (80, 0.2018),
               (100, 0.1704))  # fmt: skip
DENSITY = 2.699
TUBE, WINDOW = 100.0, 0.1  # keV, cm of aluminum
ENERGY = 60.0
# Kind of beam, and photons for each pixel without a part.
BEAMS = (("one energy", 20000), ("one energy", 200), ("100 kV", 20000), ("100 kV", 200))


def attenuate(energies):
    """Per voxel of aluminum."""
    known = np.log(np.array(ATTENUATION))
    return np.exp(np.interp(np.log(energies), known[:, 0], known[:, 1])) * DENSITY * VOXEL


@functools.cache
def make_beam(kind):
    """Energies and their shares of the signal of a detector that adds up energy; the spectrum is that of Kramers."""
    if kind == "one energy":
        return np.array([ENERGY]), np.ones(1)
    energies = np.arange(12.5, TUBE, 1.0)
    shares = (TUBE / energies - 1) * np.exp(-attenuate(energies) * WINDOW / VOXEL) * energies
    return energies, shares / shares.sum()


def transmit(paths, kind):
    """Share of the signal behind `paths` voxels."""
    energies, shares = make_beam(kind)
    table = np.linspace(0, paths.max() + 1, 4000)
    return np.interp(paths, table, np.exp(-np.outer(table, attenuate(energies))) @ shares)


def cross_piece(bands, source, directions):
    """Length of rays inside what flat bands have in common; directions have length 1."""
    first, last = np.full(len(directions), -np.inf), np.full(len(directions), np.inf)
    for band in bands:
        slope = directions @ band.normal
        slope = np.where(np.abs(slope) < 1e-12, 1e-12, slope)
        start = (source - band.origin) @ band.normal
        near, far = (band.low - start) / slope, (band.high - start) / slope
        first, last = np.maximum(first, np.minimum(near, far)), np.minimum(last, np.maximum(near, far))
    return np.maximum(last - first, 0)


class Scanner:
    """A circular scan around a part; x of the part is the axis, which is y for RTK."""

    def __init__(self, size):
        self.center = (np.array(size) - 1) / 2
        reach = np.hypot(*size[1:]) / 2 + 4
        grow = DETECTOR / (SOURCE - reach) / PITCH
        self.columns, self.rows = (int(np.ceil(2 * grow * half)) for half in (reach, size[0] / 2 + 4))
        self.geometry = rtk.ThreeDCircularProjectionGeometry.New()
        for angle in np.arange(PROJECTIONS) * 360 / PROJECTIONS:
            self.geometry.AddProjection(SOURCE, DETECTOR, float(angle))

    def _find_rays(self, number):
        """Source and directions of all rays of a projection, in the order of divided pixels."""
        matrix = itk.GetArrayFromVnlMatrix(
            self.geometry.GetProjectionCoordinatesToFixedSystemMatrix(number).GetVnlMatrix().as_matrix()
        )
        counts = (self.rows * DIVISION, self.columns * DIVISION)
        v, u = ((np.arange(n) - (n - 1) / 2) * PITCH / DIVISION for n in counts)
        v, u = np.meshgrid(v, u, indexing="ij")
        flat = np.stack((u, v, np.zeros_like(u), np.ones_like(u)), axis=-1).reshape(-1, 4)
        targets = (flat @ matrix.T)[:, [1, 0, 2]]
        source = np.array([*self.geometry.GetSourcePosition(number)])[[1, 0, 2]]
        directions = targets - source
        return source + self.center, directions / np.linalg.norm(directions, axis=1)[:, None]

    def project(self, part, kinds):
        """Signal of each pixel by kind of beam: (projections, rows, columns)."""
        result = {kind: np.empty((PROJECTIONS, self.rows, self.columns), np.float32) for kind in kinds}
        for number in range(PROJECTIONS):
            source, directions = self._find_rays(number)
            paths = sum(cross_piece(piece, source, directions) for piece in part.pieces)
            for kind in kinds:
                signal = transmit(paths, kind).reshape(self.rows, DIVISION, self.columns, DIVISION)
                result[kind][number] = signal.mean(axis=(1, 3))
        return result

    def reconstruct(self, signal, size, shift):
        """Attenuation per voxel (z, y, x) of a volume around the part that is moved by `shift` in it."""
        stack = itk.image_from_array(np.ascontiguousarray(-np.log(signal), np.float32))
        stack.SetSpacing([PITCH, PITCH, 1.0])
        stack.SetOrigin([-(self.columns - 1) / 2 * PITCH, -(self.rows - 1) / 2 * PITCH, 0.0])
        volume = itk.image_from_array(np.zeros((size[2], size[0], size[1]), np.float32))
        volume.SetOrigin([float(value) for value in (-self.center - shift)[[1, 0, 2]]])
        image = type(volume)
        back = rtk.FDKConeBeamReconstructionFilter[image].New()
        back.SetInput(0, volume)
        back.SetInput(1, stack)
        back.SetGeometry(self.geometry)
        back.Update()
        return itk.array_from_image(back.GetOutput()).transpose(0, 2, 1).copy()


def scale(volume, part):
    """Background 0 and the median deep in the thickest walls 1, as from the two peaks of a histogram."""
    deep = ndimage.distance_transform_edt(part.fill(1) > 0.5) > 3
    return volume / np.median(volume[deep])


def describe(values, part):
    """Fitted blur of the faces of the thickest wall without the share of the voxel, and the noise of the background."""
    points = np.indices(values.shape)[::-1].reshape(3, -1).T
    wall = part.walls[-1]
    clear = wall.is_inner(points)
    distance = wall.thickness / 2 - np.abs(wall.offset(points[clear]))
    width = checks.fit_edge(values.reshape(-1)[clear], distance, 3.5)
    inside = clear & (np.abs(wall.offset(points)) < wall.thickness / 2 - 2)
    corner = values[:8] - ndimage.uniform_filter(values[:8], 7)
    return {
        "blur": round(float(np.sqrt(max(width**2 - 1 / 12, 0))), 3),
        "material_deviation": round(float(values.reshape(-1)[inside].std()), 4),
        "background": checks.describe_noise(corner),
    }


def measure(build, walls, tilt, repetitions, seed):
    """All beams and repetitions of one wedge: (key of the row, tilt, sums), and what the volumes of the first are like."""
    normal, kinds = parts.TILTS[tilt], list(dict.fromkeys(kind for kind, _ in BEAMS))
    still = parts.step_wedge(walls, normal)
    scanner = Scanner(still.size)
    signals = scanner.project(still, kinds)
    result, found = [], {}
    with tempfile.TemporaryDirectory() as folder:
        program = runs.Program(build, pathlib.Path(folder))
        for repetition in repetitions:
            random = np.random.default_rng([*seed, repetition])
            shift = random.uniform(-0.5, 0.5, 3)
            part = parts.step_wedge(walls, normal, shift)
            rays = runs.make_rays(part)
            for kind, photons in BEAMS:
                counts = np.maximum(random.poisson(signals[kind] * photons), 1) / photons
                values = scale(scanner.reconstruct(counts, part.size, shift), part)
                name = (kind, photons)
                found.setdefault(name, describe(values, part))
                gray = scan.digitize(values)
                sums = runs.judge(part, rays, runs.to_unit(gray), program.run(gray))
                key = ("tomography", kind, "photons", photons)
                result += [((*key, wall.thickness), tilt, row) for wall, row in zip(part.walls, sums)]
    return result, [{"tilt": tilt, "beam": kind, "photons": photons} | text for (kind, photons), text in found.items()]
