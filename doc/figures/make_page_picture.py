#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Takes a picture of the top of a page, in colors of the thickness (needs Chromium).

Usage: doc/figures/make_page_picture.py PAGE.html OUTPUT.png
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

WIDTH, HEIGHT = 1400, 840
COLORS = 256
BY_THICKNESS = """const choice = document.getElementById("view-color");
choice.value = "";
choice.dispatchEvent(new Event("change"));
document.getElementById("view-whole").click();"""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory() as folder:
        browser = PageBrowser(arguments.page.resolve(), pathlib.Path(folder))
        browser.wait("arrived", "-1")
        browser.driver.execute_cdp_cmd("Emulation.setScrollbarsHidden", {"hidden": True})
        browser.set_size(WIDTH, HEIGHT)
        browser.driver.execute_script(BY_THICKNESS)
        browser.wait("arrived", "-1")
        picture = Image.open(io.BytesIO(browser.driver.get_screenshot_as_png())).convert("RGB")
        browser.close()
    palette = picture.quantize(COLORS, Image.Quantize.MAXCOVERAGE, kmeans=3)
    picture.quantize(palette=palette).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
