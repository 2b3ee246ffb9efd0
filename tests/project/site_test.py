#!/usr/bin/env python3
"""site_test.py SOURCE_FOLDER: the site is built and looked at in headless Chromium: every link between its pages leads to a page or
file and an anchor that is there, no page is wider than its window (1280 and 390 pixels), and the search finds what it should."""
import functools
import html.parser
import http.server
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.parse

PHONE, DESK = (390, 844), (1280, 900)
LOOKED_AT = ["", "docs/", "docs/reference/lbm/", "docs/results/chapter_4_samples/", "docs/analysis/criteria/", "input_scripts/03_fluidisation/", "docs/hard_cases/"]
SEARCHES = (("liquefaction", "stress-servo"), ("eroded_mass", "reference/lbm"), ("Kenney", "analysis/criteria"))


class Page(html.parser.HTMLParser):
    """Targets of links and images, and the names that others may link to."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.anchors |= {attrs[name] for name in ("id", "name") if name in attrs}
        for name in ("href", "src"):
            if attrs.get(name):
                self.targets.append(attrs[name])


def broken_links(site):
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}
    wrong, followed = [], 0
    for path, page in pages.items():
        if path.name == "404.html":
            continue  # its links begin at the site's root
        for target in page.targets:
            if urllib.parse.urlsplit(target).scheme or target.startswith("//"):
                continue
            name, _, anchor = urllib.parse.unquote(target).partition("#")
            name = name.partition("?")[0]
            file = (path.parent / name).resolve() if name else path
            if file.is_dir():
                file = file / "index.html"
            followed += 1
            if not file.exists():
                wrong.append(f"{path.relative_to(site)}: {target}")
            elif file in pages and anchor and anchor not in pages[file].anchors:
                wrong.append(f"{path.relative_to(site)}: no anchor {target}")
    return wrong, followed


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words):
        pass


def browser():
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(word)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def too_wide(driver, address, size):
    """By how many pixels the page is wider than the window, which is that of a phone by the browser's own emulation."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": size == PHONE})
    driver.get(address)
    return driver.execute_script("return document.documentElement.scrollWidth - window.innerWidth")


def search_finds(driver, address, word, page):
    """Types a word into the page's search as a reader does, and waits for what it offers."""
    from selenium.webdriver.support.ui import WebDriverWait

    driver.get(address)
    driver.execute_script("document.querySelector('#__search').checked = true")
    field = driver.find_element("css selector", "input.md-search__input")
    field.send_keys(word)
    offered = "a.md-search-result__link"
    WebDriverWait(driver, 60).until(lambda d: d.find_elements("css selector", offered))
    found = [link.get_attribute("href") for link in driver.find_elements("css selector", offered)]
    return any(page in target for target in found), found[:5]


def main():
    source = pathlib.Path(sys.argv[1])
    if not all(shutil.which(name) for name in ("mkdocs", "chromium", "chromedriver")):
        print("no MkDocs or Chromium here: scripts/install_packages site")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        site = pathlib.Path(name).resolve() / "html"
        subprocess.run(["/usr/bin/python3", source / "scripts/make_site", "--output", site], check=True)
        amiss, followed = broken_links(site)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(QuietHandler, directory=str(site)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_address[1]}/"
        driver = browser()
        try:
            for size in (DESK, PHONE):
                for page in LOOKED_AT:
                    excess = too_wide(driver, address + page, size)
                    if excess > 1:
                        amiss.append(f"{page or 'first page'} is {excess} pixels wider than {size[0]}")
                if os.environ.get("SITE_PICTURES"):
                    driver.save_screenshot(f"{os.environ['SITE_PICTURES']}/{size[0]}.png")
            for word, page in SEARCHES:
                there, found = search_finds(driver, address, word, page)
                if not there:
                    amiss.append(f"search for {word}: no {page} in {found}")
        finally:
            driver.quit()
            server.shutdown()
        print(f"{followed} links followed, {len(LOOKED_AT)} pages looked at in two widths, {len(SEARCHES)} searches")
        sys.exit("\n".join(amiss) if amiss else 0)


if __name__ == "__main__":
    main()
