#!/usr/bin/env bash
# The tool and the program that it starts for accuracy, figures and cost: lab_test.sh COTAN FOLDER FACT
set -euo pipefail
cotan="$1"
place="$2/$3"
lab="$(dirname "$cotan")/cotan-lab"
rm -rf "$place" && mkdir -p "$place" && cd "$place"
failed() { echo "lab_test: $1" >&2; exit 1; }
code_of() { local code=0; "$@" > said.txt 2> error.txt || code=$?; echo "$code"; }

# Words, output, report and exit codes are those of the program itself.
printsTheSame() {
  local words=(accuracy --tables flat --frames cotangent --csv)
  "$cotan" "${words[@]}" tool.csv --json tool.json > tool.txt
  "$lab" "${words[@]}" lab.csv --json lab.json > lab.txt
  [ -s tool.csv ] && cmp tool.csv lab.csv && cmp tool.json lab.json && cmp tool.txt lab.txt
  "$cotan" accuracy --help > tool.txt
  "$lab" accuracy --help > lab.txt
  [ -s tool.txt ] && cmp tool.txt lab.txt
  [ "$(code_of "$cotan" accuracy --tables none)" = 1 ] || failed "expected exit code 1 for a table that there is not"
  [ "$(wc -l < error.txt)" = 1 ] && grep -q "^cotan: error: --tables: expected names from flat" error.txt
  [ "$(code_of "$cotan" accuracy --no-such-option)" = 1 ] || failed "expected exit code 1 for an option that there is not"
  printf 'a b\n' > old.csv
  [ "$(code_of "$cotan" accuracy --tables flat --against old.csv)" = 2 ] || failed "expected exit code 2 for a file that is no table"
}

# The tool alone goes on, and says what it misses.
missingProgramIsReported() {
  mkdir bin
  ln "$cotan" bin/cotan 2>/dev/null || cp "$cotan" bin/cotan
  bin/cotan shader --lang glsl --frame orthonormal > shader.txt
  [ -s shader.txt ]
  [ "$(code_of bin/cotan accuracy --list)" = 3 ] || failed "expected exit code 3 where cotan-lab is not beside cotan"
  [ "$(wc -l < error.txt)" = 1 ] && [ ! -s said.txt ] && grep -q "bin/cotan-lab" error.txt
  [ "$(code_of bin/cotan accuracy --no-such-option)" = 1 ] || failed "expected exit code 1 for a wrong option all the same"
  bin/cotan accuracy --help | grep -- --tables > /dev/null
}

# A signal to what was started as the tool ends the work, and leaves no file.
endsOnSignals() {
  local code=0
  "$cotan" accuracy --tables curved,facets --threads 1 --csv all.csv -o all.md > /dev/null 2>&1 &
  local process=$!
  sleep 0.5
  kill -TERM "$process"
  wait "$process" || code=$?
  [ "$code" = 143 ] || failed "expected an end by SIGTERM, found $code"
  [ -z "$(ls -A)" ] || failed "expected no file, found $(ls -A)"
}

case "$3" in
  printsTheSame|missingProgramIsReported|endsOnSignals) "$3" ;;
  *) failed "expected saysTheSame, missingProgramIsReported or endsOnSignals; found $3" ;;
esac
