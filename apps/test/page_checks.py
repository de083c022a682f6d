# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What a browser shows of the page. test_page_view runs these tests with a Python that has Selenium."""

import json
import unittest

import numpy
import volumes
from page_browser import PageBrowser
from test_page_view import PageCase
from test_walls import part, tee


class BrowserTest(PageCase):
    def open(self, page, has_gl=True):
        path = self.folder / "view.html"
        path.write_text(page)
        browser = PageBrowser(path, self.folder, has_gl)
        self.addCleanup(browser.close)
        return browser

    def show(self, *arguments, thickness=3):
        browser = self.open(self.page("--lower", 72, *arguments, thickness=thickness))
        browser.wait("arrived", "-1")
        return browser

    def report(self, *arguments):
        self.page(*arguments, "--report", "r.json")
        return (self.folder / "r.json").read_text()

    def assert_quiet(self, browser):
        """No message, and nothing asked for but the page."""
        self.assertEqual(browser.messages(), [])
        self.assertEqual(browser.requests(), [(self.folder / "view.html").as_uri()])

    def test_shows_the_sheet(self):
        browser = self.show()
        self.assertGreater(int(browser.state()["triangles"]), 1000)
        pixels = browser.pixels()
        spread = pixels.max(axis=2) - pixels.min(axis=2)
        self.assertGreater((spread > 60).mean(), 0.03, "colored pixels")
        self.assertGreater((spread < 30).mean(), 0.3, "background")
        texts = [element.text for element in browser.find("#view-ticks span")]
        self.assertLessEqual({"x", "y", "z"}, set(texts))
        self.assertGreater(sum(text.isdigit() for text in texts), 5)
        self.assertIn("Thickness", browser.find("#view-legend")[0].text)
        self.assertFalse(browser.find("#view-importance")[0].is_displayed(), "nothing to choose")
        self.assert_quiet(browser)

    def test_keys(self):
        browser = self.show("--thin-below", 6)
        before, target = browser.camera()
        pixels = browser.pixels()
        browser.press("\ue014")  # the right arrow
        turned, turned_target = browser.camera()
        self.assertGreater((abs(browser.pixels() - pixels).max(axis=2) > 30).mean(), 0.02, "the picture has changed")
        self.assertGreater(abs(turned - before).max(), 1)
        self.assertEqual(list(turned_target), list(target))
        browser.press("+", "+")
        self.assertLess(self.distance(browser), 0.8 * self.length(turned - target))
        browser.press("\ue013", shift=True)  # the up arrow
        self.assertNotEqual(list(browser.camera()[1]), list(target), "moved")
        browser.press("x")
        self.assertNotEqual(browser.state()["cut"], "")
        cut = float(browser.state()["cut"])
        browser.press("]")
        self.assertGreater(float(browser.state()["cut"]), cut)
        browser.press("x")
        self.assertEqual(browser.state()["cut"], "")
        browser.press("n")
        browser.wait("arrived", "0")
        browser.press("\ue00c")  # Escape
        browser.wait("arrived", "-1")
        self.assertEqual(list(browser.camera()[1]), list(target))
        self.assert_quiet(browser)

    @staticmethod
    def length(vector):
        return float((vector**2).sum() ** 0.5)

    def distance(self, browser):
        position, target = browser.camera()
        return self.length(position - target)

    def test_mouse(self):
        browser = self.show()
        before = browser.camera()[0]
        browser.drag(120, 30)
        self.assertGreater(abs(browser.camera()[0] - before).max(), 1)
        browser.click_view()
        status = browser.find("#view-status")[0].text
        self.assertRegex(status, r"^At [-\d.]+, [-\d.]+, [-\d.]+: (thickness [\d.]+|a rim)")
        self.assert_quiet(browser)

    def test_places(self):
        """The camera looks at the point of the row, and the marks are at its sides."""
        browser = self.show("--thin-below", 6)
        rows = browser.find("tr.place")
        self.assertGreater(len(rows), 0)
        before = browser.camera()
        row = rows[-1]
        self.assertIn(row.get_attribute("data-length"), row.text)
        row.click()
        state = browser.wait("arrived", str(len(rows) - 1))
        self.assertEqual(state["place"], str(len(rows) - 1))
        position, target = browser.camera()
        center = [float(word) for word in row.get_attribute("data-center").split()]
        middle = [29.5, 24.5, 19.5]  # of the volume, which the scene is about
        for at, value in enumerate(center):
            self.assertAlmostEqual(target[at] + middle[at], value, delta=0.01)
        self.assertLess(self.length(position - target), self.length(before[0] - before[1]))
        self.assertIn("minimum", browser.find("#view-status")[0].text)
        browser.driver.execute_script("document.getElementById('view').scrollIntoView()")
        pixels = browser.pixels()
        self.assertGreater((pixels.max(axis=2) < 45).sum(), 50, "marks")
        self.assertEqual([mark.text for mark in browser.find("#view-ticks .mark")], [row.get_attribute("data-length")])
        # A row is reached and chosen by keys alone.
        browser.driver.execute_script("document.querySelector('tr.place button').focus()")
        browser.press_anywhere("\ue007")
        browser.wait("arrived", "0")
        self.assert_quiet(browser)

    def test_keys_work_after_a_click_on_a_row(self):
        browser = self.show("--thin-below", 6)
        browser.find("tr.place")[0].click()
        browser.wait("arrived", "0")
        browser.press_anywhere("x")
        browser.wait_for_frames()
        self.assertNotEqual(browser.state()["cut"], "")
        browser.press_anywhere("\ue00c")  # Escape
        browser.wait("arrived", "-1")

    @staticmethod
    def share_of(pixels, color):
        """Of pixels with the hue of a color, in any light."""
        shades = pixels / numpy.maximum(pixels.max(axis=2, keepdims=True), 1)
        return float((abs(shades - numpy.array(color) / max(color)).max(axis=2) < 0.03).mean())

    def test_colors_tell_the_limits(self):
        """Walls below are vermilion, others green, and in the scale there is neither."""
        below, within, above = (213, 94, 0), (0, 158, 115), (0, 114, 178)
        lengths = json.loads(self.report("--lower", 72))["thickness"]
        limit = lengths["percentiles"]["50"] + 0.01
        for option, outside, other in (("--thin-below", below, above), ("--thick-above", above, below)):
            browser = self.show(option, limit)
            pixels = browser.pixels()
            self.assertGreater(self.share_of(pixels, outside), 0.01, option)
            self.assertGreater(self.share_of(pixels, within), 0.001, option)
            self.assertLess(self.share_of(pixels, other), 0.001, option)
            self.assertIn(f"{limit:.4g}", browser.find("#view-legend")[0].text)
            browser.driver.execute_script(
                "const choice = document.getElementById('view-color'); choice.value = '';"
                "choice.dispatchEvent(new Event('change'))"
            )
            browser.wait_for_frames()
            self.assertLess(self.share_of(browser.pixels(), outside), 0.005, option)
            browser.close()

    def test_rims_have_the_thickness_of_the_nearest_wall(self):
        browser = self.show()
        known, lengths = browser.driver.execute_script(
            "const text = (name) => document.getElementById(name).textContent;"
            "const sheet = MedialVoxelSheet.build(JSON.parse(text('view-data')), text('view-points'));"
            "return [[...sheet.isKnown], [...sheet.thickness]]"
        )
        rims = [length for is_known, length in zip(known, lengths) if is_known == 0]
        walls = [length for is_known, length in zip(known, lengths) if is_known == 1]
        self.assertEqual(len(rims) + len(walls), len(known), "every rim has a wall")
        self.assertGreater(len(rims), 20)
        self.assertGreaterEqual(min(rims), min(walls))
        self.assertLessEqual(max(rims), max(walls))

    def test_the_largest_piece_comes_first(self):
        volume = volumes.Volume((60, 50, 40), [])
        volume.voxels = [
            100 if (5 <= x < 40 and 5 <= y < 45 and 5 <= z < 10) or (50 <= x < 58 and 20 <= y < 36 and 30 <= z < 35) else 0
            for x, y, z in volume.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", volume)
        browser = self.show()
        others = float(browser.state()["others"])
        self.assertGreater(others, 0.02)
        self.assertLess(others, 0.2)
        near = self.distance(browser)
        self.assertIn(f"{100 * others:.1f} %", browser.find("#view-pieces-label")[0].text)
        browser.find("#view-pieces")[0].click()
        browser.wait("arrived", "-1")
        self.assertGreater(self.distance(browser), 1.1 * near)

    def test_screens_of_any_width(self):
        browser = self.show("--thin-below", 6, "--thick-above", 20)
        for width in (1400, 400):
            browser.set_size(width, 900)
            box = lambda name: browser.find(name)[0].rect  # noqa: E731
            self.assertLessEqual(
                browser.driver.execute_script("return document.documentElement.scrollWidth"), width, "no wider than the screen"
            )
            stage, legend = box("#view-stage"), box("#view-legend")
            self.assertGreaterEqual(legend["y"], stage["y"] + stage["height"], "the legend is below")
            parts = [part.rect for part in browser.find("#view-legend > *")]
            for first, second in zip(parts, parts[1:]):
                self.assertTrue(second["y"] > first["y"] + 5 or second["x"] >= first["x"] + first["width"], "they do not touch")
            self.assertLess(box("h1")["y"], 40)
            self.assertLess(box("tr.place")["y"], 700, "places are on the first screen")
            is_beside = box(".places")["x"] + box(".places")["width"] <= stage["x"]
            self.assertEqual(is_beside, width == 1400)
            sheet = browser.pixels()
            colored = numpy.argwhere(sheet.max(axis=2) - sheet.min(axis=2) > 60)
            extent = (colored.max(axis=0) - colored.min(axis=0)) / sheet.shape[:2]
            self.assertGreater(extent.max(), 0.5, "the sheet fills the view")
            browser.wait("arrived", "-1")
            ticks = [tick.rect for tick in browser.find("#view-ticks span")]
            self.assertGreaterEqual(min(tick["x"] for tick in ticks), stage["x"] - 1, "the whole box is seen")
            self.assertLessEqual(max(tick["x"] + tick["width"] for tick in ticks), stage["x"] + stage["width"] + 1)
        self.assert_quiet(browser)

    def test_surface_of_the_part(self):
        """A gray layer over the sheet, whose colors stay visible; by its box and by a key."""
        browser = self.show()
        for width in (1400, 400):
            browser.set_size(width, 900)
            pixels = {}
            for is_on in (False, True):
                self.assertEqual(browser.find("#view-surface")[0].is_selected(), is_on)
                if is_on:
                    browser.wait_for_pixels(lambda seen: not numpy.array_equal(seen, pixels[False]))
                pixels[is_on] = browser.settled_pixels()
                browser.press("s")
            self.assertGreater((abs(pixels[True] - pixels[False]).max(axis=2) > 20).mean(), 0.1, "the surface is drawn")
            spread = {is_on: values.max(axis=2) - values.min(axis=2) for is_on, values in pixels.items()}
            self.assertGreater((spread[True] > 30).mean(), 0.6 * (spread[False] > 30).mean(), "the sheet is seen through it")
            browser.wait_for_pixels(lambda seen: numpy.array_equal(seen, pixels[False]))
        browser.find("#view-surface")[0].click()
        triangles = int(browser.wait("partTriangles")["partTriangles"])
        self.assertGreater(triangles, 1000)
        self.assertLessEqual(triangles, 60000)
        # The surface is where the object is, but for what smoothing moves.
        low, high = browser.driver.execute_script(
            "const text = (name) => document.getElementById(name).textContent;"
            "const data = JSON.parse(text('view-data'));"
            "const sheet = MedialVoxelSheet.build(data, text('view-points'));"
            "const part = MedialVoxelPart.build(data, text('view-part'), sheet).positions;"
            "const x = [...part].filter((_, at) => at % 3 === 0).map((value) => value + sheet.frame.middle[0]);"
            "return [Math.min(...x), Math.max(...x)]"
        )
        objects = [x for (x, _, _), value in zip(self.volume.indices(), self.volume.voxels) if value >= 72]
        self.assertAlmostEqual(low, min(objects) - 0.5, delta=0.3)
        self.assertAlmostEqual(high, max(objects) + 0.5, delta=0.3)
        self.assert_quiet(browser)

    def test_the_slider_shows_the_sheets_of_larger_thicknesses(self):
        volume = volumes.Volume((60, 50, 20), [])
        volume.voxels = [100 if 5 <= x < 55 and 5 <= y < 45 and 7 <= z < 12 else 0 for x, y, z in volume.indices()]
        volumes.write_meta(self.folder / "in.mha", volume)
        browser = self.show("--importance", "i.mha", thickness="auto")
        self.assertTrue(browser.find("#view-importance")[0].is_displayed())
        shares = []
        for thickness in (8, 11, 16):
            browser.driver.execute_script(
                "const data = JSON.parse(document.getElementById('view-data').textContent);"
                "const slider = document.getElementById('view-importance');"
                "slider.value = Math.round(arguments[0] / data.lengthUnit); slider.dispatchEvent(new Event('input'))",
                thickness,
            )
            browser.wait_for_frames()
            self.assertAlmostEqual(float(browser.state()["importance"]), thickness, delta=0.1)
            self.assertEqual(browser.find("#view-importance-text")[0].text.split()[0], browser.state()["importance"])
            pixels = browser.settled_pixels()
            shares.append(((pixels.max(axis=2) - pixels.min(axis=2)) > 60).mean())
        self.assertLess(shares[1], 0.95 * shares[0])
        self.assertLess(shares[2], 0.8 * shares[1])
        self.assertGreater(shares[2], 0.3 * shares[0], "the middle stays")
        self.assert_quiet(browser)

    def test_a_row_shows_its_wall_alone(self):
        volumes.write_meta(self.folder / "in.mha", part(tee))
        browser = self.open(self.page("--wall-table", "w.csv"))
        browser.wait("arrived", "-1")
        rows = browser.find("tr.wall")
        colors = [(230, 25, 75), (60, 180, 75), (67, 99, 216)]
        shares = lambda pixels: [self.share_of(pixels, color) for color in colors]  # noqa: E731

        def wait(is_right):
            def is_shown(pixels):
                # A picture that is taken while the page scrolls after a click may stop it.
                browser.driver.execute_script("document.getElementById('view').scrollIntoView()")
                return is_right(shares(pixels))

            browser.wait_for_pixels(is_shown)

        texts = lambda name: [one.text for one in browser.find(name)]  # noqa: E731
        self.assertEqual(texts("#view-color option"), ["by thickness", "by wall"])
        self.assertIn("Thickness", texts("#view-legend")[0])
        self.assertLess(max(shares(browser.settled_pixels())[::2]), 0.005, "the scale comes first")
        browser.driver.execute_script(
            "const choice = document.getElementById('view-color'); choice.value = 'wall';"
            "choice.dispatchEvent(new Event('change'))"
        )
        browser.wait_for_frames()
        everything = shares(browser.settled_pixels())
        self.assertGreater(min(everything), 0.01)
        self.assertIn("no wall", texts("#view-legend")[0])
        # A row is reached and chosen by keys alone.
        for number, show in enumerate((rows[0].click, lambda: self.choose_by_keys(browser, 1), rows[2].click)):
            show()
            browser.wait("wall", str(number + 1))
            self.assertEqual(rows[number].find_element("tag name", "button").get_attribute("aria-pressed"), "true")
            wait(lambda now, at=number: now[at] > 0.9 * everything[at] and sum(now) - now[at] < 0.002)
        for show_all in (rows[1].click, lambda: browser.press_anywhere("\ue00c")):  # again, Escape
            rows[1].click()
            browser.wait("wall", "2")
            show_all()
            browser.wait("wall", "0")
            wait(lambda now: min(one / before for one, before in zip(now, everything)) > 0.95)
        browser.click_view()
        self.assertRegex(browser.find("#view-status")[0].text, ", wall [123]$")
        self.assert_quiet(browser)

    @staticmethod
    def choose_by_keys(browser, row):
        browser.driver.execute_script(f"document.querySelectorAll('tr.wall button')[{row}].focus()")
        browser.press_anywhere("\ue007")  # Enter

    def test_a_fixed_scale(self):
        browser = self.show("--color-range", "0,40")
        ticks = [tick.text for tick in browser.find("#view-legend .tick")]
        self.assertEqual(ticks, ["0", "10", "20", "30", "40"])

    def test_cut_takes_a_side_away(self):
        browser = self.show()

        def colored():
            pixels = browser.pixels()
            return ((pixels.max(axis=2) - pixels.min(axis=2)) > 60).mean()

        whole = colored()
        browser.press("z", *"[" * 8)
        low = colored()
        self.assertLess(low, 0.9 * whole)
        browser.find("#view-flip")[0].click()
        browser.press("\ue000")
        self.assertNotAlmostEqual(colored(), low, places=3)
        self.assert_quiet(browser)

    def test_without_webgl_the_pictures_stay(self):
        page = self.page("--lower", 72)
        browser = self.open(page, has_gl=False)
        self.assertFalse(browser.find("#view")[0].is_displayed())
        self.assertTrue(browser.find("img")[0].is_displayed())
        self.assertGreater(int(browser.find("img")[0].get_property("naturalWidth")), 400)

    def test_policy_keeps_the_network_out(self):
        """What a page asked for would be seen, and is refused."""
        page = self.page("--lower", 72).replace("</body>", '<img src="https://example.org/x.png"></body>')
        browser = self.open(page)
        browser.wait("arrived", "-1")
        self.assertTrue(any("Content Security Policy" in message for message in browser.messages()))


if __name__ == "__main__":
    unittest.main()
