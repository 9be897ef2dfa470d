"""Ctrl-C while libweft works: Python would notice only when it is back."""
from __future__ import annotations

import os
import signal
import threading

from ._library import lib


class CancelOnInterrupt:
    """Cancels a job as soon as SIGINT comes, for as long as this context lasts.

    Only where SIGINT would raise KeyboardInterrupt, in the main thread: Python's handler raises it
    when libweft has returned. A thread reads the pipe to which Python writes the numbers of signals
    as they come; they are handed on to whoever had a pipe before.
    """

    def __init__(self, handle):
        self._handle = handle
        self.came = False
        self._wanted = (threading.current_thread() is threading.main_thread()
                        and signal.getsignal(signal.SIGINT) is signal.default_int_handler)

    def __enter__(self):
        if not self._wanted:
            return self
        self._read, self._write = os.pipe()
        os.set_blocking(self._write, False)
        self._before = signal.set_wakeup_fd(self._write, warn_on_full_buffer=False)
        self._watcher = threading.Thread(target=self._watch, name="weft-interrupt", daemon=True)
        self._watcher.start()
        return self

    def _watch(self):
        while numbers := os.read(self._read, 64):
            if signal.SIGINT in numbers:
                self.came = True
                lib.weft_job_cancel(self._handle)
            if self._before >= 0:
                os.write(self._before, numbers)

    def __exit__(self, *_):
        if not self._wanted:
            return
        signal.set_wakeup_fd(self._before)
        os.close(self._write)
        self._watcher.join()
        os.close(self._read)
