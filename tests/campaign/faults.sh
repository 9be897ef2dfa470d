#!/bin/bash
# Every call for memory, threads and files fails once, in jobs of every kind (tests/hard/README.md), and the disk gets full at every
# 4 KiB; then calls of other libraries, some of which end the process. Its arguments are options of campaign.py.
. "$(dirname "${BASH_SOURCE[0]}")/hard.bash"
campaign near --every "$@"
near=$?
campaign far --who far --few 40 --faults alloc,thread "$@"
exit $near
