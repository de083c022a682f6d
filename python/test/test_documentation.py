# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Examples in docstrings run, and everything public is typed and described."""

import dataclasses
import doctest
import inspect
import pathlib
import re
import typing
import unittest

import medialvoxel


class Documentation(unittest.TestCase):
    def test_examples(self):
        for module in (medialvoxel, medialvoxel._arrays):
            failed, attempted = doctest.testmod(module, extraglobs={name: getattr(medialvoxel, name) for name in medialvoxel.__all__})
            self.assertEqual(failed, 0)
            self.assertGreater(attempted, 0)

    def test_every_name_is_described_and_typed(self):
        for name in medialvoxel.__all__:
            with self.subTest(name):
                public = getattr(medialvoxel, name)
                self.assertTrue(inspect.getdoc(public))
                self.assertTrue(typing.get_type_hints(public))
        self.assertTrue((pathlib.Path(medialvoxel.__file__).parent / "py.typed").exists())

    def test_every_parameter_is_described(self):
        for function in filter(inspect.isfunction, map(medialvoxel.__dict__.get, medialvoxel.__all__)):
            described = re.findall(r"^(?:\*\*)?(\w+) : (?:.*\n)(    .+)", inspect.getdoc(function), re.MULTILINE)
            self.assertEqual([name for name, _ in described], list(inspect.signature(function).parameters))

    def test_every_attribute_is_described(self):
        for result in filter(dataclasses.is_dataclass, map(medialvoxel.__dict__.get, medialvoxel.__all__)):
            described = ", ".join(re.findall(r"^(\w.*) : ", inspect.getdoc(result), re.MULTILINE)).split(", ")
            self.assertCountEqual(described, [field.name for field in dataclasses.fields(result)])


if __name__ == "__main__":
    unittest.main()
