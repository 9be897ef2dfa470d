#!/bin/bash
# Jobs of every kind, in each of which a call for memory or for a thread fails: the video is whole and the same, or there is none and
# a message says why. All calls: tests/campaign/faults.sh.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/hard/common.sh"
check "memory and threads" campaign --faults alloc,thread --few 2
finish
