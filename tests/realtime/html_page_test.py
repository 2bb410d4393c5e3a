#!/usr/bin/env python3
"""Runs a page of `wold shader --target html` in a headless Chromium and looks at what it draws.

  html_page_test.py WOLD SOURCE_FOLDER

Drives chromedriver by the WebDriver protocol, with the standard library alone.
"""

import base64
import socket
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request
import zlib
from pathlib import Path

WOLD, SOURCE = (sys.argv[1], Path(sys.argv[2])) if len(sys.argv) > 2 else ("wold", Path("."))
SIZE = (128, 72)
# SwiftShader draws with the processor: few steps.
KNOBS = ["LOW_QUALITY=0", "MAX_MARCHING_STEPS=100", "CLOUD_STEPS=16", "CLOUD_LIGHT_STEPS=4",
         "MAX_MARCHING_STEPS_SHADOW=16", "FILTERING_SAMPLES=1"]
LEAST_PSNR = 36.0  # dB, between two drivers: neither's exp and pow are exact
LEAST_PSNR_MAP = 40.0
FLAGS = ["--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--window-size=640,480", "--hide-scrollbars"]


def pixels_of(png):
    """Rows of RGB of an 8-bit PNG."""
    at, packed, head = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    width, height, bits, colour = head[:4]
    assert bits == 8 and colour in (2, 6), head
    channels = 3 if colour == 2 else 4
    raw, rows, before = zlib.decompress(packed), [], bytes(width * channels)
    for y in range(height):
        kind = raw[y * (width * channels + 1)]
        line = bytearray(raw[y * (width * channels + 1) + 1:(y + 1) * (width * channels + 1)])
        for k in range(len(line)):
            left = line[k - channels] if k >= channels else 0
            up = before[k]
            corner = before[k - channels] if k >= channels else 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = up
            elif kind == 3:
                guess = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                guess = min((left, up, corner), key=lambda x: abs(p - x))
            else:
                guess = 0
            line[k] = (line[k] + guess) & 255
        before = bytes(line)
        rows.append([tuple(line[k:k + 3]) for k in range(0, len(line), channels)])
    return rows


def psnr(a, b):
    """dB; pictures of the same size."""
    squares = [(p - q) ** 2 for r, s in zip(a, b) for x, y in zip(r, s) for p, q in zip(x, y)]
    mean = sum(squares) / len(squares)
    return 99.0 if mean == 0 else 10 * math.log10(255 * 255 / mean)


def mean_of(rows):
    values = [sum(pixel) for row in rows for pixel in row]
    return sum(values) / len(values) / 3


class Browser:
    """A session of chromedriver."""

    def __init__(self, profile):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.root = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        options = {"args": FLAGS + [f"--user-data-dir={profile}"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options,
                  "goog:loggingPrefs": {"browser": "ALL"}}
        for attempt in range(100):
            try:
                answer = self.call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
                break
            except (ConnectionError, urllib.error.URLError):
                if attempt == 99:
                    raise
                time.sleep(0.1)
        self.session = "/session/" + answer["sessionId"]

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.root + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.loads(answer.read())["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(f"{path}: {error.read().decode()[:400]}") from error

    def open(self, url):
        self.call("POST", self.session + "/url", {"url": url})

    def run(self, script, *arguments):
        return self.call("POST", self.session + "/execute/sync",
                         {"script": script, "args": list(arguments)})

    def press(self, key, seconds):
        def keys(kind):
            return {"actions": [{"type": "key", "id": "keyboard",
                                 "actions": [{"type": kind, "value": key}]}]}
        self.call("POST", self.session + "/actions", keys("keyDown"))
        time.sleep(seconds)
        self.call("POST", self.session + "/actions", keys("keyUp"))

    def devtools(self, command, **parameters):
        return self.call("POST", self.session + "/goog/cdp/execute",
                         {"cmd": command, "params": parameters})

    def fingers(self, kind, *places):
        self.devtools("Input.dispatchTouchEvent", type=kind,
                      touchPoints=[{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(places)])

    def complaints(self):
        log = self.call("POST", self.session + "/se/log", {"type": "browser"})
        return [entry["message"] for entry in log if entry["level"] in ("SEVERE", "ERROR")]

    def wait(self, script, seconds=25):
        end = time.time() + seconds
        while time.time() < end:
            value = self.run(script)
            if value:
                return value
            time.sleep(0.1)
        raise AssertionError(f"waited {seconds} s for {script}")

    def picture(self):
        """What the canvas shows, once it is drawn anew."""
        frames = self.run("wake(); return landscape.frames")
        self.wait(f"return landscape.frames > {frames}")
        text = self.run("return document.getElementById('view').toDataURL('image/png')")
        return pixels_of(base64.b64decode(text.split(",")[1]))

    def close(self):
        try:
            self.call("DELETE", self.session)
        finally:
            self.driver.terminate()
            self.driver.wait(20)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("chromedriver"):
            raise AssertionError("chromedriver is missing: tools/install_dependencies test")
        cls.folder = Path(tempfile.mkdtemp(prefix="wold_page_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, True)
        cls.page, cls.drawn = cls.export("scenes/mountains.toml")
        cls.browser = Browser(cls.folder / "profile")
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def export(cls, scene, *more):
        page, drawn = cls.folder / "page.html", cls.folder / "page.png"
        command = [WOLD, "shader", str(SOURCE / scene), "--target", "html", "-o", str(page),
                   "--screenshot", str(drawn), "--size", "%dx%d" % SIZE, "--samples", "1",
                   "--quiet", *more]
        for knob in KNOBS:
            command += ["--define", knob]
        subprocess.run(command, check=True, timeout=300)
        return page, pixels_of(drawn.read_bytes())

    def show(self, page, wishes="paused=1"):
        self.browser.open("about:blank")
        self.browser.open(page.as_uri() + "#size=%dx%d&%s" % (*SIZE, wishes))
        self.browser.wait("return landscape.ready || landscape.error")
        self.assertEqual(self.browser.run("return landscape.error"), "")

    def test_needs_no_network(self):
        text = self.page.read_text()
        for word in ("http:", "https:", "src=", "@import"):
            self.assertNotIn(word, text)

    def test_draws_what_the_program_draws(self):
        self.show(self.page)
        rows = self.browser.picture()
        top, bottom = mean_of(rows[:12]), mean_of(rows[-12:])
        self.assertGreater(top, 60)
        self.assertGreater(bottom, 20)
        sky = [sum(c) / len(c) for c in zip(*(p for row in rows[:6] for p in row))]
        self.assertGreater(sky[2], sky[0])  # blue above
        likeness = psnr(rows, self.drawn)
        print(f"page against program: {likeness:.1f} dB")
        self.assertGreater(likeness, LEAST_PSNR)
        self.assertEqual(self.browser.complaints(), [])

    def test_keys_move_and_sliders_change(self):
        self.show(self.page)
        before = self.browser.picture()
        here = self.browser.run("return [landscape.east, landscape.north]")
        self.browser.press("w", 0.6)
        there = self.browser.run("return [landscape.east, landscape.north]")
        moved = math.dist(here, there)
        self.assertGreater(moved, 10)
        self.assertLess(psnr(before, self.browser.picture()), 35)

        self.browser.run("Object.assign(landscape, {east: arguments[0], north: arguments[1]})", *here)
        lit = self.browser.picture()
        self.browser.run("""
            const input = document.getElementById('knob_sun_elevation');
            input.value = 3;
            input.dispatchEvent(new Event('input'));""")
        evening = self.browser.picture()
        self.assertLess(psnr(lit, evening), 30)
        self.assertEqual(self.browser.complaints(), [])

    def test_flies_by_itself_and_stops(self):
        self.show(self.page, "quality=low")
        here = self.browser.run("return landscape.time")
        self.browser.wait(f"return landscape.time > {here} + 0.2")
        self.browser.press(" ", 0.05)
        self.assertFalse(self.browser.run("return landscape.flying"))
        self.assertEqual(self.browser.complaints(), [])

    def test_help_and_panel_open(self):
        self.show(self.page)
        self.browser.press("h", 0.05)
        self.assertTrue(self.browser.run("return document.getElementById('help').open"))
        self.browser.press("h", 0.05)
        self.assertFalse(self.browser.run("return document.getElementById('help').open"))
        self.browser.press("p", 0.05)
        self.assertFalse(self.browser.run("return document.getElementById('panel').hidden"))

    def test_a_link_shows_the_same_view(self):
        self.show(self.page)
        self.browser.run("""
            landscape.azimuth += 40; landscape.tilt = -9; landscape.over = 420;
            landscape.knobs.sun_elevation = 7;""")
        before = self.browser.picture()
        link = self.browser.run("return linkHere()")
        for part in ("azimuth=", "tilt=-9", "over=420", "sun_elevation=7", "paused=1"):
            self.assertIn(part, link)
        self.browser.open("about:blank")
        self.browser.open(link)
        self.browser.wait("return landscape.ready || landscape.error")
        self.assertGreater(psnr(before, self.browser.picture()), 40)
        self.browser.press("l", 0.05)
        self.browser.wait("return location.hash.includes('sun_elevation=7')")

    def test_fingers_look_and_move(self):
        self.show(self.page, "paused=1&quality=low")
        self.browser.devtools("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        before = self.browser.run("return [landscape.azimuth, landscape.tilt]")
        self.browser.fingers("touchStart", (300, 200))
        self.browser.fingers("touchMove", (240, 230))
        self.browser.fingers("touchEnd")
        after = self.browser.run("return [landscape.azimuth, landscape.tilt]")
        self.assertGreater(after[0], before[0] + 1)  # the land follows the finger
        self.assertGreater(after[1], before[1] + 1)
        here = self.browser.run("return [landscape.east, landscape.north]")
        self.browser.fingers("touchStart", (250, 200), (350, 200))
        self.browser.fingers("touchMove", (250, 260), (350, 260))
        self.browser.fingers("touchEnd")
        there = self.browser.run("return [landscape.east, landscape.north]")
        self.assertGreater(math.dist(here, there), 10)
        self.assertEqual(self.browser.run("return fingers.size"), 0)
        self.browser.devtools("Emulation.setTouchEmulationEnabled", enabled=False)
        self.assertEqual(self.browser.complaints(), [])

    def test_resolution_follows_window_and_load(self):
        self.browser.open("about:blank")
        self.browser.devtools("Emulation.setDeviceMetricsOverride", width=320, height=240,
                              deviceScaleFactor=1, mobile=True)
        self.browser.open(self.page.as_uri() + "#quality=low")
        self.browser.wait("return landscape.ready || landscape.error")
        self.browser.wait("return landscape.scale < 0.3")  # a processor draws: too slow for all
        size = "return [document.getElementById('view').width, document.getElementById('view').height]"
        for width, height in ((390, 300), (300, 390)):
            self.browser.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height,
                                  deviceScaleFactor=2, mobile=True)
            self.browser.wait("return innerWidth == %d" % width)
            self.browser.wait("const c = document.getElementById('view');"
                              "return Math.abs(c.width / c.height - %f) < 0.06" % (width / height))
        self.browser.devtools("Emulation.clearDeviceMetricsOverride")
        self.browser.press(" ", 0.05)
        low = self.browser.run("return landscape.scale")
        # Quick frames bring it back, up to what was too much before; later beyond. All in one
        # script: between two, the page may draw a frame of its own, whose time counts as well.
        quick, limited, free, slow = self.browser.run("""
            const after = (milliseconds) => {
              for (let k = 0; k < 300; ++k) { landscape.frames = 12 * k; adapt(milliseconds); }
              return landscape.scale;
            };
            mean = 8; slow = 0; ceiling = 0.6; retry = performance.now() + 1e6;
            const scales = [after(8), after(8)];
            mean = 8; retry = 0;
            return scales.concat(after(8), after(60));""")
        self.assertGreater(quick, low)
        self.assertAlmostEqual(limited, max(0.6, low), delta=0.02)
        self.assertEqual(free, 1)
        self.assertLess(slow, 0.2)
        self.assertGreater(self.browser.run(size)[0], 0)

    def test_lost_context_comes_back(self):
        self.show(self.page)
        before = self.browser.picture()
        self.browser.run("""
            window.lose = gl.getExtension('WEBGL_lose_context');
            lose.loseContext();""")
        self.browser.wait("return !landscape.ready && !document.getElementById('message').hidden")
        self.browser.run("lose.restoreContext()")
        self.browser.wait("return landscape.ready")
        self.assertGreater(psnr(before, self.browser.picture()), 45)

    def test_a_shader_that_fails_says_so(self):
        broken = self.folder / "broken.html"
        broken.write_text(self.page.read_text().replace("void mainImage(", "void mainImage(nonsense ", 1))
        self.browser.open(broken.as_uri())
        self.browser.wait("return landscape.error")
        self.assertIn("nonsense", self.browser.run("return document.getElementById('details').textContent"))
        self.browser.complaints()

    def test_land_as_a_map(self):
        page, drawn = self.export("scenes/mountains.toml", "--terrain", "map",
                                  "--set", "terrain.resolution=257")
        self.show(page)
        likeness = psnr(self.browser.picture(), drawn)
        print(f"map: {likeness:.1f} dB")
        self.assertGreater(likeness, LEAST_PSNR_MAP)
        self.assertEqual(self.browser.complaints(), [])

    def test_land_with_water_covers_and_trees(self):
        scene = self.folder / "wet.toml"
        scene.write_text("""
            seed = 4
            [terrain]
            size = 3000
            resolution = 129
            [[terrain.step]]
            op = "fbm"
            height = 260
            feature_size = 1400
            [[terrain.step]]
            name = "flood"
            op = "pipes"
            rain = 300
            duration = 2
            [water]
            depth = "flood.water"
            least_depth = 0.3
            [[cover]]
            map = "flood.water"
            range = [0.1, 1000]
            feather = 0.1
            [[species]]
            name = "oak"
            plant = "plants/oak.lsys"
            height = [9, 14]
            [[scatter]]
            density = 0.01
            clumping = 0.8
            clump_size = 200
        """)
        page, drawn = self.export(scene)
        for part in ("water", "covers", "trees"):
            self.assertIn('"%s":' % part, page.read_text())
        self.show(page)
        likeness = psnr(self.browser.picture(), drawn)
        print(f"water, covers, trees: {likeness:.1f} dB")
        self.assertGreater(likeness, LEAST_PSNR_MAP)
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    os.environ.pop("DISPLAY", None)
    unittest.main(argv=sys.argv[:1], verbosity=2)
