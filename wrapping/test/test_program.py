# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The same bytes as the program on real volumes, and files that Python writes piece by piece."""

import pathlib
import subprocess
import tempfile
import unittest

import itk
import numpy as np

from support import blobs, image_of, program, real_volume


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def compare(self, name):
        path, lower, thickness, unit = real_volume(name)
        command = [program(), "extract", path, self.folder / "labels.mha", "--lower", lower, "--thickness", thickness]
        command += ["--vectors", self.folder / "vectors.mha", "--quiet"]
        subprocess.run(list(map(str, command)), check=True)
        medial = itk.MedialVoxelImageFilter.New(
            itk.imread(path),
            lower_threshold=lower,
            thickness=thickness,
            use_image_spacing=unit != "voxels",
            generate_vector_distance=True,
        )
        medial.Update()
        outputs = ((medial.GetOutput(), itk.UC, "labels"), (medial.GetVectorDistanceOutput(), itk.Vector[itk.F, 3], "vectors"))
        for image, pixel_type, kind in outputs:
            file_name = f"{kind}.mha"
            written = itk.imread(self.folder / file_name, pixel_type)
            self.assertEqual(itk.array_from_image(image).tobytes(), itk.array_from_image(written).tobytes(), file_name)
            self.assertEqual(list(image.GetSpacing()), list(written.GetSpacing()))
            np.testing.assert_allclose(list(image.GetOrigin()), list(written.GetOrigin()), rtol=1e-12)

    def test_engine(self):
        self.compare("engine")

    def test_cranium(self):
        self.compare("cranium")


class Files(unittest.TestCase):
    def test_nrrd_is_read_and_written_in_pieces(self):
        mask = blobs("int16")
        with tempfile.TemporaryDirectory() as name:
            source, target = (str(pathlib.Path(name) / file) for file in ("in.nrrd", "out.nrrd"))
            itk.imwrite(image_of(mask), source)
            reader = itk.ImageFileReader[itk.Image[itk.SS, 3]].New(file_name=source)
            reader.SetImageIO(itk.StreamingNrrdImageIO.New())
            medial = itk.MedialVoxelImageFilter.New(reader.GetOutput(), thickness=3.0)
            writer = itk.ImageFileWriter.New(medial.GetOutput(), file_name=target)
            writer.SetImageIO(itk.StreamingNrrdImageIO.New())
            writer.SetNumberOfStreamDivisions(5)
            writer.Update()
            expected = itk.medial_voxel_image_filter(mask, thickness=3.0)
            np.testing.assert_array_equal(itk.array_from_image(itk.imread(target)), expected)

    def test_raw_files(self):
        mask = blobs("uint16")
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "in.raw"
            mask.tofile(path)
            image_io = itk.StreamingRawImageIO.New()
            image_io.SetNumberOfDimensions(3)
            for axis, size in enumerate(mask.shape[::-1]):
                image_io.SetDimensions(axis, size)
            image_io.SetComponentType(itk.CommonEnums.IOComponent_USHORT)
            reader = itk.ImageFileReader[itk.Image[itk.US, 3]].New(file_name=str(path))
            reader.SetImageIO(image_io)
            reader.Update()
            np.testing.assert_array_equal(itk.array_view_from_image(reader.GetOutput()), mask)


if __name__ == "__main__":
    unittest.main()
