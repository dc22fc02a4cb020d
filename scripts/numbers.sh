#!/usr/bin/env bash
# Runs the commands beside the numbers of README and pages, and compares: exit status 1 when a number is stale.
#   scripts/numbers.sh             all but those that take minutes
#   scripts/numbers.sh --long      those of up to ten minutes, too; --long 60 those of an hour
#   scripts/numbers.sh --update    writes what is measured into the pages where they are stale
#   scripts/numbers.sh --page doc/results.md --list
# The commands are those of build/release/bin. Numbers, where they are read and their tolerances: scripts/numbers/claims.json.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec /usr/bin/env python3 "$root/scripts/numbers/numbers.py" "$@"
