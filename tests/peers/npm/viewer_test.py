#!/usr/bin/env python3
"""A browser without a network plays the moving scene of a report page.
Usage: viewer_test.py PEDICEL SCENE VIEWER_FILE"""
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

SKIPPED = 77
ROOT = pathlib.Path(__file__).resolve().parents[3]


def skip(why):
    print("skipped:", why)
    sys.exit(SKIPPED)


class Browser:
    """Chromium by WebDriver's protocol."""

    def __init__(self, folder):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], start_new_session=True, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        self.base = f"http://127.0.0.1:{port}"
        # No name is found, so nothing can come from outside.
        options = {"binary": shutil.which("chromium"),
                   "args": ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                            "--enable-unsafe-swiftshader", "--window-size=900,1200", f"--user-data-dir={folder}",
                            "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1"]}
        end = time.monotonic() + 20
        while True:
            try:
                made = self.call("/session", {"capabilities": {"alwaysMatch": {"goog:chromeOptions": options}}})
                break
            except (urllib.error.URLError, ConnectionError):
                if time.monotonic() > end:
                    raise
                time.sleep(0.2)
        self.base += "/session/" + made["sessionId"]

    def call(self, path, body):
        request = urllib.request.Request(self.base + path, json.dumps(body).encode(),
                                         {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)["value"]

    def run(self, script):
        return self.call("/execute/sync", {"script": script, "args": []})

    def close(self):
        """The session, then the driver and what it started: a browser that stays takes a core."""
        try:
            urllib.request.urlopen(urllib.request.Request(self.base, method="DELETE"), timeout=20)
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            pass
        os.killpg(self.driver.pid, signal.SIGKILL)
        self.driver.wait(10)


def wait_for(browser, script, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if browser.run(script):
            return True
        time.sleep(0.3)
    return False


def main(program, scene, viewer):
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        skip("chromium and chromium-driver are not installed (tools/packages-ci.txt)")
    fetched = subprocess.run([ROOT / "tools/viewer", viewer], stderr=subprocess.PIPE, text=True, timeout=120)
    if fetched.returncode == SKIPPED:
        skip(fetched.stderr.strip())
    assert fetched.returncode == 0, fetched.stderr
    with tempfile.TemporaryDirectory() as out:
        out = pathlib.Path(out)
        run = [program, scene, "--headless", "--steps", "120", "--no-pictures", "--no-sweep", "--quiet"]
        without = subprocess.run([*run, "--out", out / "plain", "--gltf", out / "plain.glb"],
                                 env=os.environ | {"PEDICEL_VIEWER": "/nowhere"}, timeout=60)
        assert without.returncode in (0, 5)
        if not (ROOT / "build/viewer/model-viewer.js").exists():
            assert "the viewer is not there" in (out / "plain/report.html").read_text()
        subprocess.run([*run, "--out", out / "run", "--gltf", out / "run.glb"],
                       env=os.environ | {"PEDICEL_VIEWER": viewer}, timeout=60)
        browser = Browser(out / "profile")
        try:
            browser.call("/url", {"url": (out / "run/report.html").as_uri()})
            view = "document.querySelector('model-viewer')"
            assert wait_for(browser, f"return {view} && {view}.loaded === true", 60), "the scene is not loaded"
            assert browser.run(f"return {view}.availableAnimations.length") == 1
            assert abs(browser.run(f"return {view}.duration") - 0.5) < 0.05, "0.5 s were simulated"
            first = browser.run(f"return {view}.currentTime")
            assert wait_for(browser, f"return {view}.currentTime != {first}", 20), "it does not move"
            size = browser.run(f"const d = {view}.getDimensions(); return [d.x, d.y, d.z]")
            assert all(0.1 < one < 10 for one in size), size
            # The picture is not one colour only.
            colours = browser.run(
                f"return new Promise(done => {view}.toBlob().then(createImageBitmap).then(picture => {{"
                "const c = document.createElement('canvas'); c.width = picture.width; c.height = picture.height;"
                "const g = c.getContext('2d'); g.drawImage(picture, 0, 0);"
                "const all = new Set(), d = g.getImageData(0, 0, c.width, c.height).data;"
                "for (let i = 0; i < d.length; i += 4) all.add((d[i] << 16) | (d[i + 1] << 8) | d[i + 2]);"
                "done(all.size)}))")
            assert colours > 50, f"{colours} colours"
            asked = browser.run("return performance.getEntriesByType('resource').map(e => e.name)"
                                ".filter(n => n.startsWith('http'))")
            assert asked == [], asked
        finally:
            browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
