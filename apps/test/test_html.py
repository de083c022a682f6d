# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The page: it needs nothing beside itself, has the same bytes for any division, and a browser shows it."""

import base64
import html.parser
import json
import re
import shutil
import subprocess
import unittest

import volumes
from program import ProgramTestCase

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
RUN = re.compile(r'<section id="run">.*</section>', re.DOTALL)

# Fails on whatever the page wants to have from elsewhere, and tells how large its parts came out.
PROBE = """<script>
window.addEventListener("load", () => {
  const image = document.querySelector("img"), chart = document.querySelector("svg");
  document.title = ["loaded", image.naturalWidth, chart ? chart.getBoundingClientRect().height : 0,
    document.documentElement.scrollWidth <= window.innerWidth, performance.getEntriesByType("resource")
    .filter(entry => !entry.name.startsWith("data:")).length].join(" ");
});
window.addEventListener("error", event => { document.title = "error " + event.message; });
</script>"""


class Page(html.parser.HTMLParser):
    """Checks that all elements are closed; collects attributes and text."""

    VOID = {"meta", "img", "rect", "line", "input"}

    def __init__(self, text):
        super().__init__()
        self.open, self.attributes, self.words = [], [], ""
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, *attribute) for attribute in attributes]
        if tag not in {"meta", "img", "input"}:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.attributes += [(tag, *attribute) for attribute in attributes]

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        self.words += data


class HtmlTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(size=(60, 50, 40))
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def page(self, *arguments, source="in.mha"):
        self.extract(source, "out.mha", "--html", "r.html", "--overwrite", *arguments)
        return (self.folder / "r.html").read_text(errors="replace")

    def test_contents(self):
        text = self.page("--lower", 72, "--preview", "p.png")
        page = Page(text)
        for words in (
            "Walls of in.mha",
            "Thickness by area",
            "geodesic search: not medial",
            "ITK",
            "Michikawa and H. Suzuki",
            "peak memory",
            "60 x 50 x 40",
        ):
            self.assertIn(words, page.words)
        source = next(value for tag, name, value in page.attributes if (tag, name) == ("img", "src"))
        kind, data = source.split(",", 1)
        self.assertEqual(kind, "data:image/png;base64")
        self.assertEqual(base64.b64decode(data, validate=True), (self.folder / "p.png").read_bytes())

    def test_tells_limits_date_and_command(self):
        self.run_program("extract", "in.mha", "out.mha", "--html", "r.html", "--lower", 72, "--min-thickness", 2)
        text = (self.folder / "r.html").read_text()
        words = Page(text).words
        for name, value in (("thinner walls count as", "2"), ("maximum thickness", "16"), ("largest pores left out", "32 voxels")):
            self.assertRegex(text, f'{name}</th><td class="text">{value}</td>')
        self.assertIn("medialvoxel extract in.mha out.mha --html r.html --lower 72 --min-thickness 2", words)
        self.assertRegex(RUN.search(text)[0], r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d")
        self.assertIn("in voxels", words)
        self.assertNotIn("thinner walls count as", Page(self.page("--lower", 72)).words)

    def headline(self, *arguments, source="in.mha"):
        return re.search("<h1>(.*)</h1>", self.page(*arguments, "--report", "r.json", source=source))[1]

    def test_the_first_line_is_the_result(self):
        """Against the report."""
        found = self.headline("--lower", 72, "--thin-below", 6, "--thick-above", 50)
        report = json.loads((self.folder / "r.json").read_text())
        walls, thin = report["thickness"], report["places"]["thin"]
        share = 100 * thin["area_beyond_limit"] / walls["area"]
        self.assertGreater(thin["number"], 0)
        self.assertEqual(
            found,
            f"in.mha: walls {walls['minimum']:.3g} to {walls['maximum']:.3g}, median {walls['percentiles']['50']:.3g}; "
            f"{thin['number']} place{'s' * (thin['number'] > 1)} below 6, {share:.2f} % of the area; no place above 50",
        )

    def test_the_first_line_tells_what_is_missing(self):
        self.assertEqual(self.headline("--lower", 30000), "in.mha: no object, as no voxel passes the threshold")
        ball = volumes.Volume((16, 16, 16), [])
        ball.voxels = [1 if sum((i - 7.5) ** 2 for i in index) < 25 else 0 for index in ball.indices()]
        volumes.write_meta(self.folder / "ball.mha", ball)
        self.assertEqual(self.headline(source="ball.mha"), "ball.mha: a sheet, but no wall could be measured")
        self.extract("ball.mha", "o.mha", "--html", "b.html", thickness=12)
        self.assertIn("<h1>ball.mha: no sheet, as the object has no walls</h1>", (self.folder / "b.html").read_text())

    def test_the_result_comes_before_all_else(self):
        page = self.page("--lower", 72, "--thin-below", 6)
        order = ["<h1>", "below 6</h2>", 'class="place"', "Thickness by area</h2>", "geodesic search: medial"]
        self.assertEqual(order, sorted(order, key=page.index))
        self.assertLess(page.index("geodesic"), page.index('<section id="run">'))
        shown = re.sub("<(script|details).*?</(script|details)>", "", page, flags=re.DOTALL)
        self.assertNotIn("geodesic", shown)
        text = re.sub(r"base64,[^\"]*", "", page.split("<script")[0])
        self.assertNotRegex(text, r"\de\+\d")

    def test_needs_nothing_from_elsewhere(self):
        text = self.page("--lower", 72)
        # What the view is drawn with names its sources; test_page_view.py looks at what a browser asks for.
        own = re.sub(r"<script>.*?</script>|<pre>Format.*?</pre>", "", text, flags=re.DOTALL)
        self.assertNotRegex(own, r"https?:|//[a-z]+\.|@import|url\(|<script [^>]*src|<link|<iframe")
        for tag, name, value in Page(text).attributes:
            if name in ("src", "href", "srcset", "data", "action"):
                self.assertTrue(value.startswith("data:"), (tag, name))

    def test_picture_of_the_page_without_a_preview_of_its_own(self):
        self.assertEqual(
            RUN.sub("", self.page("--lower", 72)), RUN.sub("", self.page("--lower", 72, "--preview", "p.png"))
        )

    def test_page_and_picture_without_labels(self):
        """They are those of a run with labels, and nothing else is left in the folder."""
        outputs = ["--lower", 50, "--html", "a.html", "--preview", "a.png"]
        self.run_program("extract", "in.mha", "out.mha", *outputs)
        with_labels = [RUN.sub("", (self.folder / "a.html").read_text()), (self.folder / "a.png").read_bytes()]
        for name in ("out.mha", "a.html", "a.png"):
            (self.folder / name).unlink()
        before = {path.name for path in self.folder.iterdir()}
        self.run_program("extract", "in.mha", *outputs)
        self.assertEqual({path.name for path in self.folder.iterdir()} - before, {"a.html", "a.png"})
        page = (self.folder / "a.html").read_text()
        self.assertEqual(RUN.sub("", page).replace("extract in.mha", "extract in.mha out.mha"), with_labels[0])
        self.assertEqual((self.folder / "a.png").read_bytes(), with_labels[1])
        self.run_program("extract", "in.mha", "--labels", "all", "--html", "b.html", "--preview", "b.png")

    def test_division_and_threads_do_not_change_it(self):
        whole = RUN.sub("", self.page("--lower", 72, "--threads", 1))
        self.assertEqual(RUN.sub("", self.page("--lower", 72, "--threads", 4, "--divisions", 7)), whole)
        self.assertEqual(RUN.sub("", self.page("--lower", 72, "--divisions", 40, "--distance", "d.mha")), whole)

    def test_names_and_volumes_that_are_unusual(self):
        (self.folder / "in.mha").rename(self.folder / 'a <b> & "c".mha')
        page = Page(self.page(source='a <b> & "c".mha'))
        self.assertIn('a <b> & "c".mha', page.words)
        flat = volumes.Volume((30, 30), [])
        flat.voxels = [1 if 10 <= y < 14 else 0 for _, y in flat.indices()]
        volumes.write_meta(self.folder / "flat.mha", flat)
        self.assertIn("mean", Page(self.page(source="flat.mha")).words)
        empty = volumes.Volume((9, 8, 7), [0] * 504)
        volumes.write_meta(self.folder / "empty.mha", empty)
        self.assertIn("No medial cells", Page(self.page(source="empty.mha")).words)

    def test_extension(self):
        self.assert_fails(
            2, ["r.txt", "unknown format", ".html"], "extract", "in.mha", "o.mha", "--thickness", 3, "--html", "r.txt"
        )

    @unittest.skipUnless(BROWSER, "Chromium is not installed: the page is not shown in a browser")
    def test_browser_shows_it(self):
        page = self.page("--lower", 72)
        path = self.folder / "probe.html"
        path.write_text(page.replace("</head>", PROBE + "</head>"))
        browser = [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-3d-apis", "--no-first-run", "--window-size=1100,2000",
            f"--user-data-dir={self.folder / 'browser'}", "--enable-logging=stderr", "--v=0",
            "--host-resolver-rules=MAP * ~NOTFOUND",
        ]  # fmt: skip
        result = subprocess.run(
            [*browser, "--dump-dom", path.as_uri()], capture_output=True, text=True, timeout=120, check=True
        )
        loaded = re.search(r"<title>loaded (\d+) ([\d.]+) (\w+) (\d+)</title>", result.stdout)
        self.assertIsNotNone(loaded, result.stdout[:500] + result.stderr)
        self.assertGreater(int(loaded[1]), 400, "width of the picture")
        self.assertGreater(float(loaded[2]), 100, "height of the histogram")
        self.assertEqual(loaded[3], "true", "the page is not wider than the window")
        self.assertEqual(loaded[4], "0", "resources from elsewhere")
        self.assertNotIn("CONSOLE", result.stderr)
        path.write_text(path.read_text().replace("</body>", '<img src="missing.png"><script>nothing()</script></body>'))
        planted = subprocess.run(
            [*browser, "--dump-dom", path.as_uri()], capture_output=True, text=True, timeout=120, check=True
        )
        self.assertIn("CONSOLE", planted.stderr, "errors of a page are seen")
        screenshot = self.folder / "page.png"
        path.write_text(page)
        subprocess.run(
            [*browser, f"--screenshot={screenshot}", path.as_uri()], capture_output=True, timeout=120, check=True
        )
        self.assertGreater(screenshot.stat().st_size, 20000)


if __name__ == "__main__":
    unittest.main()
