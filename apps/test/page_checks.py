# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What a browser shows of the page. test_page_view runs these tests with a Python that has Selenium."""

import unittest

from page_browser import PageBrowser
from test_page_view import PageCase


class BrowserTest(PageCase):
    def open(self, page, has_gl=True):
        path = self.folder / "view.html"
        path.write_text(page)
        browser = PageBrowser(path, self.folder, has_gl)
        self.addCleanup(browser.close)
        return browser

    def show(self, *arguments):
        browser = self.open(self.page("--lower", 72, *arguments))
        browser.wait("arrived", "-1")
        return browser

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
        self.assertIn("thickness", browser.find("#view-legend")[0].text)
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
        red = (pixels[:, :, 0] > 180) & (pixels[:, :, 1:].max(axis=2) < 70)
        self.assertGreater(red.sum(), 50, "marks")
        self.assertEqual([mark.text for mark in browser.find("#view-ticks .mark")], [row.get_attribute("data-length")])
        # A row is reached and chosen by keys alone.
        browser.driver.execute_script("document.querySelector('tr.place button').focus()")
        browser.press_anywhere("\ue007")
        browser.wait("arrived", "0")
        self.assert_quiet(browser)

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
