#!/usr/bin/env bash
# Install what is missing, build everything and run all tests. Arguments go to ctest: ./test.sh -R Servo
# Random tests do half of their problems with their built-in seed and half with a seed of the day; VISP_DIRECT_SEED="N ..." ./test.sh
# repeats other days.
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

install_packages "${packages[@]}" "${test_packages[@]}"
build_tree all

export VISP_DIRECT_SEED=${VISP_DIRECT_SEED:-$(date +%Y%m%d)}
echo "Random tests run at seed $VISP_DIRECT_SEED too."

report=$logs/test-results.xml
rm -f "$report"
status=0
ctest --preset release --parallel "$(job_count)" --no-tests=error --output-junit "$report" "$@" 2>&1 || status=$?

count() { sed -nE "s/^[[:space:]]*$1=\"([0-9]+)\".*/\\1/p; s/.*<testsuite[^>]* $1=\"([0-9]+)\".*/\\1/p" "$report" | head -n 1; }
if [ ! -f "$report" ]; then
  echo "test.sh: ctest ran no tests (status $status)"
  exit $((status ? status : 1))
fi
total=$(count tests) failed=$(count failures) skipped=$(($(count skipped) + $(count disabled)))
times >"$logs/times.txt" # of this shell, then of all that it ran
cpu=$(awk 'NR == 2 { split($1, user, "m"); split($2, sys, "m"); print int(60 * (user[1] + sys[1]) + user[2] + sys[2]) }' "$logs/times.txt")
echo "test.sh: $((total - failed - skipped)) passed, $failed failed, $skipped skipped, $SECONDS s in all, $cpu s of processor time"
exit "$status"
