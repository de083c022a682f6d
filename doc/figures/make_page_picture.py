#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Takes a picture of the view of a page: the whole sheet, and a place of the table beside it (needs Chromium).

Usage: doc/figures/make_page_picture.py PAGE.html OUTPUT.png [--place NUMBER]
scripts/install-packages browser installs what it needs.
"""

import argparse
import io
import pathlib
import sys
import tempfile

from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "apps/test"))
from page_browser import PageBrowser  # noqa: E402

GAP = 12


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--place", type=int, default=1, help="row of the table, from 1")
    return parser.parse_args()


def take_picture(browser):
    stage = browser.find("#view-stage")[0]
    return Image.open(io.BytesIO(stage.screenshot_as_png)).convert("RGB")


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        browser = PageBrowser(arguments.page.resolve(), pathlib.Path(folder))
        browser.wait("arrived", "-1")
        pictures = [take_picture(browser)]
        browser.press(*"n" * arguments.place)
        browser.wait("arrived", str(arguments.place - 1))
        pictures.append(take_picture(browser))
        browser.close()
    pictures = [picture.resize((picture.width // 2, picture.height // 2), Image.LANCZOS) for picture in pictures]
    width, height = pictures[0].size
    both = Image.new("RGB", (2 * width + GAP, height), "white")
    both.paste(pictures[0], (0, 0))
    both.paste(pictures[1], (width + GAP, 0))
    both.save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
