# shellcheck shell=bash
# Checks of the program's exit codes and messages, for scripts that source this file.
failed=0

fail() {
  echo "FAILED: $name: $1"
  sed 's/^/    /' log
  failed=$((failed + 1))
}

# expect NAME CODE PATTERN COMMAND...: runs it; it must end with CODE and print lines that match
# the extended regular expression.
expect() {
  name=$1
  local code=$2 pattern=$3
  shift 3
  "$@" > log 2>&1
  local status=$?
  [ "$status" = "$code" ] || fail "exit code $status, not $code"
  grep -Eq -- "$pattern" log || fail "no message like: $pattern"
  printf '%-34s %s\n' "$name" "$(grep -m 1 '^flytri: ' log)"
}
