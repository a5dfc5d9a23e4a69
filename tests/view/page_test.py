#!/usr/bin/env python3
"""Opens view.html in a headless Chromium as a user would, from the file, and looks, clicks and filters.

usage: page_test.py INTARSIA [PICTURES]   (PICTURES: a folder for screenshots)
Exit status 77, with a message, where Chromium is not installed. Speaks the DevTools protocol over a pipe: needs
nothing but Python and the browser.
"""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time


class Browser:
    def __init__(self, program, folder):
        to_browser, self.out = os.pipe()
        self.input, from_browser = os.pipe()

        def pipes():  # the protocol's file descriptors
            os.dup2(to_browser, 100), os.dup2(from_browser, 101)
            os.dup2(100, 3), os.dup2(101, 4)

        self.process = subprocess.Popen(
            [program, '--headless', '--no-sandbox', '--remote-debugging-pipe', '--use-angle=swiftshader',
             '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--window-size=1200,800', '--no-first-run',
             f'--user-data-dir={folder}/profile'],
            preexec_fn=pipes, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser), os.close(from_browser)
        self.number, self.buffer, self.trouble, self.session = 0, b'', [], None
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self.session = self.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            self.call(domain + '.enable')

    def call(self, method, **params):
        self.number += 1
        message = {'id': self.number, 'method': method, 'params': params}
        if self.session:
            message['sessionId'] = self.session
        os.write(self.out, json.dumps(message).encode() + b'\0')
        while True:
            answer = self.receive()
            if answer.get('id') == self.number:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]}')
                return answer['result']

    def receive(self):
        while b'\0' not in self.buffer:
            piece = os.read(self.input, 1 << 20)
            if not piece:
                raise RuntimeError('the browser ended')
            self.buffer += piece
        text, self.buffer = self.buffer.split(b'\0', 1)
        message = json.loads(text)
        kind, params = message.get('method'), message.get('params', {})
        if kind == 'Runtime.exceptionThrown':
            self.trouble.append(params['exceptionDetails'].get('exception', {}).get('description', 'exception'))
        elif kind == 'Runtime.consoleAPICalled' and params['type'] in ('error', 'warning'):
            self.trouble.append(str(params['args']))
        elif kind == 'Log.entryAdded' and params['entry']['level'] == 'error':
            self.trouble.append(params['entry']['text'])
        elif kind == 'Network.requestWillBeSent' and not params['request']['url'].startswith(('file:', 'about:')):
            self.trouble.append('asks the network for ' + params['request']['url'])
        return message

    def value(self, script):
        answer = self.call('Runtime.evaluate', expression=script, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in answer:
            raise RuntimeError(answer['exceptionDetails']['exception']['description'])
        return answer['result'].get('value')

    def wait(self, script, seconds=60):
        end = time.monotonic() + seconds
        while not self.value(script):
            assert time.monotonic() < end, f'waited in vain for {script}'
            time.sleep(0.05)

    def mouse(self, kind, x, y):
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button='none' if kind == 'mouseMoved' else 'left',
                  clickCount=0 if kind == 'mouseMoved' else 1)

    def click(self, x, y):
        for kind in ('mouseMoved', 'mousePressed', 'mouseReleased'):
            self.mouse(kind, x, y)

    def picture(self, path):
        data = base64.b64decode(self.call('Page.captureScreenshot')['data'])
        pathlib.Path(path).write_bytes(data)
        return data

    def end(self):
        self.process.kill()
        self.process.wait()


# A place on the canvas that shows a patch, away from the panels.
FIND = '''(() => {
  for (let y = 150; y < 600; y += 25) for (let x = 330; x < 800; x += 25) {
    const p = intarsia.scene.pick(intarsia.camera, x, y);
    if (p >= 0 && [[-6, 0], [6, 0], [0, -6], [0, 6]].every(([i, j]) => intarsia.scene.pick(intarsia.camera, x + i, y + j) === p))
      return [x, y, p];
  }
  return null;
})()'''
# Names of the panels in view that lie on the legend.
ON_LEGEND = '''(() => {
  const box = e => e.getBoundingClientRect(), a = box(document.getElementById('legend'));
  return [...document.querySelectorAll('.card:not([hidden])')].filter(e => {
    const b = box(e);
    return a.width * a.height > 0 && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  }).map(e => e.id || e.tagName);
})()'''
AT_REST = '(() => { const c = intarsia.camera; return Math.abs(c.now.distance - c.goal.distance) < 1e-3 && c.now.azimuth === c.goal.azimuth; })()'


def open_page(browser, page):
    browser.call('Page.navigate', url=page.as_uri())
    browser.wait('window.firstPicture > 0')


def check_deviation(browser, page, pictures):
    open_page(browser, page)
    stages = browser.value('intarsia.stages.map(s => s.key)')
    assert stages[-1] == 'deviation', stages
    browser.value(f'intarsia.setStage({len(stages) - 1})')
    assert browser.value("document.getElementById('legend').textContent").startswith('distance')
    assert browser.value(ON_LEGEND) == [], browser.value(ON_LEGEND)
    time.sleep(0.7)
    browser.wait(AT_REST)
    browser.picture(pictures / 'deviation.png')
    assert not browser.trouble, browser.trouble


def check(browser, page, pictures):
    open_page(browser, page)
    print(f'first picture after {browser.value("window.firstPicture"):.0f} ms')
    stages = browser.value('intarsia.stages.map(s => s.key)')
    assert stages == ['input', 'raw', 'filtered', 'network', 'patches'], stages
    assert browser.value('intarsia.stages[intarsia.state.stage].key') == 'patches'

    seen = set()
    for i, stage in enumerate(stages):
        browser.value(f'intarsia.setStage({i})')
        assert browser.value(ON_LEGEND) == [], (stage, browser.value(ON_LEGEND))
        time.sleep(0.7)
        browser.wait(AT_REST)
        seen.add(browser.picture(pictures / f'{stage}.png'))
    assert len(seen) == len(stages), 'two stages look alike'

    x, y, patch = browser.value(FIND)
    browser.mouse('mouseMoved', x, y)
    browser.wait(f'intarsia.state.hover === {patch}')
    browser.click(x, y)
    browser.wait(f'intarsia.state.selected === {patch}')
    assert browser.value("document.querySelector('#detail h2').textContent").startswith(f'Patch {patch}')
    assert browser.value("document.querySelector('.row.selected').dataset.patch") == str(patch)
    browser.picture(pictures / 'selected.png')
    row = browser.value('(() => { const s = document.querySelector(".row.selected"),'
                        ' r = s.previousElementSibling ?? s.nextElementSibling, b = r.getBoundingClientRect();'
                        ' return [b.x + 30, b.y + 10, +r.dataset.patch]; })()')
    browser.click(row[0], row[1])
    browser.wait(f'intarsia.state.selected === {row[2]}')
    browser.click(20, 400)  # beside the surface
    browser.wait('intarsia.state.selected === -1')

    browser.value('intarsia.setStage(1)')
    lines = browser.value('intarsia.lines.raw.count')
    assert lines > 0 and browser.value("document.getElementById('kept').textContent").startswith(f'{lines:,} of {lines:,}')
    browser.value("(() => { const i = document.querySelector('.histogram input'); i.value = 900;"
                  " i.dispatchEvent(new Event('input')); })()")
    kept = int(browser.value("document.getElementById('kept').textContent").split()[0].replace(',', ''))
    assert 0 < kept < lines, (kept, lines)
    assert '--length' in browser.value("document.getElementById('flags').textContent")

    before = browser.value('getComputedStyle(document.body).color')
    browser.value("document.getElementById('theme').click()")
    assert browser.value('getComputedStyle(document.body).color') != before
    browser.picture(pictures / 'dark.png')
    assert not browser.trouble, browser.trouble


def main():
    chromium = shutil.which('chromium') or shutil.which('google-chrome')
    if not chromium:
        print('skipped: chromium is not installed (apt install chromium)')
        return 77
    program = sys.argv[1]
    with tempfile.TemporaryDirectory(prefix='intarsia-page-', ignore_cleanup_errors=True) as name:
        folder = pathlib.Path(name)
        pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder
        for command in (['make', 'part', '--triangles', '6000', '-o', folder / 'part.ply', '-q'],
                        ['run', folder / 'part.ply', '-o', folder / 'out', '-q', '--write', 'html']):
            subprocess.run([program, *command], check=True)
        browser = Browser(chromium, folder)
        try:
            check(browser, folder / 'out' / 'view.html', pictures)
            subprocess.run([program, 'eval', folder / 'out', '-q'], check=True, stdout=subprocess.DEVNULL)
            check_deviation(browser, folder / 'out' / 'view.html', pictures)
        finally:
            browser.end()
    print('the page works')
    return 0


if __name__ == '__main__':
    sys.exit(main())
