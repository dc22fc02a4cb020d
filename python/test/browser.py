# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""One headless Chromium for all pages of a test, steered by the DevTools protocol over pipes."""
import base64
import json
import os
import shutil
import subprocess

CHROMIUM = shutil.which("chromium")
FLAGS = (
    "--headless --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars "
    "--allow-file-access-from-files --remote-debugging-pipe"
)
MESSAGES = ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")


class Browser:
    """open(), then evaluate() and screenshot() of that page; messages: what the console got from it."""

    def __init__(self):
        read, self._out = os.pipe()
        self._in, write = os.pipe()
        script = f'exec "$@" 3<&{read} 4>&{write}'  # the descriptors that Chromium takes
        call = ["bash", "-c", script, "chromium", CHROMIUM, *FLAGS.split()]
        self._process = subprocess.Popen(call, pass_fds=(read, write), stderr=subprocess.DEVNULL)
        os.close(read)
        os.close(write)
        self._count, self._session, self._rest, self.messages, self._events = 0, {}, b"", [], []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = {"sessionId": self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def close(self):
        os.close(self._out)
        self._process.terminate()
        self._process.wait(30)
        os.close(self._in)

    def _message(self):
        while b"\0" not in self._rest:
            part = os.read(self._in, 1 << 20)
            assert part, "Chromium has ended"
            self._rest += part
        text, self._rest = self._rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **parameters):
        """The result of a command of the protocol; what happens meanwhile is kept."""
        self._count += 1
        text = json.dumps({"id": self._count, "method": method, "params": parameters, **self._session})
        os.write(self._out, text.encode() + b"\0")
        while True:
            message = self._message()
            if message.get("id") == self._count:
                assert "error" not in message, message["error"]
                return message["result"]
            self._keep(message)

    def _keep(self, message):
        if message.get("method") in MESSAGES:
            self.messages.append(json.dumps(message["params"])[:600])
        self._events.append(message.get("method"))

    def open(self, file):
        """Loads a file in a window of 1200 px, until all its scripts have run."""
        self.messages, self._events = [], []
        self.call("Page.navigate", url=file.resolve().as_uri())
        while "Page.loadEventFired" not in self._events:
            self._keep(self._message())
        self.resize(1200)

    def resize(self, width):
        """Another width of the window, px, until it is drawn."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=1600, deviceScaleFactor=1, mobile=False)
        self.evaluate("new Promise((done) => requestAnimationFrame(() => setTimeout(done, 50)))")

    def evaluate(self, script):
        """The value of an expression, or of its promise."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in result, result["exceptionDetails"]
        return result["result"].get("value")

    def screenshot(self, file):
        file.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
