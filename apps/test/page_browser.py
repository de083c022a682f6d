# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Chromium without a screen, which draws by the processor, and what it says about a page."""

import io
import json
import shutil

import numpy
from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from processes import wait_until

BROWSER = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
ARGUMENTS = ("--headless=new", "--no-sandbox", "--no-first-run", "--window-size=1100,1000")
GL = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SECONDS = 60


class PageBrowser:
    """A page that is open: its messages, requests, picture, and hands on it."""

    def __init__(self, path, folder, has_gl=True):
        options = Options()
        options.binary_location = BROWSER
        for argument in (*ARGUMENTS, *(GL if has_gl else ("--disable-gpu", "--disable-3d-apis"))):
            options.add_argument(argument)
        options.add_argument(f"--user-data-dir={folder / 'browser'}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.driver.set_script_timeout(SECONDS)
        self.driver.get(path.as_uri())

    def set_size(self, width, height):
        """Of the page; below 700 pixels of width as on a phone."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 700}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        self.wait_for_frames()

    def close(self):
        self.driver.quit()

    def find(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def state(self):
        """What the view says of itself."""
        return self.driver.execute_script("return {...document.getElementById('view').dataset}")

    def wait(self, name, value=None):
        """Until the view says that, or says it with this value."""

        def says():
            state = self.state()
            return name in state and value in (None, state[name])

        wait_until(says, f"the view to say {name} = {value}", SECONDS, 0.05)
        self.wait_for_frames()
        return self.state()

    def wait_for_frames(self):
        """Until the page has drawn what it knows of: a frame that it has asked for, and the next one begins."""
        self.driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")

    def camera(self):
        """Position and target."""
        numbers = [float(word) for word in self.state()["camera"].split()]
        return numpy.array(numbers[:3]), numpy.array(numbers[3:])

    def pixels(self, selector="#view-canvas"):
        """The element as it is on the screen."""
        return numpy.asarray(Image.open(io.BytesIO(self.find(selector)[0].screenshot_as_png)).convert("RGB")).astype(int)

    def settled_pixels(self):
        """The view when it no longer changes, without the frame of the focus."""
        seen = []

        def is_settled():
            seen.append(self.pixels()[4:-4, 4:-4])
            # A busy machine draws late.
            return len(seen) > 3 and all(numpy.array_equal(seen[-1], one) for one in seen[-4:-1])

        wait_until(is_settled, "the view to settle", SECONDS, 0.1)
        return seen[-1]

    def wait_for_pixels(self, is_right):
        """Waits until the view is as it should be."""
        wait_until(lambda: is_right(self.pixels()[4:-4, 4:-4]), "the right view", SECONDS, 0.1)

    def press(self, *keys, shift=False):
        """Keys, on the view."""
        self.driver.execute_script("document.getElementById('view-canvas').focus()")
        for key in keys:
            chain = ActionChains(self.driver)
            if shift:
                chain.key_down(Keys.SHIFT)
            chain.send_keys(key)
            if shift:
                chain.key_up(Keys.SHIFT)
            chain.perform()
        self.wait_for_frames()

    def press_anywhere(self, *keys):
        """Keys, on whatever has the focus."""
        ActionChains(self.driver).send_keys(*keys).perform()

    def drag(self, right, down):
        canvas = self.find("#view-canvas")[0]
        ActionChains(self.driver).move_to_element(canvas).click_and_hold().move_by_offset(right, down).release().perform()
        self.wait_for_frames()

    def click_view(self):
        """In the middle."""
        ActionChains(self.driver).move_to_element(self.find("#view-canvas")[0]).click().perform()
        self.wait_for_frames()

    def messages(self):
        """Of the console, those that are no errors too."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """Addresses that the page asked for, but for those within it and of the empty tab."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                addresses.append(message["params"]["request"]["url"])
        return [address for address in addresses if not address.startswith(("data:", "blob:", "chrome:"))]
