# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plugin of pytest (-p calls): notes which functions of visp_direct the tests call, and calls each again and again as the first test
did, rightly and wrongly, to see whether memory is lost. Writes the file VISP_DIRECT_CALLS: {name: [calls, what was lost or ""]}."""
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

CHEAP, BUDGET, MOST = 0.03, 0.03, 100000  # s: of one call, of all calls of a function; number of these
FIRST = {}  # name: function and arguments of a call that succeeded


def noted(name, function, again=None):
    def call(*args, **kwargs):
        result = function(*args, **kwargs)
        FIRST.setdefault(name, (again, args[1:], kwargs) if again else (function, args, kwargs))
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
    """Number of calls, and what each of them loses; in words, empty: nothing."""

    def run(count):
        start = time.perf_counter()
        for _ in range(count):
            try:
                function(*args, **kwargs)
            except Exception:  # pylint: disable=broad-except
                pass  # a wrong call, or one that succeeds only once
        return (time.perf_counter() - start) / count

    if run(1) > CHEAP:
        return 0, ""
    count = int(min(max(BUDGET / run(3), 5), MOST))
    for _ in range(4):  # memory that is kept for later use is not taken in each of them
        blocks, size = used()
        run(count)
        blocks, size = (b - a for a, b in zip((blocks, size), used()))
        if blocks < count / 2 and size < 8 * count:
            return count, ""
    return count, f"{blocks} blocks and {size} bytes in {count} calls"


def pytest_sessionfinish():
    result = {}
    for name, (function, args, kwargs) in sorted(FIRST.items()):
        count, said = lost(function, args, kwargs)
        if count and args:
            wrongly, also = lost(function, (*args[:-1], object()), kwargs)
            count, said = count + wrongly, said or also
        result[name] = count, said
    pathlib.Path(os.environ["VISP_DIRECT_CALLS"]).write_text(json.dumps(result))
