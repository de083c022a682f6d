# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the user chose, and the parameters of the command line module that follow from it."""

import dataclasses
import math


@dataclasses.dataclass(frozen=True)
class Settings:
    """Object and thickness of one run.

    lower, upper -- the object has values from lower to upper; None: no such limit. Both None: all values but 0
    thickness    -- of the walls, in mm, greater than 0; None: each wall from 3 to 16 voxels by its own thickness
    branches     -- shorter branches of the sheet are left out, in mm; 0 keeps all
    """

    lower: float | None = None
    upper: float | None = None
    thickness: float | None = None
    branches: float = 0.0

    def check(self):
        """Raises ValueError, with a text for the user, if no run can come of this."""
        for name, value in (("lower threshold", self.lower), ("upper threshold", self.upper)):
            if value is not None and not math.isfinite(value):
                raise ValueError(f"The {name} is {value}; it must be a number.")
        if self.lower is not None and self.upper is not None and self.lower > self.upper:
            raise ValueError(f"The lower threshold {self.lower:g} is above the upper one, {self.upper:g}.")
        if self.thickness is not None and not 0 < self.thickness < math.inf:
            raise ValueError(f"The thickness is {self.thickness:g} mm; it must be greater than 0.")
        if not 0 <= self.branches < math.inf:
            raise ValueError(f"The branch length is {self.branches:g} mm; it must be 0 or more.")


def selection(settings):
    """Parameters that say which voxels are the object."""
    if settings.lower is None and settings.upper is None:
        return {"objectSelection": "NonZero"}
    if settings.upper is None:
        return {"objectSelection": "AboveLower", "lowerThreshold": float(settings.lower)}
    if settings.lower is None:
        return {"objectSelection": "BelowUpper", "upperThreshold": float(settings.upper)}
    limits = {"lowerThreshold": float(settings.lower), "upperThreshold": float(settings.upper)}
    return {"objectSelection": "Between"} | limits


def module_parameters(settings, volume, labels, model, report):
    """Parameters of MedialVoxelExtraction: strings, numbers, and the nodes of the volume, the label map and the model.

    report -- path of the JSON file to be written
    """
    settings.check()
    if settings.thickness is None:
        thickness = {"thicknessMode": "Automatic"}
    else:
        thickness = {"thicknessMode": "Fixed", "thickness": float(settings.thickness)}
    files = {"inputVolume": volume, "outputVolume": labels, "meshModel": model, "reportFile": report}
    return files | selection(settings) | thickness | {"minBranchLength": float(settings.branches)}


def summary(report):
    """One line about a run, from its report (a dictionary)."""
    line = f"{report['counts']['medial_cells']:,} medial cells"
    walls = report.get("thickness")
    if not walls or walls.get("mean") is None:
        return f"{line}; no wall was measured"
    return f"{line}; walls {walls['minimum']:.3g} to {walls['maximum']:.3g} mm, mean {walls['mean']:.3g} mm"
