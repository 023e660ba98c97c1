#!/usr/bin/env bash
# A suite that lacks a library fails, and names it: tests/suite_test.sh FOLDER CXX
set -euo pipefail
place="$(mkdir -p "$1" && cd "$1" && pwd)"
cd "$(dirname "$0")/.."
configured() { cmake -S . -B "$place/build" -G Ninja -DCMAKE_CXX_COMPILER="$2" -DCOTAN_WITH_EMBREE=OFF -DCOTAN_REQUIRE_ALL="$1" > "$place/said.txt" 2>&1; }
failed() { echo "$1" >&2; tail -20 "$place/said.txt" >&2; exit 1; }

! configured ON "$2" || failed "expected COTAN_REQUIRE_ALL to refuse a build without Embree"
grep -q "Embree (COTAN_WITH_EMBREE is OFF): no baking" "$place/said.txt" || failed "expected the missing library to be named"

configured OFF "$2" || failed "expected a build without Embree to be configured"
! ctest --test-dir "$place/build" -R '^Suite\.hasItsTests$' --no-tests=error --output-on-failure > "$place/said.txt" 2>&1 ||
  failed "expected a suite without tests to fail"
grep -q "no tests are built: they need Embree" "$place/said.txt" || failed "expected the failure to name the library"
echo "without Embree: refused where everything is required, else a suite that fails and says why"
