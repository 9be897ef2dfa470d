#!/bin/bash
# Jobs of every kind, in each of which a file cannot be opened, read, written, synced, named or closed.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/hard/common.sh"
check "files" campaign --faults open,read,write,sync,name,close --few 1
finish
