#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Opens pages in headless Chromium and prints as JSON what is there and what a reader's actions do.

usage: browser.py [--screenshots DIR] [--no-script] PAGE...
"""
import argparse
import json
import pathlib
import socket
import sys
import time

from selenium import webdriver
from selenium.common.exceptions import WebDriverException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

DRIVER = "/usr/bin/chromedriver"

# A canvas is drawn when not all its pixels are alike.
DRAWN = """return [...document.querySelectorAll('canvas')].map(canvas => {
  const pixels = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  return {id: canvas.id, drawn: new Set(pixels).size > 1};
});"""
# What sticks out of the page to the right, boxes that scroll by themselves left out.
WIDER = """return [...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll') && !e.closest('svg') &&
  e.getBoundingClientRect().right > document.documentElement.clientWidth + 1).map(e => e.tagName + '.' + e.className);"""


def open_browser(script):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1280,1000", "--hide-scrollbars", "--disable-background-networking"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    if not script:
        options.add_experimental_option("prefs", {"profile.managed_default_content_settings.javascript": 2})
    try:
        socket.getaddrinfo("localhost", None)  # where selenium looks for the driver
    except OSError as error:
        sys.exit(f"browser.py: localhost cannot be resolved ({error.strerror}): /etc/hosts lacks '127.0.0.1 localhost'")
    try:
        return webdriver.Chrome(service=Service(DRIVER), options=options)
    except WebDriverException as error:
        sys.exit(f"browser.py: {DRIVER} cannot be started: {str(error).splitlines()[0]}")


def details(driver):
    return driver.find_element(By.ID, "details").text


def settled(driver):
    """What sticks out when charts have had time to follow the window."""
    for _ in range(50):
        wider = driver.execute_script(WIDER)
        if not wider:
            break
        time.sleep(0.1)
    return wider


def act(driver):
    """What a click, keys and the other colours do."""
    found = {"canvases": driver.execute_script(DRAWN)}
    nodes = driver.find_elements(By.CSS_SELECTOR, "svg.diagram a[data-stage]")
    found["stages"] = [node.get_attribute("data-stage") for node in nodes]
    if not nodes:
        return found
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", nodes[-1])
    nodes[-1].click()
    found["click"] = {"stage": found["stages"][-1], "details": details(driver)}
    driver.execute_script("arguments[0].focus()", nodes[0])
    driver.switch_to.active_element.send_keys(Keys.ARROW_DOWN)
    driver.switch_to.active_element.send_keys(Keys.SPACE)
    found["keys"] = {"stage": found["stages"][1 % len(nodes)], "details": details(driver)}
    before = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    driver.execute_script("document.querySelector('button.theme').click()")
    found["themes"] = [before, driver.execute_script("return getComputedStyle(document.body).backgroundColor")]
    found["canvases_in_other_theme"] = driver.execute_script(DRAWN)
    for box in driver.find_elements(By.CSS_SELECTOR, "select"):
        options = box.find_elements(By.TAG_NAME, "option")
        driver.execute_script(
            "arguments[0].selectedIndex = arguments[1]; arguments[0].dispatchEvent(new Event('change'))",
            box, len(options) - 1)
    found["canvases_after_choice"] = driver.execute_script(DRAWN)
    driver.execute_script("document.querySelector('button.theme').click()")
    return found


def look(driver, page, script):
    driver.get(pathlib.Path(page).resolve().as_uri())
    found = {"page": page, "title": driver.title, "text": driver.find_element(By.TAG_NAME, "body").text,
             "images": driver.execute_script(
                 "return [...document.images].map(i => ({alt: i.alt, width: i.naturalWidth}))") if script else [],
             "markers": len(driver.find_elements(By.CLASS_NAME, "marker")),
             "tables": len(driver.find_elements(By.TAG_NAME, "table"))}
    if script:
        found.update(act(driver))
        found["print_bytes"] = len(driver.print_page())
        driver.set_window_size(500, 900)
        found["markers"] += len(driver.find_elements(By.CLASS_NAME, "marker"))
        found["sticks_out"] = settled(driver)
        driver.set_window_size(1280, 1000)
    found["console"] = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    sent = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    found["requests"] = [event["params"]["request"]["url"] for event in sent
                         if event["method"] == "Network.requestWillBeSent"
                         and not event["params"]["request"]["url"].startswith("data:")]
    return found


def screenshots(driver, page, folder):
    driver.get(pathlib.Path(page).resolve().as_uri())
    height = driver.execute_script("return document.documentElement.scrollHeight")
    driver.set_window_size(1280, min(height, 16000))
    name = pathlib.Path(page).resolve().parent.name
    for element in driver.find_elements(By.TAG_NAME, "section"):
        element.screenshot(str(pathlib.Path(folder) / f"{name}_{element.get_attribute('id')}.png"))
    driver.save_screenshot(str(pathlib.Path(folder) / f"{name}.png"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--screenshots")
    parser.add_argument("--no-script", action="store_true")
    parser.add_argument("pages", nargs="+")
    arguments = parser.parse_args()
    driver = open_browser(not arguments.no_script)
    try:
        json.dump([look(driver, page, not arguments.no_script) for page in arguments.pages], sys.stdout)
        if arguments.screenshots:
            for page in arguments.pages:
                screenshots(driver, page, arguments.screenshots)
    finally:
        driver.quit()


if __name__ == "__main__":
    main()
