# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plugin of pytest (-p calls): notes which functions of visp_direct the tests call, and calls each again and again as the first test
did, rightly and wrongly, to see whether memory is lost, if one call takes less than VISP_DIRECT_CHEAP (s). Writes the file
VISP_DIRECT_CALLS: {name: [calls, what was lost or ""]}."""
import ctypes
import gc
import inspect
import json
import os
import pathlib
import sys
import time

import visp_direct as vd
import visp_direct._core as core

CHEAP = float(os.environ["VISP_DIRECT_CHEAP"])  # s, CPU time of one call of what is called again
BUDGET, LONGEST = 0.005, 3  # s: CPU time of many calls of a function; of these, on the clock
# They keep what they are given, and are not called again.
KEEPING = {"CollisionScene.add", "PlanarMicroscopeCalibration.addView", "TsaiCalibration.addView", "VisionChannel.push"}
FIRST = {}  # name: function and arguments of a call that succeeded, and CPU time of it


def noted(name, function, again=None):
    def call(*args, **kwargs):
        start = time.process_time()
        result = function(*args, **kwargs)
        if name not in FIRST:
            FIRST[name] = again or function, args[1:] if again else args, kwargs, time.process_time() - start
        return result

    return call


def pytest_configure():
    for name, thing in list(vars(core).items()):
        if inspect.isbuiltin(thing):
            for module in (core, vd):
                setattr(module, name, noted(name, thing))
        elif inspect.isclass(thing) and not hasattr(thing, "__members__"):
            for key, member in list(vars(thing).items()):
                if key == "__init__":
                    setattr(thing, key, noted(name, member, again=thing))
                elif isinstance(member, staticmethod):
                    setattr(thing, key, staticmethod(noted(f"{name}.{key}", member.__func__)))
                elif callable(member) and not key.startswith("_"):
                    setattr(thing, key, noted(f"{name}.{key}", member))


class Mallinfo(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]


mallinfo = ctypes.CDLL(None).mallinfo2
mallinfo.restype = Mallinfo


def used():
    """Blocks of Python's allocator, bytes of malloc."""
    gc.collect()
    now = mallinfo()
    return sys.getallocatedblocks(), now.uordblks + now.hblkhd


def lost(function, args, kwargs):
    """Number of calls, and what they lose in words, empty: nothing."""

    def run():
        start, cpu, done = time.monotonic(), time.process_time(), 0
        while done < 5 or ((done % 16 or time.process_time() - cpu < BUDGET) and time.monotonic() - start < LONGEST):
            done += 1
            try:
                function(*args, **kwargs)
            except Exception:  # pylint: disable=broad-except
                pass  # a wrong call, or one that succeeds only once
        return done

    run()
    for _ in range(100):  # caches grow in some of them
        blocks, size = used()
        count = run()
        blocks, size = (b - a for a, b in zip((blocks, size), used()))
        if blocks < count / 2 and size < 8 * count:
            return count, ""
    return count, f"{blocks} blocks and {size} bytes in {count} calls"


def pytest_sessionfinish():
    gc.collect()
    gc.freeze()
    result = {}
    for name, (function, args, kwargs, cost) in sorted(FIRST.items()):
        result[name] = count, said = lost(function, args, kwargs) if cost < CHEAP and name not in KEEPING else (0, "")
        if count and args and not said:
            wrongly, said = lost(function, (*args[:-1], object()), kwargs)
            result[name] = count + wrongly, said
    pathlib.Path(os.environ["VISP_DIRECT_CALLS"]).write_text(json.dumps(result))
